//! `rayloom check`: whether a network can be rendered, told without a graphics adapter.

use std::path::Path;

use rayloom_network::{Network, Processor, PropertyKind, closest, not_ready};
use rayloom_processors::snippet_library;
use rayloom_wgsl::{Slot, Snippet};

use crate::failure::Failure;
use crate::network_file;

/// Loads a network and asks every sink whether it is ready, and every file and snippet whether it is there. Returns what
/// is well.
///
/// # Errors
/// What is not well, each with its cause.
pub fn run(file: &Path) -> Result<String, Failure> {
    let network = network_file::open(file, &[])?;
    let sinks: Vec<&str> = network.processors().filter(|p| is_sink(p)).map(Processor::id).collect();
    let mut problems: Vec<String> = Vec::new();
    let mut waiting = not_ready(&network, &sinks);
    problems.extend(sinks.iter().filter_map(|sink| waiting.remove(sink)).flatten());
    problems.extend(wrong_properties(&network));
    if sinks.is_empty() {
        problems
            .push("the network has no canvas or other sink, so nothing would be evaluated; add a canvas".to_owned());
    }
    if problems.is_empty() {
        let (processors, connections) = (network.processors().count(), network.connections().len());
        let sinks = sinks.join(", ");
        let file = file.display();
        return Ok(format!("{file}: ready; {processors} processors, {connections} connections, sinks: {sinks}\n"));
    }
    Err(Failure::new(format!("{}: not ready\n  {}", file.display(), problems.join("\n  "))))
}

fn is_sink(processor: &Processor) -> bool {
    processor.declaration().is_some_and(|declaration| declaration.sink)
}

/// What is wrong with single properties: a file that is not there, a snippet that does not exist, a text that is none.
fn wrong_properties(network: &Network) -> Vec<String> {
    let mut wrong = Vec::new();
    for processor in network.processors() {
        let properties = processor.properties();
        for decl in processor.property_decls() {
            let text = properties.text(&decl.id).unwrap_or_default();
            if text.is_empty() || *text == *decl.default.to_json().as_str().unwrap_or_default() {
                continue;
            }
            let problem = match &decl.kind {
                PropertyKind::File { save: false, .. } => missing_file(text),
                PropertyKind::Snippet { slot } => unknown_snippet(slot, text),
                PropertyKind::ShaderText { slot } => malformed_text(slot, &decl.id, text),
                _ => None,
            };
            wrong.extend(problem.map(|problem| format!("{}.{}: {problem}", processor.id(), decl.id)));
        }
    }
    wrong
}

fn missing_file(path: &str) -> Option<String> {
    (!Path::new(path).is_file()).then(|| format!("there is no file {path}; correct the path"))
}

fn unknown_snippet(slot: &str, id: &str) -> Option<String> {
    let slot = Slot::from_id(slot)?;
    let (library, _) = snippet_library();
    if library.path(slot, id).is_some() {
        return None;
    }
    let known: Vec<&str> = library.all(slot).map(Snippet::id).collect();
    let near = closest(id, known.iter().copied());
    let (lead, names) = if near.is_empty() { ("there are", known) } else { ("did you mean", near) };
    Some(format!("there is no {slot} snippet `{id}`; {lead} {}", names.join(", ")))
}

fn malformed_text(slot: &str, place: &str, text: &str) -> Option<String> {
    Snippet::edited(place, Slot::from_id(slot)?, text).err().map(|problem| problem.to_string())
}
