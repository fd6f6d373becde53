//! The slots of the ray loop and their contracts.

use std::fmt;

use crate::lexer::{Token, TokenKind, tokens};

/// A place in the ray loop that a snippet fills. The folder of a built-in snippet has the slot's id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Slot {
    /// Reconstructs the voxel values at a point.
    Sampling,
    /// Estimates the gradient of the selected channel.
    Gradient,
    /// Turns a sample into emission and extinction.
    Classification,
    /// Lights a classified sample.
    Shading,
    /// Combines the samples of a ray into a pixel; once for every output.
    Compositing,
    /// Finds where a surface is crossed between two samples.
    Refinement,
    /// Leaps over samples that cannot contribute.
    Skipping,
    /// Tells places without a value. Filled by the program, as are all that follow.
    Gaps,
    /// Takes the gradient of each sample.
    Slope,
    /// Puts light on a classified sample, by way of [`Slot::Shading`].
    Lighting,
    /// Moves the lattice of samples.
    Lattice,
    /// Takes one sample after another.
    Stepping,
    /// Looks at how rays end.
    Endings,
    /// Counts rays and samples of the whole picture.
    Statistics,
    /// Stores the number of samples of each ray.
    SampleMap,
}

impl Slot {
    /// The slots that users fill, in the order in which the loop meets them.
    pub const ALL: [Slot; 7] = [
        Slot::Skipping,
        Slot::Sampling,
        Slot::Gradient,
        Slot::Classification,
        Slot::Shading,
        Slot::Refinement,
        Slot::Compositing,
    ];

    /// The slots that the program fills: what can be absent has a snippet that compiles to nothing.
    pub const OF_PROGRAM: [Slot; 8] = [
        Slot::Lattice,
        Slot::Stepping,
        Slot::Gaps,
        Slot::Slope,
        Slot::Lighting,
        Slot::Endings,
        Slot::Statistics,
        Slot::SampleMap,
    ];

    /// Stable id, also the folder of the slot's built-in snippets.
    pub fn id(self) -> &'static str {
        match self {
            Slot::Sampling => "sampling",
            Slot::Gradient => "gradient",
            Slot::Classification => "classification",
            Slot::Shading => "shading",
            Slot::Compositing => "compositing",
            Slot::Refinement => "refinement",
            Slot::Skipping => "skipping",
            Slot::Gaps => "gaps",
            Slot::Slope => "slope",
            Slot::Lighting => "lighting",
            Slot::Lattice => "lattice",
            Slot::Stepping => "stepping",
            Slot::Endings => "endings",
            Slot::Statistics => "statistics",
            Slot::SampleMap => "sample_map",
        }
    }

    /// Whether a ray needs but one of it, however many volumes and outputs there are.
    pub fn is_filled_once(self) -> bool {
        !matches!(
            self,
            Slot::Sampling
                | Slot::Gradient
                | Slot::Classification
                | Slot::Skipping
                | Slot::Gaps
                | Slot::Slope
                | Slot::Lighting
                | Slot::Compositing
        )
    }

    /// The slot with this id.
    pub fn from_id(id: &str) -> Option<Slot> {
        Slot::ALL.into_iter().chain(Slot::OF_PROGRAM).find(|slot| slot.id() == id)
    }
}

impl fmt::Display for Slot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// A function or struct that a snippet of a slot must define.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Prototype {
    /// Name of the function or struct.
    pub name: String,
    /// The prototype as WGSL: `fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f` or `struct State`.
    pub text: String,
    /// Meaning of parameters and result, with coordinate space and unit.
    pub help: String,
}

/// The contract of a slot: what its snippets must define. Read from the `//! slot` lines at the head of the skeleton.
pub fn contract(skeleton: &str, slot: Slot) -> Vec<Prototype> {
    let mut current = None;
    let mut found: Vec<Prototype> = Vec::new();
    for line in skeleton.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim) {
        if let Some(id) = line.strip_prefix("slot ") {
            current = Slot::from_id(id.split(':').next().unwrap_or("").trim());
        } else if current == Some(slot) && (line.starts_with("fn ") || line.starts_with("struct ")) {
            let name = tokens(line).get(1).map_or("", |token| token.text).to_owned();
            found.push(Prototype { name, text: line.to_owned(), help: String::new() });
        } else if current == Some(slot)
            && let Some(prototype) = found.last_mut()
            && !line.is_empty()
        {
            prototype.help += if prototype.help.is_empty() { "" } else { " " };
            prototype.help += line;
        }
    }
    found
}

/// The header of `fn name(...) -> ...` in `text`, normalised so that equal signatures are equal strings; with its byte offset.
pub(crate) fn signature(text: &str, name: &str) -> Option<(String, usize)> {
    let list = tokens(text);
    let start = list.windows(2).position(|pair| pair[0].text == "fn" && pair[1].text == name)?;
    let end = list[start..].iter().position(|token| token.text == "{").map_or(list.len(), |body| start + body);
    Some((normalise(&list[start..end]), list[start].start))
}

/// Types of the parameters and the result; names of parameters do not matter to a caller.
fn normalise(header: &[Token<'_>]) -> String {
    let mut out = String::new();
    for (index, token) in header.iter().enumerate() {
        let names_a_parameter =
            token.kind == TokenKind::Identifier && header.get(index + 1).is_some_and(|next| next.text == ":");
        if names_a_parameter || token.text == ":" {
            continue;
        }
        out += token.text;
        if token.text == "fn" {
            out.push(' ');
        }
    }
    for n in 2..=4 {
        for (long, short) in [("f32", "f"), ("i32", "i"), ("u32", "u")] {
            out = out.replace(&format!("vec{n}<{long}>"), &format!("vec{n}{short}"));
        }
    }
    out.replace(",)", ")")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signatures_ignore_names_and_spelling() {
        let a = signature("fn f(p: vec3<f32>, q : vec4f,) -> vec2<u32> { return x; }", "f");
        let b = signature("fn f(a: vec3f, b: vec4<f32>) -> vec2u", "f");
        assert_eq!(a.map(|found| found.0), b.map(|found| found.0));
        assert!(signature("fn g() {}", "f").is_none());
    }

    #[test]
    fn contracts_come_from_the_head_of_the_skeleton() {
        let head = "//! The traversal.\n//! slot gradient:\n//! fn gradient_at(p: vec3f) -> vec3f\n//!   p: volume coordinates.\n//!   Result: value per voxel.\n//! slot shading:\n//! fn shade() -> f32\nfn x() {}";
        let gradient = contract(head, Slot::Gradient);
        assert_eq!(gradient.len(), 1);
        assert_eq!(gradient[0].name, "gradient_at");
        assert_eq!(gradient[0].help, "p: volume coordinates. Result: value per voxel.");
    }
}
