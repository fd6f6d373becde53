//! One run of one processor, as the evaluator asks a backend for it.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use serde_json::Value as Json;

use crate::names::Address;
use crate::port::Facts;
use crate::processor::ProcessorType;
use crate::properties::Properties;
use crate::property::Level;
use crate::report::Reason;

/// Runs processors.
pub trait Backend {
    /// What flows through connections; cloning must be cheap (a handle).
    type Data: Clone;

    /// What conditions and hints may know about the data.
    fn facts(&self, data: &Self::Data) -> Facts;

    /// Runs one processor.
    ///
    /// # Errors
    /// Why it failed; the error is shown on the processor and the rest of the network goes on.
    fn process(&mut self, job: &Job<'_, Self::Data>) -> Result<Outputs<Self::Data>, ProcessError>;

    /// Whether nobody waits any more for what is being evaluated. Asked before every processor and after one that failed: such a
    /// failure does not count, the evaluation ends, and what has run stays.
    fn interrupted(&self) -> bool {
        false
    }
}

/// Data at an inport.
#[derive(Clone, Debug)]
pub struct Input<D> {
    /// The data.
    pub data: D,
    /// The outport it comes from.
    pub from: Address,
    /// Changes whenever the data was computed anew; never repeats within an evaluator.
    pub revision: u64,
}

/// Data by inport, sorted by where it comes from; inports without a connection are absent.
pub type Inputs<D> = BTreeMap<String, Vec<Input<D>>>;

/// Everything a processor needs for one run.
pub struct Job<'a, D> {
    /// Id of the processor, unique in its network.
    pub id: &'a str,
    /// Its type.
    pub processor_type: &'a Arc<dyn ProcessorType>,
    /// All properties, defaults filled in, parameters of chosen snippets included.
    pub properties: &'a Properties,
    /// Data by inport, sorted by where it comes from; inports without a connection are absent.
    pub inputs: &'a Inputs<D>,
    /// Outports that something consumes; the others need not be computed.
    pub wanted: &'a BTreeSet<String>,
    /// Render size, width and height in pixels.
    pub size: [u32; 2],
    /// How much is stale at most.
    pub level: Level,
    /// Why it runs.
    pub reasons: &'a [Reason],
}

impl<D> Job<'_, D> {
    /// The (first) data at an inport; `None` without a connection.
    pub fn input(&self, inport: &str) -> Option<&D> {
        self.inputs.get(inport)?.first().map(|input| &input.data)
    }

    /// All data at an inport with where each comes from, sorted by that: the order in which wires were made changes nothing.
    pub fn inputs(&self, inport: &str) -> &[Input<D>] {
        self.inputs.get(inport).map_or(&[], Vec::as_slice)
    }

    /// Whether nothing changed since the last run, whose result was [`Unfinished`]: the processor may go on from there.
    pub fn refines(&self) -> bool {
        self.reasons == [Reason::Refines]
    }

    /// Whether something consumes this outport.
    pub fn wants(&self, outport: &str) -> bool {
        self.wanted.contains(outport)
    }
}

/// Says that what a run gave is a first result, and that another run goes on from there.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfinished {
    /// How much of the work is done: at least 0, below 1, and more after every run.
    pub share: f64,
    /// What the result is and what is still to come, a sentence for the user.
    pub message: String,
}

/// What a run gives.
#[derive(Clone, Debug)]
pub struct Outputs<D> {
    /// Data by outport; at least the wanted ones.
    pub data: BTreeMap<String, D>,
    /// Time on the GPU, where it can be measured.
    pub gpu_time: Option<Duration>,
    /// Things the user should know ("the volume was reduced to 8 bits").
    pub notes: Vec<String>,
    /// Numbers for tests and tools ("samples").
    pub statistics: serde_json::Map<String, Json>,
    /// Whether the data is a first result only. What it feeds runs with it, and the next evaluation goes on.
    pub unfinished: Option<Unfinished>,
}

impl<D> Default for Outputs<D> {
    fn default() -> Self {
        Self {
            data: BTreeMap::new(),
            gpu_time: None,
            notes: Vec::new(),
            statistics: serde_json::Map::new(),
            unfinished: None,
        }
    }
}

impl<D> Outputs<D> {
    /// No data.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the data of an outport.
    #[must_use]
    pub fn with(mut self, outport: impl Into<String>, data: D) -> Self {
        self.data.insert(outport.into(), data);
        self
    }
}

/// A place in a source text that an error is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// The source: a snippet or file.
    pub source: String,
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
    /// What is wrong there.
    pub message: String,
}

/// Why a run failed. `?` converts any error into it, with its sources; like every such catch-all it is no `Error` itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProcessError {
    /// What was wrong, where, and what to do; complete without the marks.
    pub message: String,
    /// The places in shader or other source text that it is about, for editors.
    pub marks: Vec<Mark>,
}

impl ProcessError {
    /// An error with a message.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), marks: Vec::new() }
    }

    /// An error about places in source text.
    pub fn with_marks(message: impl Into<String>, marks: Vec<Mark>) -> Self {
        Self { message: message.into(), marks }
    }
}

impl fmt::Display for ProcessError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl<E: Error> From<E> for ProcessError {
    fn from(error: E) -> Self {
        let mut message = error.to_string();
        let mut source = error.source();
        while let Some(cause) = source {
            let text = cause.to_string();
            // Many errors already quote their source.
            if !message.contains(&text) {
                message = format!("{message}: {text}");
            }
            source = cause.source();
        }
        Self::new(message)
    }
}
