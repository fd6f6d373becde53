//! `rayloom probe`: what a ray traversal meets along the ray of one pixel.

use std::fmt::Write;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Address, Evaluator, Network, Processor};
use rayloom_processors::{Runner, Trace, types};

use crate::args::ProbeArgs;
use crate::failure::Failure;
use crate::network_file;
use crate::problems;
use crate::progress::Line;
use crate::target::Target;

/// Follows the ray of a pixel; returns the samples as CSV, or where they were written.
///
/// # Errors
/// As for rendering; several traversals to choose from; a pixel outside of the picture.
pub fn run(args: &ProbeArgs) -> Result<String, Failure> {
    let network = network_file::open(&args.network, &args.set)?;
    let id = traversal(&network, args.processor.as_deref())?;
    let target = Target::find(&network, Some(&Address::new(&id, "image")), args.size)?;
    let mut runner = Runner::new(Gpu::new(&GpuOptions::default())?)?;
    let line = Line::new("rendering");
    runner.context.progress = line.listener();
    let report = runner.evaluate(&mut Evaluator::new(), &network, &target.request)?;
    drop(line);
    if !report.is_complete() {
        return Err(problems::failure(&network, &report));
    }
    let trace = runner.trace(&id, args.pixel).map_err(|error| Failure::new(error.message))?;
    if let Some(reason) = trace.absence() {
        eprintln!("note: {reason}");
    }
    if trace.truncated() > 0 {
        eprintln!("note: the last {} of {} samples did not fit", trace.truncated(), trace.taken);
    }
    let table = table(&trace);
    let Some(file) = &args.output else { return Ok(table) };
    rayloom_files::write(file, table.as_bytes())
        .map_err(|error| Failure::new(format!("{} cannot be written: {error}", file.display())))?;
    Ok(format!("{}: {} of {} samples\n", file.display(), trace.samples.len(), trace.count))
}

/// The processor asked for, or the only ray traversal.
fn traversal(network: &Network, asked: Option<&str>) -> Result<String, Failure> {
    let is_traversal = |processor: &&Processor| processor.type_id() == types::RAY_TRAVERSAL;
    let ids: Vec<&str> = network.processors().filter(is_traversal).map(Processor::id).collect();
    match (asked, &ids[..]) {
        (Some(asked), _) if ids.contains(&asked) => Ok(asked.to_owned()),
        (None, [only]) => Ok((*only).to_owned()),
        (_, []) => Err(Failure::new("the network has no ray traversal, so there are no rays to follow")),
        (Some(asked), _) => {
            Err(Failure::new(format!("`{asked}` is no ray traversal; there are `{}`", ids.join("`, `"))))
        }
        (None, _) => Err(Failure::new(format!(
            "the network has several ray traversals; choose one with --processor: `{}`",
            ids.join("`, `")
        ))),
    }
}

/// One row a sample. Columns that the shader does not compute are left out.
fn table(trace: &Trace) -> String {
    let first = trace.samples.first();
    let mut header = "sample,distance,x,y,z,value".to_owned();
    let mut vector = |name: &str, there: bool, parts: &str| {
        for part in parts.split(' ').filter(|_| there) {
            header += &format!(",{name}{part}");
        }
    };
    vector("gradient", first.is_some_and(|sample| sample.gradient.is_some()), "");
    vector("classified_", first.is_some_and(|sample| sample.classified.is_some()), "r g b extinction");
    vector("shaded_", first.is_some_and(|sample| sample.shaded.is_some()), "r g b extinction");
    for output in &trace.outputs {
        vector(&format!("{}_", output.outport), true, "r g b a");
    }
    let mut text = header + "\n";
    for sample in &trace.samples {
        let [x, y, z] = sample.position;
        let numbers = [sample.distance, x, y, z, sample.value].into_iter().chain(sample.gradient);
        let colors = sample.classified.iter().chain(&sample.shaded).chain(&sample.accumulated).flatten();
        let row = numbers.map(|number| number.to_string()).chain(colors.map(|number| number.to_string()));
        // Writing to a text cannot fail.
        let _ = writeln!(text, "{},{}", sample.index, row.collect::<Vec<_>>().join(","));
    }
    text
}
