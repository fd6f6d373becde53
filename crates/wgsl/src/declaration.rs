//! What a snippet says about itself in the `//!` lines at its head.
//!
//! ```text
//! //! slot: compositing
//! //! label: Isosurface
//! //! help: The first surface on which the value is the isovalue.
//! //! reads: previous, refinement, surface
//! //! terminates: hit
//! //! empty: no_crossing isovalue
//! //! forbids: classification reads previous -- a surface has no thickness to integrate over
//! //! param isovalue: f32 = 0.5 [-1e9, 1e9] unit data -- value of the surface
//! ```

use std::collections::BTreeSet;

use crate::diagnostic::Diagnostic;
use crate::slot::Slot;

/// Everything a snippet may read, with what it makes the assembler provide.
pub const READS: [(&str, &str); 17] = [
    ("voxel", "all channels of the sample"),
    ("previous", "the value at the previous sample"),
    ("gradient", "the gradient at the sample"),
    ("medium", "the classified and shaded sample, inside the loop"),
    ("medium_at", "classification and shading at any point of the ray"),
    ("classify_value", "classification of a bare value"),
    ("surface", "shading of a given colour at a point of the ray"),
    ("refinement", "the refinement slot"),
    ("light", "direction and colour of the light"),
    ("transfer_function", "the 1-D transfer function"),
    ("transfer_function_2d", "the transfer function over value and gradient magnitude"),
    ("preintegration_fast", "the pre-integrated table without self-attenuation"),
    ("preintegration_full", "the pre-integrated table with self-attenuation"),
    ("labels", "the label volume and a transfer function a label"),
    ("gradient_volume", "a volume whose first three channels hold the gradient"),
    ("prefiltered", "a volume of B-spline coefficients"),
    ("filtering", "the texture unit's linear filter"),
];

/// When the output of a compositing snippet can no longer change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Termination {
    /// It needs the whole ray.
    #[default]
    Never,
    /// When the accumulated opacity reaches the threshold of early ray termination: an error that the user chooses.
    Opacity,
    /// When it has found what it looks for; ending the ray changes nothing.
    Hit,
}

/// Which values a classification snippet makes visible. Empty-space skipping relies on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Any value may be visible: nothing can be skipped.
    #[default]
    Always,
    /// Where the 1-D transfer function is not fully transparent.
    TransferFunction,
    /// Where the 2-D transfer function is not fully transparent at any gradient magnitude.
    TransferFunction2D,
    /// Between two parameters (names), both included.
    Between(String, String),
}

/// What makes a region of the volume contribute nothing to a compositing snippet's output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Emptiness {
    /// The medium is fully transparent there.
    Transparent,
    /// None of these parameters (isovalues) lies within the values there.
    NoCrossing(Vec<String>),
    /// Both of the above.
    TransparentWithoutCrossing(Vec<String>),
}

/// How far a sampling snippet reaches and how far its values may leave those of the voxels it reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// Voxels beyond those of trilinear interpolation on either side.
    pub apron: u32,
    /// The span of results over the span of the voxels read; 1 when results stay within.
    pub spread: f64,
}

/// A combination that the snippet refuses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Forbidden {
    /// The other slot.
    pub slot: Slot,
    /// What its snippet must not read; `None` when a snippet id is refused.
    pub reads: Option<String>,
    /// The snippet id that is refused; `None` when a read is refused.
    pub id: Option<String>,
    /// Why, as a clause that follows "because".
    pub reason: String,
}

/// Type of a snippet parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterType {
    /// A 32-bit float.
    Float,
    /// A whole number.
    Integer,
    /// An RGB colour with components 0..1 (`vec3f`).
    Color,
}

impl ParameterType {
    /// The WGSL type of the uniform.
    pub fn wgsl(self) -> &'static str {
        match self {
            ParameterType::Float => "f32",
            ParameterType::Integer => "u32",
            ParameterType::Color => "vec3f",
        }
    }
}

