//! What all panels share: the document, its results, the selection, messages.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use rayloom_network::{Address, EditError, Network, Registry, Request, Sinks, Value};

use crate::display::Display;
use crate::document::Document;
use crate::engine::Engine;
use crate::inspect::Inspection;
use crate::panels::Pane;

/// How the window is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Everything visible and editable.
    #[default]
    Development,
    /// Canvases and what the author exposed, nothing else.
    Visualization,
}

/// How urgent a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Something worth knowing.
    Note,
    /// Something went wrong.
    Error,
}

/// Something the user was told.
#[derive(Clone, Debug)]
pub struct Message {
    /// How urgent.
    pub severity: Severity,
    /// A sentence.
    pub text: String,
    /// When.
    pub when: Instant,
}

/// Messages kept at most.
const MESSAGES: usize = 200;

/// What all panels share.
pub struct Session {
    /// The types of processors there are.
    pub registry: Arc<Registry>,
    /// The network being edited.
    pub document: Document,
    /// Evaluates it.
    pub engine: Engine,
    /// Shows its images.
    pub display: Display,
    /// What is known about data that is looked at.
    pub inspection: Inspection,
    /// Panes that panels ask the window to open, after this frame.
    pub to_open: Vec<Pane>,
    /// Selected processors.
    pub selection: BTreeSet<String>,
    /// What the user was told, oldest first.
    pub messages: Vec<Message>,
    /// How the window is used.
    pub mode: Mode,
    /// Outports that panels look at in this frame; they are computed although nothing may be connected. Filled anew every frame.
    pub watched: BTreeSet<Address>,
    /// Set by a panel in a frame in which the user drags something in a picture: pictures get smaller for the while.
    pub interacting: bool,
    /// The largest canvas in this frame, pixels.
    pub canvas_size: Option<[u32; 2]>,
}

impl Session {
    /// A session with an empty document.
    pub fn new(registry: Arc<Registry>, engine: Engine, display: Display) -> Self {
        Self {
            document: Document::new(registry.clone()),
            registry,
            engine,
            display,
            inspection: Inspection::default(),
            to_open: Vec::new(),
            selection: BTreeSet::new(),
            messages: Vec::new(),
            mode: Mode::default(),
            watched: BTreeSet::new(),
            interacting: false,
            canvas_size: None,
        }
    }

    /// The network.
    pub fn network(&self) -> &Network {
        self.document.network()
    }

    /// Tells the user something.
    pub fn tell(&mut self, severity: Severity, text: impl Into<String>) {
        self.messages.push(Message { severity, text: text.into(), when: Instant::now() });
        let surplus = self.messages.len().saturating_sub(MESSAGES);
        self.messages.drain(..surplus);
    }

    /// Edits the network; what is refused becomes a message. Whether it worked.
    pub fn edit<E: std::fmt::Display>(
        &mut self,
        label: &str,
        change: impl FnOnce(&mut Network) -> Result<(), E>,
    ) -> bool {
        match self.document.edit(label, change) {
            Ok(()) => true,
            Err(error) => {
                self.tell(Severity::Error, error.to_string());
                false
            }
        }
    }

    /// Sets a property; values set in one drag are one step of the history. What is refused becomes a message.
    pub fn set(&mut self, processor: &str, property: &str, value: Value) {
        let address = format!("{processor}.{property}");
        let set = |network: &mut Network| -> Result<(), EditError> {
            network.set_property(processor, property, value).map(|_| ())
        };
        if let Err(error) = self.document.edit_merged(&format!("set {address}"), &address, set) {
            self.tell(Severity::Error, error.to_string());
        }
    }

    /// Opens a network file; the document stays as it is when that fails. Whether it worked.
    pub fn open(&mut self, path: &Path) -> bool {
        match Document::load(path, &self.registry) {
            Ok((document, warnings)) => {
                self.document = document;
                self.selection.clear();
                for warning in warnings {
                    self.tell(Severity::Note, warning.to_string());
                }
                true
            }
            Err(error) => {
                self.tell(Severity::Error, error.to_string());
                false
            }
        }
    }

    /// Saves the document to a file. Whether it worked.
    pub fn save(&mut self, path: &Path) -> bool {
        match self.document.save(path) {
            Ok(()) => true,
            Err(error) => {
                self.tell(Severity::Error, error.to_string());
                false
            }
        }
    }

    /// What this frame wants evaluated.
    pub fn request(&self) -> Request {
        let size = self.canvas_size.map(|size| match self.interacting {
            true => size.map(|pixels| (pixels / 2).max(1)),
            false => size,
        });
        Request { sinks: Sinks::All, watch: self.watched.iter().cloned().collect(), size }
    }
}
