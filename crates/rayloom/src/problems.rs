//! Turns what an evaluation could not do into one message, the root cause first.

use rayloom_network::{Network, Outcome, Report};

use crate::failure::Failure;

/// The failures of an evaluation in the order in which they happened, then what could not run on their account.
pub fn failure(network: &Network, report: &Report) -> Failure {
    let mut causes: Vec<String> = report
        .runs
        .iter()
        .filter_map(|run| match &run.outcome {
            Outcome::Failed(error) => Some(format!("{} failed: {error}", named(network, &run.processor))),
            Outcome::Done => None,
        })
        .collect();
    let mut waiting = Vec::new();
    for id in network.order() {
        // A chain that begins with the processor itself is a cause of its own.
        let own = format!("{id}: ");
        let Some(chains) = report.not_ready.get(id) else { continue };
        let mut own_causes = chains.iter().filter(|chain| chain.starts_with(&own)).cloned().peekable();
        if own_causes.peek().is_none() {
            waiting.push(format!("`{id}`"));
        }
        causes.extend(own_causes);
    }
    if !waiting.is_empty() {
        causes.push(format!("so there is no result from {}", waiting.join(", ")));
    }
    Failure::new(causes.join("\n"))
}

/// A processor with its type: "`source` (volume_source)".
fn named(network: &Network, id: &str) -> String {
    match network.processor(id) {
        Some(processor) => format!("`{id}` ({})", processor.type_id()),
        None => format!("`{id}`"),
    }
}
