//! Processor types: what a kind of processor declares about itself.

use std::collections::BTreeSet;

use crate::port::{InportDecl, OutportDecl};
use crate::properties::Properties;
use crate::property::PropertyDecl;

/// What a processor type is: ports, properties, help. Build one with [`Declaration::new`] and the chained setters.
#[derive(Clone, Debug, Default)]
pub struct Declaration {
    /// Stable id of the type, as stored in files.
    pub id: String,
    /// What the user reads.
    pub label: String,
    /// Group in the list of processors.
    pub category: String,
    /// Help, some sentences.
    pub help: String,
    /// Inports, in the order shown.
    pub inports: Vec<InportDecl>,
    /// Outports, in the order shown.
    pub outports: Vec<OutportDecl>,
    /// Properties that are always there, in the order shown.
    pub properties: Vec<PropertyDecl>,
    /// Whether it is an end of the network: evaluation starts from here. Its property `size`, if any, is the render size.
    pub sink: bool,
    /// Whether its result depends on the render size that travels upstream; only then does a new size run it again.
    pub uses_render_size: bool,
    /// The float property, if any, by which the render size is multiplied on its way upstream.
    pub scales_render_size: Option<String>,
}

impl Declaration {
    /// A processor type without ports and properties.
    pub fn new(id: impl Into<String>, label: impl Into<String>, category: impl Into<String>) -> Self {
        Self { id: id.into(), label: label.into(), category: category.into(), ..Self::default() }
    }

    /// Sets the help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// Adds an inport.
    #[must_use]
    pub fn input(mut self, inport: InportDecl) -> Self {
        self.inports.push(inport);
        self
    }

    /// Adds an outport.
    #[must_use]
    pub fn output(mut self, outport: OutportDecl) -> Self {
        self.outports.push(outport);
        self
    }

    /// Adds a property.
    #[must_use]
    pub fn property(mut self, property: PropertyDecl) -> Self {
        self.properties.push(property);
        self
    }

    /// Makes it an end of the network.
    #[must_use]
    pub fn sink(mut self) -> Self {
        self.sink = true;
        self
    }

    /// Lets a new render size run it again.
    #[must_use]
    pub fn uses_render_size(mut self) -> Self {
        self.uses_render_size = true;
        self
    }

    /// Asks of what feeds it the render size times a float property of this id.
    #[must_use]
    pub fn scales_render_size(mut self, property: impl Into<String>) -> Self {
        self.scales_render_size = Some(property.into());
        self
    }

    /// The inport of this id.
    pub fn inport(&self, id: &str) -> Option<&InportDecl> {
        self.inports.iter().find(|port| port.id == id)
    }

    /// The outport of this id.
    pub fn outport(&self, id: &str) -> Option<&OutportDecl> {
        self.outports.iter().find(|port| port.id == id)
    }
}

/// A type of processor, as far as the network needs to know it.
pub trait ProcessorType: Send + Sync {
    /// Ports, properties and help; the same at every call.
    fn declaration(&self) -> &Declaration;

    /// Further properties that the current values bring with them: the parameters of the chosen snippets. `current` holds the
    /// declared properties. A property with the id of a declared one is ignored.
    fn snippet_properties(&self, current: &Properties) -> Vec<PropertyDecl> {
        let _ = current;
        Vec::new()
    }

    /// Ids of the properties that change nothing with the values in `current` while only the outports in `used` are: for
    /// editors, which put them aside.
    fn idle_properties(&self, current: &Properties, used: &BTreeSet<String>) -> BTreeSet<String> {
        let _ = (current, used);
        BTreeSet::new()
    }
}
