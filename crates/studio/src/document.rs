//! The network being edited: its file, and whether it is saved.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use rayloom_network::{Address, LoadError, Network, Registry, Warning};

use crate::history::History;

/// The network being edited. Every change goes through [`Document::edit`], so every change can be undone.
pub struct Document {
    network: Network,
    path: Option<PathBuf>,
    history: History,
    /// Text of the network now, with whole paths.
    current: String,
    /// The network as last saved or loaded, with its text; `None` when there is no such file any more.
    saved: Option<(Network, String)>,
    /// Properties that users of an application changed to look around: they are nothing to be saved.
    looked: BTreeSet<Address>,
    /// Properties of the same kind that the author changed.
    kept: BTreeSet<Address>,
    /// Whether there is anything that is not saved.
    modified: bool,
    /// Another after every change of the network.
    revision: u64,
}

impl Document {
    /// An empty, unnamed network.
    pub fn new(registry: Arc<Registry>) -> Self {
        Self::of(Network::new(registry), None)
    }

    fn of(network: Network, path: Option<PathBuf>) -> Self {
        let current = network.to_text(None);
        let saved = Some((network.clone(), current.clone()));
        let (history, revision) = (History::default(), new_revision());
        let (looked, kept) = (BTreeSet::new(), BTreeSet::new());
        Self { network, path, history, current, saved, looked, kept, modified: false, revision }
    }

    /// Loads a network file; the warnings are about things kept but not understood.
    ///
    /// # Errors
    /// The file cannot be read, or is no network.
    pub fn load(path: &Path, registry: &Arc<Registry>) -> Result<(Self, Vec<Warning>), LoadError> {
        let loaded = Network::load(path, registry)?;
        Ok((Self::of(loaded.network, Some(path.to_owned())), loaded.warnings))
    }

    /// A network that no file has as it is: recovered after the program ended without saving it.
    pub fn unsaved(network: Network, path: Option<PathBuf>) -> Self {
        Self { saved: None, modified: true, ..Self::of(network, path) }
    }

    /// Takes note that `network` was saved to a file, which becomes the document's own. The document may have changed since.
    pub fn saved_as(&mut self, path: PathBuf, network: &Network) {
        self.path = Some(path);
        self.saved = Some((network.clone(), network.to_text(None)));
        self.looked.clear();
        self.kept.clear();
        self.compare();
    }

    /// Whether a network is what was last saved or loaded.
    pub fn is_saved_as(&self, network: &Network) -> bool {
        self.saved.as_ref().is_some_and(|(_, text)| *text == network.to_text(None))
    }

    /// Takes note that these properties were changed only to look around: they are nothing to be saved, unless the author
    /// changed them, too.
    pub fn look(&mut self, properties: impl IntoIterator<Item = Address>) {
        self.looked.extend(properties.into_iter().filter(|address| !self.kept.contains(address)));
        self.compare();
    }

    /// Takes note that the author changed these properties.
    pub fn keep(&mut self, properties: impl IntoIterator<Item = Address>) {
        for address in properties {
            self.looked.remove(&address);
            self.kept.insert(address);
        }
        self.compare();
    }

    /// Finds out whether there is anything that is not saved.
    fn compare(&mut self) {
        self.modified = match &self.saved {
            None => true,
            Some((_, text)) if *text == self.current => false,
            Some(_) if self.looked.is_empty() => true,
            Some((saved, text)) => {
                let mut network = self.network.clone();
                for Address { processor, item } in &self.looked {
                    if let Some(value) = saved.value(processor, item) {
                        // What is gone or refused now is a change in any case.
                        let _ = network.set_property(processor, item, value);
                    }
                }
                network.to_text(None) != *text
            }
        }
    }

    /// The network.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// Its file, once it has one.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// What to call it: its file's name, or that it has none.
    pub fn title(&self) -> String {
        let name = self.path().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        name.unwrap_or_else(|| "unnamed".into())
    }

    /// A number that grows with every change, and that no other document has.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What would be saved.
    pub fn text(&self) -> String {
        self.network.to_text(self.path.as_deref().and_then(Path::parent))
    }

    /// Whether there is anything that is not saved.
    pub fn is_modified(&self) -> bool {
        self.modified
    }

