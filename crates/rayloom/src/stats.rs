//! What an evaluation did, as JSON: the file of `--stats`.

use std::path::Path;
use std::time::Duration;

use rayloom_network::{Network, Report, Run};
use serde::Serialize;
use serde_json::{Map, Value as Json};

use crate::failure::Failure;

/// The contents of the file.
#[derive(Debug, Serialize)]
pub struct Stats {
    /// Version of the program.
    rayloom: &'static str,
    /// Name, kind, interface and driver of the graphics adapter.
    adapter: String,
    /// Width and height of the picture, pixels.
    size: [u32; 2],
    /// The processors that ran, in the order in which they did.
    processors: Vec<ProcessorRun>,
    /// Rays that were walked, over all ray traversals.
    rays: u64,
    /// Samples that were taken.
    samples: u64,
    /// Samples that changed the picture.
    contributing: u64,
    /// Time from the start of the program until the picture was written, milliseconds.
    total_ms: f64,
}

/// One run of one processor.
#[derive(Debug, Serialize)]
struct ProcessorRun {
    id: String,
    #[serde(rename = "type")]
    type_id: String,
    /// Why it ran.
    reasons: Vec<String>,
    /// How much was stale: result, parameters, shader or ports.
    level: String,
    /// Time on the CPU, waiting included, milliseconds.
    cpu_ms: f64,
    /// Time on the GPU, milliseconds; null where it cannot be measured.
    gpu_ms: Option<f64>,
    notes: Vec<String>,
    /// Further numbers of this processor.
    #[serde(skip_serializing_if = "Map::is_empty")]
    statistics: Map<String, Json>,
}

impl Stats {
    /// The statistics of one evaluation of a network.
    pub fn new(network: &Network, report: &Report, adapter: String, size: [u32; 2], total: Duration) -> Self {
        let sum =
            |key: &str| report.runs.iter().filter_map(|run| run.statistics.get(key)).filter_map(Json::as_u64).sum();
        Self {
            rayloom: env!("CARGO_PKG_VERSION"),
            adapter,
            size,
            processors: report.runs.iter().map(|run| ProcessorRun::new(network, run)).collect(),
            rays: sum("rays"),
            samples: sum("samples"),
            contributing: sum("contributing"),
            total_ms: milliseconds(total),
        }
    }

    /// Writes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, file: &Path) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        rayloom_files::write(file, text.as_bytes())
            .map_err(|error| Failure::new(format!("{}: cannot be written: {error}", file.display())))
    }
}

impl ProcessorRun {
    fn new(network: &Network, run: &Run) -> Self {
        Self {
            id: run.processor.clone(),
            type_id: network.processor(&run.processor).map(|p| p.type_id().to_owned()).unwrap_or_default(),
            reasons: run.reasons.iter().map(ToString::to_string).collect(),
            level: run.level.to_string(),
            cpu_ms: milliseconds(run.cpu),
            gpu_ms: run.gpu.map(milliseconds),
            notes: run.notes.clone(),
            statistics: run.statistics.clone(),
        }
    }
}

/// Rounded to microseconds, which is what clocks can tell.
fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}
