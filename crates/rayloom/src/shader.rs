//! `rayloom shader`: the assembled WGSL of a ray traversal.

use std::path::Path;
use std::sync::Arc;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Address, Declaration, Evaluator, Network, Processor, Request, Sinks, closest};
use rayloom_processors::{Runner, types};
use rayloom_wgsl::Assembled;

use crate::args::Setting;
use crate::failure::Failure;
use crate::network_file;
use crate::problems;
use crate::progress::Line;

/// Assembly depends on what is connected and on the volume, not on the size of the picture: a small one will do.
const SIZE: [u32; 2] = [8, 8];

/// Evaluates the processor and returns its shader, every part headed by the file and line it comes from.
///
/// # Errors
/// There is no such processor, it assembles no shader, or it or what feeds it fails.
pub fn run(file: &Path, processor: &str, settings: &[Setting]) -> Result<String, Failure> {
    let network = network_file::open(file, settings)?;
    let watch = used_outports(&network, processor)?;
    let mut runner = Runner::new(Gpu::new(&GpuOptions::default())?)?;
    let line = Line::new("rendering");
    runner.context.progress = line.listener();
    let request = Request { sinks: Sinks::Only(Vec::new()), watch, size: Some(SIZE), ..Request::default() };
    let report = runner.evaluate(&mut Evaluator::new(), &network, &request)?;
    drop(line);
    if !report.is_complete() {
        return Err(problems::failure(&network, &report));
    }
    match runner.assembled(processor) {
        Some(assembled) => Ok(annotated(assembled)),
        None => {
            let type_id = network.processor(processor).map_or("", Processor::type_id);
            Err(Failure::new(format!("`{processor}` (a {type_id}) assembles no shader; {}", traversals(&network))))
        }
    }
}

/// The outports of a processor that something is connected to, else the first one.
fn used_outports(network: &Network, id: &str) -> Result<Vec<Address>, Failure> {
    let Some(processor) = network.processor(id) else {
        let ids: Vec<&str> = network.processors().map(Processor::id).collect();
        let near = closest(id, ids.iter().copied());
        let (lead, names) = if near.is_empty() { ("there are", ids) } else { ("did you mean", near) };
        return Err(Failure::new(format!("there is no processor `{id}`; {lead}: `{}`", names.join("`, `"))));
    };
    let used: Vec<Address> = network.outputs(id).map(|connection| connection.from.clone()).collect();
    let first = processor.declaration().and_then(|declaration: &Declaration| declaration.outports.first());
    Ok(match (used.is_empty(), first) {
        (true, Some(port)) => vec![Address::new(id, &port.id)],
        _ => used,
    })
}

fn traversals(network: &Network) -> String {
    let is_traversal = |processor: &&Processor| processor.type_id() == types::RAY_TRAVERSAL;
    let ids: Vec<&str> = network.processors().filter(is_traversal).map(Processor::id).collect();
    match ids.is_empty() {
        true => "the network has no ray_traversal, which does".to_owned(),
        false => format!("ask for `{}`", ids.join("` or `")),
    }
}

/// The text with a comment wherever another file, or another place of the same file, begins.
fn annotated(assembled: &Assembled) -> String {
    let mut text = String::new();
    let mut last: Option<(&Arc<str>, u32)> = None;
    for (line, origin) in assembled.text.lines().zip(assembled.map.lines()) {
        let goes_on = last.is_some_and(|(file, number)| *file == origin.file && number + 1 == origin.line);
        if !goes_on {
            text += &format!("// --- {}:{}\n", origin.file, origin.line);
        }
        text += line;
        text.push('\n');
        last = Some((&origin.file, origin.line));
    }
    text
}