/// A number or colour that the user can change without re-assembling the shader.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name; the snippet reads it as `params.name`.
    pub name: String,
    /// Type of the uniform.
    pub ty: ParameterType,
    /// Default: one component, or three for a colour.
    pub default: Vec<f64>,
    /// Inclusive range.
    pub range: [f64; 2],
    /// Unit, empty for a pure number. The unit `data` means the volume's own unit: the uniform receives the normalised value.
    pub unit: String,
    /// One line of help.
    pub help: String,
}

/// What a snippet is, needs and refuses.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// The slot it fills.
    pub slot: Slot,
    /// Name for people.
    pub label: String,
    /// What it does, in a sentence or two.
    pub help: String,
    /// Words of [`READS`].
    pub reads: BTreeSet<String>,
    /// The slot stays empty: nothing may read it.
    pub absent: bool,
    /// Compositing only.
    pub termination: Termination,
    /// Classification only.
    pub visibility: Visibility,
    /// Compositing only; `None` when no region can be skipped.
    pub emptiness: Option<Emptiness>,
    /// Sampling only; `None` when nothing is known, and nothing can be skipped.
    pub kernel: Option<Kernel>,
    /// Combinations refused.
    pub forbids: Vec<Forbidden>,
    /// Parameters in the order of the file.
    pub parameters: Vec<Parameter>,
}

/// Reads the declaration at the head of a snippet.
///
/// # Errors
/// A [`Diagnostic`] that names file and line for a missing slot, an unknown key or word, or a malformed parameter.
pub fn parse_declaration(file: &str, text: &str) -> Result<Declaration, Diagnostic> {
    let mut parser = Parser::default();
    for (index, line) in text.lines().map_while(|line| line.strip_prefix("//!")).enumerate() {
        parser
            .line(line.trim())
            .map_err(|message| Diagnostic::new(file, index as u32 + 1, 0, message).with_excerpt(text))?;
    }
    let slot = parser.slot.ok_or_else(|| {
        Diagnostic::new(
            file,
            1,
            0,
            format!("a snippet starts with a line such as `//! slot: gradient`; slots are {}", slot_list()),
        )
    })?;
    Ok(Declaration {
        slot,
        label: if parser.label.is_empty() { stem(file).to_owned() } else { parser.label },
        help: parser.help,
        reads: parser.reads,
        absent: parser.absent,
        termination: parser.termination,
        visibility: parser.visibility,
        emptiness: parser.emptiness,
        kernel: parser.kernel,
        forbids: parser.forbids,
        parameters: parser.parameters,
    })
}

/// The file name without folder and extension: the snippet's id.
pub(crate) fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.strip_suffix(".wgsl").unwrap_or(name)
}

#[derive(Default)]
struct Parser {
    slot: Option<Slot>,
    label: String,
    help: String,
    reads: BTreeSet<String>,
    absent: bool,
    termination: Termination,
    visibility: Visibility,
    emptiness: Option<Emptiness>,
    kernel: Option<Kernel>,
    forbids: Vec<Forbidden>,
    parameters: Vec<Parameter>,
}

impl Parser {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let (key, value) = line.split_once(':').map_or((line, ""), |(key, value)| (key.trim(), value.trim()));
        match key {
            "" => {}
            "slot" => {
                self.slot = Some(
                    Slot::from_id(value)
                        .ok_or_else(|| format!("there is no slot `{value}`; slots are {}", slot_list()))?,
                )
            }
            "label" => self.label = value.to_owned(),
            "help" => {
                self.help += if self.help.is_empty() { "" } else { " " };
                self.help += value;
            }
            "absent" => self.absent = true,
            "reads" => self.reads = reads(value)?,
            "terminates" => self.termination = termination(value)?,
            "visible" => self.visibility = visibility(value),
            "empty" => self.emptiness = Some(emptiness(value)?),
            "kernel" => self.kernel = Some(kernel(value)?),
            "forbids" => self.forbids.push(forbidden(value)?),
            _ if key.starts_with("param ") => {
                let parameter = parameter(&line["param ".len()..])?;
                if self.parameters.iter().any(|known| known.name == parameter.name) {
                    return Err(format!("parameter `{}` is declared twice", parameter.name));
                }
                self.parameters.push(parameter);
            }
            _ => {
                return Err(format!(
                    "unknown key `{key}`; keys are slot, label, help, reads, absent, terminates, visible, empty, kernel, forbids and param"
                ));
            }
        }
        Ok(())
    }
}

