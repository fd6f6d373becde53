//! `rayloom render`: evaluates a network and writes a picture.

use std::time::Instant;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Evaluator, Network, Report};
use rayloom_processors::{Data, Picture, Runner, write_picture};

use crate::args::RenderArgs;
use crate::failure::{Failure, check_folder};
use crate::network_file;
use crate::problems;
use crate::progress::Line;
use crate::reference;
use crate::stats::Stats;
use crate::target::Target;

/// Renders one picture and returns where it is.
///
/// # Errors
/// The network cannot be loaded or changed as asked, has no such image, or a processor that the image needs fails.
pub fn run(args: &RenderArgs) -> Result<String, Failure> {
    let start = Instant::now();
    let files = [Some(&args.output), args.stats.as_ref()];
    files.into_iter().flatten().try_for_each(|file| check_folder(file))?;
    let network = network_file::open_with(&args.network, args.preset.as_deref(), &args.set)?;
    if let Some(reference) = args.reference {
        return reference::render(&network, args, reference);
    }
    let target = Target::find(&network, args.port.as_ref(), args.size)?;
    let gpu = Gpu::new(&GpuOptions::default())?;
    let adapter = gpu.describe();
    let mut runner = Runner::new(gpu)?;
    runner.measure(args.stats.is_some());
    runner.count_samples(args.stats.is_some());
    let mut evaluator = Evaluator::new();
    let mut drawn = evaluate(&network, &target, &mut runner, &mut evaluator);
    if drawn.is_err() && runner.context.gpu.is_lost() {
        drawn = evaluate(&network, &target, &mut runner, &mut evaluator);
    }
    let (picture, report) = drawn?;
    write_picture(&args.output, &picture)?;
    for (processor, note) in report.runs.iter().flat_map(|run| run.notes.iter().map(|note| (&run.processor, note))) {
        eprintln!("note: {processor}: {note}");
    }
    if let Some(file) = &args.stats {
        Stats::new(&network, &report, adapter, picture.size, start.elapsed()).write(file)?;
    }
    let [width, height] = picture.size;
    Ok(format!("{}: {width} x {height} pixels\n", args.output.display()))
}

/// Evaluates what the target needs and fetches its image.
fn evaluate(
    network: &Network,
    target: &Target,
    runner: &mut Runner,
    evaluator: &mut Evaluator<Runner>,
) -> Result<(Picture, Report), Failure> {
    let line = Line::new("rendering");
    runner.context.progress = line.listener();
    let report = runner.evaluate(evaluator, network, &target.request)?;
    let port = &target.outport;
    match evaluator.output(&port.processor, &port.item) {
        Some(Data::Image(image)) => Ok((image.read_back(&runner.context)?, report)),
        Some(_) => Err(Failure::new(format!("{port} holds no image; choose another port"))),
        None => Err(problems::failure(network, &report)),
    }
}
