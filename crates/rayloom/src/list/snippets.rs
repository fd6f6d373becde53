//! The snippets of the ray loop: text, JSON, and a page each.

use rayloom_processors::snippet_library;
use rayloom_wgsl::{Declaration, Library, Parameter, ParameterType, Skeleton, Slot, contract};
use serde_json::{Value as Json, json};

use super::{Page, cell, columns, first_sentence, number};
use crate::failure::Failure;

/// The snippets by slot, those of the user's folder included, one line each.
pub fn text() -> String {
    let (library, _) = snippet_library();
    let mut text = String::new();
    for slot in Slot::ALL {
        let snippets = library.snippets(slot).map(|(path, declaration)| (Library::id(path), declaration.help.as_str()));
        text += &format!("{slot}\n{}", columns(snippets));
    }
    text
}

/// One object a snippet, those of the user's folder included, with everything it declares.
pub fn json() -> Vec<Json> {
    let (library, _) = snippet_library();
    let snippets = Slot::ALL.into_iter().flat_map(|slot| library.snippets(slot));
    snippets.map(|(path, declaration)| declared(path, declaration)).collect()
}

/// A page for every built-in snippet in a folder for each slot, and one with the contracts of the slots.
pub fn pages() -> Result<Vec<Page>, Failure> {
    let library = Library::built_in()?;
    let skeleton = library.source(Skeleton::TRAVERSAL.path).map_or("", |source| &source.text);
    let mut overview =
        "# Slots and snippets\n\nGenerated from the declarations by `cargo xtask docs`. A snippet is one \
                        WGSL file under `shaders/SLOT/`; what a slot expects is its contract.\n"
            .to_owned();
    let mut pages = Vec::new();
    for slot in Slot::ALL {
        overview += &format!("\n## {slot}\n\n");
        for prototype in contract(skeleton, slot) {
            overview += &format!("```wgsl\n{}\n```\n{}\n\n", prototype.text, prototype.help);
        }
        overview += "| snippet | what it does |\n|---|---|\n";
        for (path, declaration) in library.snippets(slot) {
            let id = Library::id(path);
            overview += &format!("| [`{id}`]({slot}/{id}.md) | {} |\n", cell(first_sentence(&declaration.help)));
            pages.push(Page { path: format!("{slot}/{id}.md"), text: page_text(path, declaration) });
        }
    }
    pages.push(Page { path: "README.md".to_owned(), text: overview });
    Ok(pages)
}

fn declared(path: &str, declaration: &Declaration) -> Json {
    json!({
        "id": Library::id(path),
        "slot": declaration.slot.id(),
        "file": path,
        "label": declaration.label,
        "help": declaration.help,
        "reads": declaration.reads,
        "forbids": refusals(declaration),
        "parameters": declaration.parameters.iter().map(parameter).collect::<Vec<_>>(),
    })
}

fn parameter(parameter: &Parameter) -> Json {
    json!({
        "name": parameter.name,
        "type": type_name(parameter.ty),
        "default": default(parameter),
        "range": parameter.range,
        "unit": parameter.unit,
        "help": parameter.help,
    })
}

/// A number, or the components of a colour.
fn default(parameter: &Parameter) -> Json {
    match parameter.default[..] {
        [number] => number.into(),
        _ => parameter.default.clone().into(),
    }
}

fn type_name(ty: ParameterType) -> &'static str {
    match ty {
        ParameterType::Float => "number",
        ParameterType::Integer => "whole number",
        ParameterType::Color => "colour",
    }
}

/// The combinations that a snippet refuses, one sentence each.
fn refusals(declaration: &Declaration) -> Vec<String> {
    let refusal = |forbidden: &rayloom_wgsl::Forbidden| {
        let slot = forbidden.slot;
        let what = match (&forbidden.reads, &forbidden.id) {
            (Some(read), _) => format!("a {slot} snippet that reads `{read}`"),
            (None, Some(id)) => format!("the {slot} snippet `{id}`"),
            (None, None) => format!("the slot {slot}"),
        };
        format!("not with {what}, because {}", forbidden.reason)
    };
    declaration.forbids.iter().map(refusal).collect()
}

fn page_text(path: &str, declaration: &Declaration) -> String {
    let Declaration { slot, label, help, reads, parameters, .. } = declaration;
    let (id, file) = (Library::id(path), format!("[`shaders/{path}`](../../../shaders/{path})"));
    let mut text = format!("# {label}\n\nSnippet `{id}` of the slot {slot}, {file}.\n\n{help}\n");
    if !reads.is_empty() {
        let reads: Vec<String> = reads.iter().map(|read| format!("`{read}`")).collect();
        text += &format!("\nReads {}.\n", reads.join(", "));
    }
    for refusal in refusals(declaration) {
        text += &format!("\nCannot be combined: {refusal}.\n");
    }
    if !parameters.is_empty() {
        text += &format!("\n## Parameters\n\nProperties of the ray traversal that begin with `{slot}.`");
        if *slot == Slot::Compositing {
            text += " (`compositing2.` and `compositing3.` for its other outputs)";
        }
        text += ".\n\n| name | takes | default | help |\n|---|---|---|---|\n";
        for parameter in parameters {
            let [min, max] = parameter.range.map(number);
            let unit = match parameter.unit.as_str() {
                "" => String::new(),
                "data" => ", the volume's own unit".to_owned(),
                unit => format!(", {unit}"),
            };
            let takes = format!("{} from {min} to {max}{unit}", type_name(parameter.ty));
            text +=
                &format!("| `{}` | {takes} | `{}` | {} |\n", parameter.name, default(parameter), cell(&parameter.help));
        }
    }
    text
}
