//! What all panels share: the document, its results, the selection, messages.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

use rayloom_network::{Address, EditError, Network, Processor, Registry, Request, Sinks, Value, Warning};
use rayloom_processors::types::{CANVAS, SLICE_VIEW};

use crate::dialogs::Chooser;
use crate::display::Display;
use crate::document::Document;
use crate::engine::Engine;
use crate::first_look::FirstLook;
use crate::inspect::Inspection;
use crate::navigation::Navigation;
use crate::pane::Pane;
use crate::probe::Probe;
use crate::quality::Quality;

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

/// The first picture of a canvas has its resolution divided by this in both directions.
const FIRST: u32 = 4;

/// Messages kept at most.
const MESSAGES: usize = 200;

/// What all panels share.
pub struct Session {
    /// The types of processors there are.
    pub registry: Arc<Registry>,
    /// The network being edited.
    pub document: Document,
    /// Set when another document is shown, until the panels have forgotten what they knew of the last one.
    pub is_new: bool,
    /// Evaluates it.
    pub engine: Engine,
    /// Whom to ask for files.
    pub chooser: Chooser,
    /// Shows its images.
    pub display: Display,
    /// What is known about data that is looked at.
    pub inspection: Inspection,
    /// Whether the error of the picture is estimated when it stands still.
    pub estimating: bool,
    /// What was added here and shows its first data well.
    pub first_look: FirstLook,
    /// The ray that is looked at.
    pub probe: Probe,
    /// Panes that panels ask the window to open, after this frame.
    pub to_open: Vec<Pane>,
    /// Set by a panel that asks the window to open the palette, after this frame.
    pub wants_palette: bool,
    /// Selected processors.
    pub selection: BTreeSet<String>,
    /// What the user was told, oldest first.
    pub messages: Vec<Message>,
    /// How cameras are moved.
    pub navigation: Navigation,
    /// How the window is used.
    pub mode: Mode,
    /// Outports that panels look at in this frame; they are computed although nothing may be connected. Filled anew every frame.
    pub watched: BTreeSet<Address>,
    /// Set by a panel in a frame in which the user moves something that pictures follow: they get smaller for the while.
    pub interacting: bool,
    /// Processors that were changed by the pointer or a key since the pictures were last at rest.
    touched: BTreeSet<String>,
    /// Set by a panel in a frame in which what the user set in motion goes on by itself: it belongs to the same step of the
    /// history.
    pub coasting: bool,
    /// How much smaller.
    pub quality: Quality,
    /// The canvases shown in this frame, with their sizes in pixels. Filled anew every frame.
    pub shown: BTreeMap<String, [u32; 2]>,
    /// Whether anything was coasting in the frame before.
    coasted: bool,
}

