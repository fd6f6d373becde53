//! What a property takes, in words, in JSON and as a row of a table.

use rayloom_network::{Choice, PropertyDecl, PropertyKind};
use serde_json::{Value as Json, json};

use super::{cell, first_sentence, number};

/// Defaults longer than this are left to `--json`.
const LONG: usize = 60;

/// Everything a property declares.
pub fn json(decl: &PropertyDecl) -> Json {
    let mut json = json!({
        "id": decl.id,
        "label": decl.label,
        "help": decl.help,
        "kind": kind_id(&decl.kind),
        "takes": takes(&decl.kind),
        "default": decl.default.to_json(),
        "level": decl.level.to_string(),
    });
    if let PropertyKind::Choice { choices } = &decl.kind {
        let choice = |Choice { id, label, help }: &Choice| json!({"id": id, "label": label, "help": help});
        json["choices"] = choices.iter().map(choice).collect();
    }
    json
}

/// A row of the table of properties.
pub fn row(decl: &PropertyDecl) -> String {
    let default = decl.default.to_json().to_string();
    let default = if default.len() > LONG { "(longer)".to_owned() } else { format!("`{default}`") };
    let help = match &decl.kind {
        PropertyKind::Choice { choices } => choices
            .iter()
            .fold(decl.help.clone(), |help, Choice { id, help: meaning, .. }| help + &format!("<br>`{id}`: {meaning}")),
        PropertyKind::Snippet { slot } => {
            // The help lists all snippets; their pages say it better.
            let automatic = if decl.help.starts_with("auto") { first_sentence(&decl.help) } else { "" };
            format!("One of the [{slot} snippets](../snippets/README.md#{slot}). {automatic}").trim_end().to_owned()
        }
        _ => decl.help.clone(),
    };
    format!("| `{}` | {} | {} | {} |\n", decl.id, cell(&takes(&decl.kind)), cell(&default), cell(&help))
}

/// The kind, its range and its unit.
fn takes(kind: &PropertyKind) -> String {
    use PropertyKind as K;
    let name = kind.value_name();
    match kind {
        K::Int { range: [i64::MIN, i64::MAX], unit } => name.to_owned() + &measured(unit),
        K::Int { range: [min, max], unit } => format!("{name} from {min} to {max}{}", measured(unit)),
        K::Float { range, unit, .. } => name.to_owned() + &span(*range) + &measured(unit),
        K::Vector { len, range, unit, whole } => {
            let numbers = if *whole { "whole numbers" } else { "numbers" };
            format!("{len} {numbers}{}{}", span(*range), measured(unit))
        }
        K::Choice { .. } => "one of the choices".to_owned(),
        K::Snippet { slot } => format!("a {slot} snippet"),
        K::ShaderText { slot } => format!("WGSL for the slot {slot}"),
        K::File { save, extensions, .. } => {
            let verb = if *save { "write" } else { "read" };
            let extensions: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
            format!("a file to {verb} {}", extensions.join(" ")).trim_end().to_owned()
        }
        _ => name.to_owned(),
    }
}

fn span(range: [f64; 2]) -> String {
    let [min, max] = range.map(number);
    if range.iter().any(|end| end.is_finite()) { format!(" from {min} to {max}") } else { String::new() }
}

fn measured(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(", {unit}") }
}

fn kind_id(kind: &PropertyKind) -> &'static str {
    use PropertyKind as K;
    match kind {
        K::Bool => "bool",
        K::Int { .. } => "int",
        K::Float { .. } => "float",
        K::Vector { .. } => "vector",
        K::Color => "color",
        K::Choice { .. } => "choice",
        K::Text { .. } => "text",
        K::File { .. } => "file",
        K::TransferFunction => "transfer_function",
        K::TransferFunction2D => "transfer_function_2d",
        K::Labels => "labels",
        K::Camera => "camera",
        K::Light => "light",
        K::Snippet { .. } => "snippet",
        K::ShaderText { .. } => "shader_text",
    }
}
