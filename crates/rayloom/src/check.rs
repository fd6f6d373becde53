//! `rayloom check`: whether a network can be rendered, told without a graphics adapter.

use std::path::Path;

use rayloom_network::{Network, Processor, PropertyKind, Readiness, readiness};

use crate::failure::Failure;
use crate::network_file;

/// Loads a network and asks every sink whether it is ready and every file whether it is there. Returns what is well.
///
/// # Errors
/// What is not well, each with its cause.
pub fn run(file: &Path) -> Result<String, Failure> {
    let network = network_file::open(file, &[])?;
    let sinks: Vec<&str> = network.processors().filter(|p| is_sink(p)).map(Processor::id).collect();
    let mut problems: Vec<String> = Vec::new();
    for sink in &sinks {
        if let Readiness::NotReady(reasons) = readiness(&network, sink) {
            problems.extend(reasons);
        }
    }
    problems.extend(missing_files(&network));
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

/// Files that processors are to read and that are not there.
fn missing_files(network: &Network) -> Vec<String> {
    let mut missing = Vec::new();
    for processor in network.processors() {
        let properties = processor.properties();
        for decl in processor.property_decls() {
            let read = matches!(decl.kind, PropertyKind::File { save: false, .. });
            let Some(path) = properties.path(&decl.id).ok().filter(|path| read && !path.as_os_str().is_empty()) else {
                continue;
            };
            if !path.is_file() {
                let place = format!("{}.{}", processor.id(), decl.id);
                missing.push(format!("{place}: there is no file {}; correct the path", path.display()));
            }
        }
    }
    missing
}
