//! Measuring for the benches. Nothing here is asserted in a test: times on shared machines are noise.

use rayloom_network::{Level, Request, Sinks};

use crate::Workbench;

/// Median, 5 and 95 % of some measurements.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// Middle value.
    pub median: f64,
    /// 5 % lie below.
    pub low: f64,
    /// 5 % lie above.
    pub high: f64,
}

impl Summary {
    /// Of at least one measurement.
    pub fn of(samples: &[f64]) -> Self {
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share).round() as usize];
        Self { median: at(0.5), low: at(0.05), high: at(0.95) }
    }

    /// Of the ratios of paired measurements.
    pub fn of_ratios(numerators: &[f64], denominators: &[f64]) -> Self {
        let ratios: Vec<f64> = numerators.iter().zip(denominators).map(|(a, b)| a / b).collect();
        Self::of(&ratios)
    }
}

impl std::fmt::Display for Summary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.3} (5 % {:.3}, 95 % {:.3})", self.median, self.low, self.high)
    }
}

/// GPU time in milliseconds of one more run of a processor alone; everything upstream is kept.
///
/// # Panics
/// When it fails or the device cannot measure time.
pub fn time_again(bench: &mut Workbench, processor: &str, outport: &str, size: [u32; 2]) -> f64 {
    bench.evaluator.invalidate(processor, Level::Result, "measured again");
    let request = Request {
        watch: vec![(processor, outport).into()],
        sinks: Sinks::Only(Vec::new()),
        size: Some(size),
        ..Request::default()
    };
    let report = bench.evaluate(&request);
    assert!(report.is_complete(), "{report:?}");
    let run = report.runs.iter().find(|run| run.processor == processor);
    run.and_then(|run| run.gpu).unwrap_or_else(|| panic!("no time was measured: {report:?}")).as_secs_f64() * 1e3
}

/// Samples that the traversal `traversal` takes for the picture of its first output.
pub fn samples(bench: &mut Workbench, size: [u32; 2]) -> u64 {
    bench.runner.count_samples(true);
    bench.evaluator.invalidate("traversal", Level::Shader, "counted");
    let request = Request {
        watch: vec![("traversal", "image").into()],
        sinks: Sinks::Only(Vec::new()),
        size: Some(size),
        ..Request::default()
    };
    let report = bench.evaluate(&request);
    bench.runner.count_samples(false);
    bench.evaluator.invalidate("traversal", Level::Shader, "no longer counted");
    let run = report.runs.iter().find(|run| run.processor == "traversal");
    run.and_then(|run| run.statistics.get("samples")).and_then(|count| count.as_u64()).unwrap_or_default()
}
