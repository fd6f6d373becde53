//! `rayloom measure`: the trade of speed for accuracy.

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::{Measurements, Plan, measure, write_all};

use crate::args::MeasureArgs;
use crate::failure::Failure;
use crate::network_file;
use crate::progress::Line;
use crate::reference;

/// Measures and returns what to choose, and where the files are.
///
/// # Errors
/// The network cannot be loaded or measured, or a file cannot be written.
pub fn run(args: &MeasureArgs) -> Result<String, Failure> {
    let network = network_file::open(&args.network, &args.set)?;
    let plan = Plan {
        origin: args.network.display().to_string(),
        port: args.port.clone(),
        vary: args.vary.clone(),
        ladders: args.ladder.clone(),
        views: args.views.into(),
        rounds: args.rounds.into(),
        size: args.size,
        standard: args.reference,
        budget: !args.no_budget,
    };
    let gpu = Gpu::new(&GpuOptions::default())?;
    let line = Line::new("measuring");
    let listener = |what: &str, share: f64| line.share(what, share);
    let measurements = measure(&network, &plan, gpu, &reference::cache(args.cache.as_deref()), &listener)?;
    drop(line);
    let files = write_all(&args.output, &measurements)?;
    let files: String = files.iter().map(|file| format!("{}\n", file.display())).collect();
    Ok(format!("{}\n{}{files}", measurements.advice, refused(&measurements)))
}

/// The settings that cannot be rendered, a line each.
fn refused(measurements: &Measurements) -> String {
    let line = |one: &rayloom_measure::Refused| {
        let reason = one.reason.lines().next().unwrap_or_default();
        format!("refused: {}: {reason}\n", one.setting.name)
    };
    measurements.refused.iter().map(line).collect()
}
