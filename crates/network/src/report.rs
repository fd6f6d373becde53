//! What to evaluate, and what came of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::time::Duration;

use serde_json::Value as Json;

use crate::job::{ProcessError, Unfinished};
use crate::names::Address;
use crate::property::Level;

/// What to evaluate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// The sinks to bring up to date.
    pub sinks: Sinks,
    /// Outports that someone looks at; computed although nothing is connected. Unknown ones are ignored.
    pub watch: Vec<Address>,
    /// Render size for every sink, in place of its own.
    pub size: Option<[u32; 2]>,
    /// Render sizes of single sinks, in place of all others.
    pub sizes: BTreeMap<String, [u32; 2]>,
}

/// A selection of sinks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Sinks {
    /// Every sink of the network.
    #[default]
    All,
    /// Those with these ids; others are ignored.
    Only(Vec<String>),
}

/// Why a processor ran.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// It has no result yet.
    FirstRun,
    /// A property has another value.
    Property(Address),
    /// It has other properties than before (the parameters of its snippets changed).
    Parameters(String),
    /// The data at an inport was computed anew.
    Input {
        /// The inport.
        inport: String,
        /// The processor that ran.
        source: String,
    },
    /// Other outports feed an inport than before; none if empty.
    Connection {
        /// The inport.
        inport: String,
        /// The outports that feed it now.
        sources: Vec<Address>,
    },
    /// Something consumes an outport that nothing consumed before.
    Output(String),
    /// The render size is another.
    Size([u32; 2]),
    /// Its last result was a first one ([`Unfinished`]), and it goes on.
    Refines,
    /// Someone asked for it ([`crate::Evaluator::invalidate`]).
    Asked(String),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FirstRun => f.write_str("first run"),
            Self::Property(address) => write!(f, "{address} changed"),
            Self::Parameters(processor) => write!(f, "the parameters of {processor} changed"),
            Self::Input { inport, source } => write!(f, "input `{inport}` changed ({source} ran)"),
            Self::Connection { inport, sources } if sources.is_empty() => {
                write!(f, "input `{inport}` is no longer connected")
            }
            Self::Connection { inport, sources } => {
                let sources = sources.iter().map(Address::to_string).collect::<Vec<_>>().join(", ");
                write!(f, "input `{inport}` now comes from {sources}")
            }
            Self::Output(outport) => write!(f, "output `{outport}` is now used"),
            Self::Size([width, height]) => write!(f, "size changed to {width}x{height}"),
            Self::Refines => f.write_str("refines its first result"),
            Self::Asked(why) => f.write_str(why),
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With data on every wanted outport.
    Done,
    /// With an error.
    Failed(ProcessError),
}

/// One run of one processor.
#[derive(Clone, Debug)]
pub struct Run {
    /// The processor.
    pub processor: String,
    /// Why it ran.
    pub reasons: Vec<Reason>,
    /// How much was stale: the highest level among the reasons.
    pub level: Level,
    /// Time on the processor's thread.
    pub cpu: Duration,
    /// Time on the GPU, where it can be measured.
    pub gpu: Option<Duration>,
    /// How it ended.
    pub outcome: Outcome,
    /// Things the user should know.
    pub notes: Vec<String>,
    /// Numbers for tests and tools.
    pub statistics: serde_json::Map<String, Json>,
}

impl Run {
    /// The reasons as one line.
    pub fn why(&self) -> String {
        self.reasons.iter().map(Reason::to_string).collect::<Vec<_>>().join(", ")
    }
}

/// What an evaluation did.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The processors that were needed, each after those that feed it.
    pub needed: Vec<String>,
    /// Processors that were not needed and whose last result is no longer what they would give now.
    pub stale: BTreeSet<String>,
    /// The runs, in order; empty when everything was up to date.
    pub runs: Vec<Run>,
    /// Processors that were needed but are not ready, with the reasons, each a chain down to its cause.
    pub not_ready: BTreeMap<String, Vec<String>>,
    /// Processors that were needed and failed, now or at an earlier evaluation with the same inputs and properties.
    pub failed: BTreeMap<String, ProcessError>,
    /// Processors that were needed and whose result is a first one: another evaluation goes on ([`crate::Evaluator::finish`]).
    pub unfinished: BTreeMap<String, Unfinished>,
    /// Whether the evaluation was interrupted ([`crate::Backend::interrupted`]), so that some of what was needed did not run.
    pub interrupted: bool,
    /// Time for the whole evaluation.
    pub elapsed: Duration,
}

impl Report {
    /// Whether everything that was needed has its final result.
    pub fn is_complete(&self) -> bool {
        self.not_ready.is_empty() && self.failed.is_empty() && self.unfinished.is_empty() && !self.interrupted
    }

    /// Ids of the processors that ran, in order.
    pub fn ran(&self) -> Vec<&str> {
        self.runs.iter().map(|run| run.processor.as_str()).collect()
    }
}
