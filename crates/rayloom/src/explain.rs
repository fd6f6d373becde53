//! `rayloom explain`: what every processor computed, bound, allocated and left out, and why.

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Evaluator, Network, Report, Request, Run};
use rayloom_processors::{Explanation, Role, Runner};
use serde_json::{Value as Json, json};

use crate::args::ExplainArgs;
use crate::explain_settings::Settings;
use crate::failure::Failure;
use crate::network_file;
use crate::problems;
use crate::progress::Line;

/// Evaluates the network once and returns what its processors say.
///
/// # Errors
/// The network cannot be loaded or changed as asked, or a processor fails.
pub fn run(args: &ExplainArgs) -> Result<String, Failure> {
    let network = network_file::open(&args.network, &args.set)?;
    let gpu = Gpu::new(&GpuOptions::default())?;
    let adapter = gpu.describe();
    let mut runner = Runner::new(gpu)?;
    runner.explain(true);
    // Waits for the device after every processor, so that nothing is under way when the program ends.
    runner.measure(true);
    let line = Line::new("rendering");
    runner.context.progress = line.listener();
    let request = Request { size: args.size, ..Request::default() };
    let report = runner.evaluate(&mut Evaluator::new(), &network, &request)?;
    drop(line);
    if !report.is_complete() {
        return Err(problems::failure(&network, &report));
    }
    Ok(match args.json {
        true => serde_json::to_string_pretty(&json(&network, &report, &adapter))? + "\n",
        false => text(&network, &report),
    })
}

fn json(network: &Network, report: &Report, adapter: &str) -> Json {
    let run = |run: &Run| {
        let settings = network.processor(&run.processor).map(|processor| Settings::of(network, processor).to_json());
        json!({"id": run.processor, "type": type_id(network, run), "properties": settings,
            "explanations": Explanation::of(run), "notes": run.notes})
    };
    json!({
        "rayloom": env!("CARGO_PKG_VERSION"),
        "adapter": adapter,
        "processors": report.runs.iter().map(run).collect::<Vec<_>>(),
        "not_needed": idle(network, report),
    })
}

fn text(network: &Network, report: &Report) -> String {
    let mut text = String::new();
    for run in &report.runs {
        text += &format!("{} ({})\n", run.processor, type_id(network, run));
        if let Some(processor) = network.processor(&run.processor) {
            text += &Settings::of(network, processor).to_text();
        }
        let explanations = Explanation::of(run);
        if explanations.is_empty() {
            text += "  nothing of its own: it hands on what it is given\n";
        }
        for role in Role::ALL {
            for one in explanations.iter().filter(|one| one.role == role) {
                let bytes = one.bytes.map(|bytes| format!(", {}", size(bytes))).unwrap_or_default();
                text += &format!("  {:<11}{}{bytes}\n{:13}{}\n", role.label(), one.what, "", one.why);
            }
        }
        for note in &run.notes {
            text += &format!("  note       {note}\n");
        }
        text.push('\n');
    }
    for id in idle(network, report) {
        text += &format!("{id}\n  left out   the whole processor\n{:13}nothing that is shown needs it\n\n", "");
    }
    let all = || report.runs.iter().flat_map(Explanation::of);
    let sum = |role| all().filter(|one| one.role == role).filter_map(|one| one.bytes).sum();
    text + &format!(
        "together: {} of textures and buffers bound, {} of render targets\n",
        size(sum(Role::Bound)),
        size(sum(Role::Allocated))
    )
}

/// Processors that did not run because nothing needs them.
fn idle(network: &Network, report: &Report) -> Vec<String> {
    let ran = report.ran();
    network.order().into_iter().filter(|id| !ran.contains(id)).map(str::to_owned).collect()
}

fn type_id<'a>(network: &'a Network, run: &Run) -> &'a str {
    network.processor(&run.processor).map_or("", |processor| processor.type_id())
}

/// Bytes for people.
fn size(bytes: u64) -> String {
    match bytes as f64 {
        few if few < 1024.0 => format!("{bytes} bytes"),
        some if some < 1024.0 * 1024.0 => format!("{:.1} KiB", some / 1024.0),
        many => format!("{:.1} MiB", many / 1024.0 / 1024.0),
    }
}
