//! Undo and redo: the states of a network that were left, and how one goes back to them.

use rayloom_network::Network;

/// Steps that can be undone at most; a step is a snapshot, which shares nothing but is small.
const STEPS: usize = 500;

/// A state to go back to, and what was done to leave it.
struct Step {
    before: Network,
    label: String,
    /// Edits with the same key, one right after the other, are one step: a drag, a text being typed.
    key: Option<String>,
}

/// The steps that can be undone and those that can be done again.
#[derive(Default)]
pub struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
}

impl History {
    /// Takes note that a network was left. Merged with the step before it if both have the same key.
    pub fn record(&mut self, before: Network, label: &str, key: Option<String>) {
        self.redo.clear();
        let merges = key.is_some() && self.undo.last().is_some_and(|last| last.key == key);
        if !merges {
            self.undo.push(Step { before, label: label.to_owned(), key });
            let surplus = self.undo.len().saturating_sub(STEPS);
            self.undo.drain(..surplus);
        }
    }

    /// Ends merging: the next edit is a step of its own.
    pub fn settle(&mut self) {
        if let Some(last) = self.undo.last_mut() {
            last.key = None;
        }
    }

    /// What undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.last().map(|step| step.label.as_str())
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// Takes the last step back. Whether there was one.
    pub fn undo(&mut self, network: &mut Network) -> bool {
        travel(&mut self.undo, &mut self.redo, network)
    }

    /// Does the last step taken back again. Whether there was one.
    pub fn redo(&mut self, network: &mut Network) -> bool {
        travel(&mut self.redo, &mut self.undo, network)
    }
}

/// Goes where the last step leads, and keeps the step back.
fn travel(from: &mut Vec<Step>, to: &mut Vec<Step>, network: &mut Network) -> bool {
    let Some(step) = from.pop() else { return false };
    let left = std::mem::replace(network, step.before);
    to.push(Step { before: left, label: step.label, key: None });
    true
}
