//! The network model: processors, ports, properties, links, evaluation and files. No GPU, no user interface.
//!
//! A [`Network`] holds processors of the types in a [`Registry`], the connections between their ports and the links between
//! their properties. Every edit is checked when it is made and refused with a sentence. An [`Evaluator`] compares the network
//! with what it computed last and asks a [`Backend`] to run exactly the processors whose result would differ.
//! Networks are stored as JSON ([`Network::load`], [`Network::save`]).

mod camera;
mod connect;
mod decl;
mod edit;
mod evaluate;
mod file;
mod frame;
mod indexed;
mod job;
mod json;
mod light;
mod link;
mod names;
mod network;
mod plan;
mod port;
mod preset;
mod processor;
mod properties;
mod property;
mod readiness;
mod registry;
mod report;
mod signature;
mod value;

pub use camera::{Camera, CameraError, Projection};
pub use connect::{Refusal, can_connect};
pub use edit::EditError;
pub use evaluate::Evaluator;
pub use file::{LoadError, Loaded, SaveError, VERSION, Warning};
pub use frame::Frame;
pub use job::{Backend, Input, Inputs, Job, Mark, Outputs, ProcessError, Unfinished};
pub use json::ValueError;
pub use light::{Light, LightError, LightSpace};
pub use link::{Link, LinkRefusal};
pub use names::{Address, AddressError, closest, is_valid_id};
pub use network::{Connection, Network, Processor};
pub use port::{Condition, Facts, ImageKind, InportDecl, OutportDecl, PortType};
pub use preset::Preset;
pub use processor::{Declaration, ProcessorType};
pub use properties::{Properties, PropertyError};
pub use property::{Choice, Level, PropertyDecl, PropertyKind};
pub use readiness::{Readiness, not_ready, readiness};
pub use registry::{Registry, RegistryError};
pub use report::{Outcome, Reason, Report, Request, Run, Sinks};
pub use value::Value;