fn slot_list() -> String {
    Slot::ALL.map(Slot::id).join(", ")
}

fn words(value: &str) -> impl Iterator<Item = &str> {
    value.split([',', ' ']).map(str::trim).filter(|word| !word.is_empty())
}

fn known_read(word: &str) -> Result<String, String> {
    if READS.iter().any(|(known, _)| *known == word) {
        Ok(word.to_owned())
    } else {
        Err(format!(
            "nothing called `{word}` can be read; a snippet reads {}",
            READS.map(|(known, _)| known).join(", ")
        ))
    }
}

fn reads(value: &str) -> Result<BTreeSet<String>, String> {
    words(value).map(known_read).collect()
}

fn termination(value: &str) -> Result<Termination, String> {
    match value {
        "opacity" => Ok(Termination::Opacity),
        "hit" => Ok(Termination::Hit),
        _ => Err(format!("`terminates` is `opacity` or `hit`, not `{value}`")),
    }
}

fn visibility(value: &str) -> Visibility {
    match value {
        "transfer_function" => Visibility::TransferFunction,
        "transfer_function_2d" => Visibility::TransferFunction2D,
        _ => match value.split_once("..") {
            Some((low, high)) => Visibility::Between(low.trim().to_owned(), high.trim().to_owned()),
            None => Visibility::Always,
        },
    }
}

fn emptiness(value: &str) -> Result<Emptiness, String> {
    let (transparent, crossing) = (value.contains("transparent"), value.contains("no_crossing"));
    let names = words(value)
        .filter(|word| !matches!(*word, "transparent" | "no_crossing" | "and"))
        .map(str::to_owned)
        .collect();
    match (transparent, crossing) {
        (true, false) => Ok(Emptiness::Transparent),
        (false, true) => Ok(Emptiness::NoCrossing(names)),
        (true, true) => Ok(Emptiness::TransparentWithoutCrossing(names)),
        _ => Err(format!("`empty` is `transparent`, `no_crossing ISOVALUES` or both, not `{value}`")),
    }
}

fn kernel(value: &str) -> Result<Kernel, String> {
    let form = || format!("`kernel` is written `APRON SPREAD`, such as `1 1.5`, not `{value}`");
    match numbers(value)?[..] {
        [apron, spread] if (0.0..=16.0).contains(&apron) && spread >= 1.0 => Ok(Kernel { apron: apron as u32, spread }),
        _ => Err(form()),
    }
}

fn forbidden(value: &str) -> Result<Forbidden, String> {
    let form = || format!("`forbids` is written `SLOT reads WORD -- reason` or `SLOT = ID -- reason`, not `{value}`");
    let (what, reason) = value.split_once("--").ok_or_else(form)?;
    let parts: Vec<_> = what.split_whitespace().collect();
    let [slot, verb, object] = parts[..] else { return Err(form()) };
    let slot = Slot::from_id(slot).ok_or_else(form)?;
    let (reads, id) = match verb {
        "reads" => (Some(known_read(object)?), None),
        "=" => (None, Some(object.to_owned())),
        _ => return Err(form()),
    };
    Ok(Forbidden { slot, reads, id, reason: reason.trim().to_owned() })
}