    /// Changes the network. A change that fails, or changes nothing, leaves no trace.
    ///
    /// # Errors
    /// Those of `change`.
    pub fn edit<T, E>(&mut self, label: &str, change: impl FnOnce(&mut Network) -> Result<T, E>) -> Result<T, E> {
        self.step(label, None, change)
    }

    /// Like [`Document::edit`], but merged with the steps just before it that have the same key, until
    /// [`Document::settle`]: dragging a slider is one step.
    ///
    /// # Errors
    /// Those of `change`.
    pub fn edit_merged<T, E>(
        &mut self,
        label: &str,
        key: &str,
        change: impl FnOnce(&mut Network) -> Result<T, E>,
    ) -> Result<T, E> {
        self.step(label, Some(key.to_owned()), change)
    }

    /// Changes the network as a part of what was done last: no step of its own to be undone.
    ///
    /// # Errors
    /// Those of `change`.
    pub fn amend<T, E>(&mut self, change: impl FnOnce(&mut Network) -> Result<T, E>) -> Result<T, E> {
        let mut after = self.network.clone();
        let result = change(&mut after)?;
        self.network = after;
        self.current = self.network.to_text(None);
        self.revision = new_revision();
        self.compare();
        Ok(result)
    }

    fn step<T, E>(
        &mut self,
        label: &str,
        key: Option<String>,
        change: impl FnOnce(&mut Network) -> Result<T, E>,
    ) -> Result<T, E> {
        let mut after = self.network.clone();
        let result = change(&mut after)?;
        let text = after.to_text(None);
        if text == self.current {
            return Ok(result);
        }
        let before = std::mem::replace(&mut self.network, after);
        self.current = text;
        self.revision = new_revision();
        self.history.record(before, label, key);
        self.compare();
        Ok(result)
    }

    /// Ends merging: the next edit is a step of its own.
    pub fn settle(&mut self) {
        self.history.settle();
    }

    /// What undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.history.undo_label()
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.history.redo_label()
    }

    /// Takes the last step back. Whether there was one.
    pub fn undo(&mut self) -> bool {
        let travelled = self.history.undo(&mut self.network);
        self.arrive(travelled)
    }

    /// Does the last step taken back again. Whether there was one.
    pub fn redo(&mut self) -> bool {
        let travelled = self.history.redo(&mut self.network);
        self.arrive(travelled)
    }

    fn arrive(&mut self, travelled: bool) -> bool {
        if travelled {
            self.current = self.network.to_text(None);
            self.revision = new_revision();
            self.compare();
        }
        travelled
    }
}

/// A number that no state of any document had in this run of the program.
fn new_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}

#[cfg(test)]
mod tests {
    use rayloom_processors::registry;
    use serde_json::json;

    use super::*;

    fn document() -> Document {
        let mut document = Document::new(Arc::new(registry()));
        document.edit("add", |network| network.add("ray_traversal", "traversal")).expect("added");
        document
    }

    fn set_rate(document: &mut Document, rate: f64) {
        let set = |network: &mut Network| network.set_from_json("traversal", "sampling_rate", &json!(rate));
        document.edit_merged("sampling rate", "traversal.sampling_rate", set).expect("set");
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut document = document();
        let before = document.text();
        for rate in [1.5, 2.0, 2.5] {
            set_rate(&mut document, rate);
        }
        document.settle();
        set_rate(&mut document, 4.0);
        let after = document.text();
        assert!(document.undo() && document.undo());
        assert_eq!(document.text(), before);
        assert!(document.redo() && document.redo() && !document.redo());
        assert_eq!(document.text(), after);
    }

    #[test]
    fn edits_that_fail_or_change_nothing_leave_no_trace() {
        let mut document = document();
        let (revision, text) = (document.revision(), document.text());
        assert!(document.edit("bad", |network| network.add("no such type", "x")).is_err());
        set_rate(&mut document, 1.0);
        assert_eq!((document.revision(), document.text()), (revision, text));
        assert_eq!(document.undo_label(), Some("add"));
    }

    #[test]
    fn saving_and_undoing_tell_what_is_modified() {
        let mut document = document();
        assert!(document.is_modified());
        let being_saved = document.network().clone();
        set_rate(&mut document, 2.0);
        document.saved_as("network.json".into(), &being_saved);
        assert!(document.is_modified(), "it was changed while it was being saved");
        document.undo();
        assert!(!document.is_modified());
        let recovered = Document::unsaved(document.network().clone(), None);
        assert!(recovered.is_modified());
    }
}