impl Session {
    /// A session with an empty document.
    pub fn new(registry: Arc<Registry>, engine: Engine, display: Display) -> Self {
        Self {
            document: Document::new(registry.clone()),
            registry,
            is_new: false,
            engine,
            chooser: Chooser::default(),
            display,
            inspection: Inspection::default(),
            estimating: true,
            first_look: FirstLook::default(),
            probe: Probe::default(),
            to_open: Vec::new(),
            wants_palette: false,
            selection: BTreeSet::new(),
            messages: Vec::new(),
            navigation: Navigation::default(),
            mode: Mode::default(),
            watched: BTreeSet::new(),
            interacting: false,
            touched: BTreeSet::new(),
            coasting: false,
            quality: Quality::default(),
            shown: BTreeMap::new(),
            coasted: false,
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
        let mut changed = Vec::new();
        let set = |network: &mut Network| -> Result<(), EditError> {
            changed = network.set_property(processor, property, value)?;
            Ok(())
        };
        if let Err(error) = self.document.edit_merged(&format!("set {address}"), &address, set) {
            self.tell(Severity::Error, error.to_string());
        }
        let views: Vec<_> = changed.iter().filter(|address| is_view(self.network(), address)).cloned().collect();
        match self.mode {
            Mode::Development => self.document.keep(views),
            Mode::Visualization => self.document.look(views),
        }
        self.touched.extend(changed.into_iter().map(|address: Address| address.processor));
    }

    /// Shows another document in place of the one there is, and what is odd about it.
    pub fn show(&mut self, document: Document, warnings: &[Warning]) {
        self.document = document;
        self.engine.forget();
        self.is_new = true;
        self.selection.clear();
        self.first_look = FirstLook::default();
        for warning in warnings {
            self.tell(Severity::Note, warning.to_string());
        }
    }

    /// To be called at the start of a frame: takes in what was computed, and forgets what the frame before looked at.
    pub fn begin_frame(&mut self) {
        if self.engine.listen() {
            self.quality.learn(&self.engine.results.request, &self.engine.results.report, &self.moving());
        }
        if self.quality.divisor() == 1 && !self.engine.is_busy() {
            self.touched.clear();
        }
        self.interacting = false;
        self.coasted = std::mem::take(&mut self.coasting);
        self.watched.clear();
        self.shown.clear();
        self.engine.ray = None;
        self.probe.begin_frame();
    }

    /// To be called at the end of a frame: asks for what it looked at, and for another frame when pictures are to be refined.
    pub fn end_frame(&mut self, context: &egui::Context) {
        let released = context.input(|input| input.pointer.any_released());
        let moving = self.moving();
        if let Some(rest) = self.quality.notice(self.interacting, released, &moving, Instant::now()) {
            context.request_repaint_after(rest);
        }
        if (released || self.coasted) && !self.coasting {
            self.document.settle();
        }
        let request = self.request();
        let in_a_hurry = self.quality.divisor() > 1;
        self.engine.order(self.document.revision(), self.document.network(), request, in_a_hurry);
        self.display.end_frame();
        self.inspection.end_frame();
    }

    /// The canvases in sight that show what is being changed, with their full sizes: all of them when that is not known.
    fn moving(&self) -> BTreeMap<String, [u32; 2]> {
        let shows = |canvas: &String| upstream(self.network(), canvas).iter().any(|id| self.touched.contains(*id));
        let moving: BTreeMap<_, _> =
            self.shown.iter().filter(|(canvas, _)| shows(canvas)).map(|(id, size)| (id.clone(), *size)).collect();
        if moving.is_empty() { self.shown.clone() } else { moving }
    }

    /// What this frame wants evaluated: the canvases in sight, each at its own size, and every sink that is no canvas. While
    /// no canvas is in sight all of them count, so that mistakes are still told.
    pub fn request(&self) -> Request {
        let mut sizes = self.shown.clone();
        sizes.extend(self.quality.sizes(&self.moving()));
        // The first picture is soon there, and the next one is exact.
        let first = |id: &String| !self.engine.results.canvases.contains_key(id);
        for (_, size) in sizes.iter_mut().filter(|(id, _)| first(id)) {
            *size = size.map(|pixels| pixels.div_ceil(FIRST));
        }
        let wanted = |sink: &Processor| sink.type_id() != CANVAS || self.shown.contains_key(sink.id());
        let sinks = match self.shown.is_empty() {
            true => Sinks::All,
            false => {
                Sinks::Only(self.network().processors().filter(|p| wanted(p)).map(|p| p.id().to_owned()).collect())
            }
        };
        Request { sinks, watch: self.watched.iter().cloned().collect(), size: None, sizes }
    }
}

/// Whether a property says from where something is looked at, not what it is.
fn is_view(network: &Network, address: &Address) -> bool {
    let Some(processor) = network.processor(&address.processor) else { return false };
    let slice = ["position", "zoom", "pan", "offset"];
    match processor.properties().get(&address.item) {
        Some(Value::Camera(_)) => true,
        _ => processor.type_id() == SLICE_VIEW && slice.contains(&address.item.as_str()),
    }
}

/// A processor and all that feeds it.
pub(crate) fn upstream<'a>(network: &'a Network, processor: &'a str) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let mut stack = vec![processor];
    while let Some(id) = stack.pop() {
        if found.insert(id) {
            stack.extend(network.inputs(id).map(|connection| connection.from.processor.as_str()));
        }
    }
    found
}