/// `NAME: TYPE = DEFAULT [MIN, MAX] unit UNIT -- help`, range and unit optional.
fn parameter(text: &str) -> Result<Parameter, String> {
    let form = || format!("a parameter is written `NAME: TYPE = DEFAULT [MIN, MAX] unit UNIT -- help`, not `{text}`");
    let (head, help) = text.split_once("--").map_or((text, ""), |(head, help)| (head, help.trim()));
    let (name, rest) = head.split_once(':').ok_or_else(form)?;
    let (ty, rest) = rest.split_once('=').ok_or_else(form)?;
    let ty = match ty.trim() {
        "f32" => ParameterType::Float,
        "u32" => ParameterType::Integer,
        "color" => ParameterType::Color,
        other => return Err(format!("the type of a parameter is f32, u32 or color, not `{other}`")),
    };
    let (rest, unit) = rest.split_once(" unit ").map_or((rest, ""), |(rest, unit)| (rest, unit.trim()));
    let (default, range) = match rest.split_once('[') {
        Some((default, range)) => (default, numbers(range.trim().strip_suffix(']').ok_or_else(form)?)?),
        None => (rest, vec![0.0, 1.0]),
    };
    let name = name.trim();
    if name.is_empty()
        || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        || name.starts_with(|c: char| c.is_ascii_digit())
    {
        return Err(format!("`{name}` cannot be the name of a parameter"));
    }
    let default = numbers(default)?;
    let [min, max] = range[..] else { return Err(form()) };
    let components = if ty == ParameterType::Color { 3 } else { 1 };
    if default.len() != components {
        return Err(format!("the default of `{name}` needs {components} number(s), found {}", default.len()));
    }
    if min > max || default.iter().any(|value| !(min..=max).contains(value)) {
        return Err(format!("the default of `{name}` is outside its range [{min}, {max}]"));
    }
    Ok(Parameter {
        name: name.to_owned(),
        ty,
        default,
        range: [min, max],
        unit: unit.to_owned(),
        help: help.to_owned(),
    })
}

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    words(text)
        .map(|word| match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("`{word}` is not a number")),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_a_full_declaration() {
        let text = "//! slot: compositing\n//! label: Isosurface\n//! help: One surface.\n//! reads: previous, refinement\n//! terminates: hit\n//! empty: no_crossing isovalue\n//! forbids: classification reads previous -- no thickness\n//! param isovalue: f32 = 0.5 [-10, 10] unit data -- value of the surface\n//! param color: color = 1, 0.5, 0 -- colour\nfn x() {}";
        let found = parse_declaration("compositing/iso.wgsl", text).expect("valid");
        assert_eq!(found.slot, Slot::Compositing);
        assert_eq!(found.emptiness, Some(Emptiness::NoCrossing(vec!["isovalue".into()])));
        assert_eq!(found.parameters[0].range, [-10.0, 10.0]);
        assert_eq!(found.parameters[0].unit, "data");
        assert_eq!(found.parameters[1].default, [1.0, 0.5, 0.0]);
        assert_eq!(found.forbids[0].reason, "no thickness");
    }

    #[test]
    fn errors_name_file_and_line() {
        let check = |text: &str| parse_declaration("user/mine.wgsl", text).expect_err("must fail").to_string();
        insta::assert_snapshot!(check("fn f() {}"), @"user/mine.wgsl:1: a snippet starts with a line such as `//! slot: gradient`; slots are skipping, sampling, gradient, classification, shading, refinement, compositing");
        insta::assert_snapshot!(check("//! slot: shade"), @r"
        user/mine.wgsl:1: there is no slot `shade`; slots are skipping, sampling, gradient, classification, shading, refinement, compositing
          1 | //! slot: shade
        ");
        insta::assert_snapshot!(check("//! slot: shading\n//! param k: f32 = 2 [0, 1]"), @r"
        user/mine.wgsl:2: the default of `k` is outside its range [0, 1]
          2 | //! param k: f32 = 2 [0, 1]
        ");
        insta::assert_snapshot!(check("//! slot: shading\n//! reads: gradients"), @r"
        user/mine.wgsl:2: nothing called `gradients` can be read; a snippet reads voxel, previous, gradient, medium, medium_at, classify_value, surface, refinement, light, transfer_function, transfer_function_2d, preintegration_fast, preintegration_full, labels, gradient_volume, prefiltered, filtering
          2 | //! reads: gradients
        ");
    }
}
