//! The network: processors, connections, links. What can be asked of it; how it is changed is in `edit`.

use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};
use std::fmt;
use std::sync::Arc;

use serde_json::{Map, Value as Json};

use crate::frame::Frame;
use crate::indexed::Indexed;
use crate::link::Link;
use crate::names::Address;
use crate::processor::{Declaration, ProcessorType};
use crate::properties::Properties;
use crate::property::PropertyDecl;
use crate::registry::Registry;
use crate::value::Value;

/// Processors, the connections between their ports and the links between their properties.
///
/// A clone is a snapshot (for undo); processor types are shared. Connections never form a cycle.
#[derive(Clone)]
pub struct Network {
    /// What the user calls it.
    pub name: String,
    /// What it shows, for the reader of a list of networks.
    pub description: String,
    /// What visualization mode shows; kept as it is, null when nothing was set.
    pub visualization: Json,
    pub(crate) registry: Arc<Registry>,
    pub(crate) processors: Indexed<Processor>,
    pub(crate) connections: Indexed<Connection>,
    pub(crate) links: Indexed<Link>,
    pub(crate) frames: Vec<Frame>,
}

/// One outport feeding one inport.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Connection {
    /// The outport.
    pub from: Address,
    /// The inport.
    pub to: Address,
}

impl fmt::Display for Connection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {}", self.from, self.to)
    }
}

/// A processor of a network: a type, and the values of properties that were set.
#[derive(Clone)]
pub struct Processor {
    pub(crate) id: String,
    pub(crate) type_id: String,
    /// `None` for a placeholder: a processor from a file whose type is not registered.
    pub(crate) processor_type: Option<Arc<dyn ProcessorType>>,
    pub(crate) settings: BTreeMap<String, Setting>,
    pub(crate) position: [f64; 2],
    pub(crate) label: Option<String>,
    /// Further fields of a placeholder, kept for saving.
    pub(crate) extra: Map<String, Json>,
}

/// What was set for a property. It stays when the property is gone for now (its snippet is not chosen) and counts again when
/// the property is back.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Setting {
    /// A value.
    Value(Value),
    /// From a file, for a property that was not known then.
    Json(Json),
}

impl Processor {
    /// Id, unique in the network.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Id of its type.
    pub fn type_id(&self) -> &str {
        &self.type_id
    }

    /// Its type; `None` for a placeholder.
    pub fn processor_type(&self) -> Option<&Arc<dyn ProcessorType>> {
        self.processor_type.as_ref()
    }

    /// Whether its type is not registered. A placeholder keeps what the file says and is never ready.
    pub fn is_placeholder(&self) -> bool {
        self.processor_type.is_none()
    }

    /// What its type declares; `None` for a placeholder.
    pub fn declaration(&self) -> Option<&Declaration> {
        self.processor_type.as_ref().map(|t| t.declaration())
    }

    /// Where it stands in the editor, points.
    pub fn position(&self) -> [f64; 2] {
        self.position
    }

    /// The user's own name for it, if any.
    pub fn label(&self) -> Option<&str> {
        self.label.as_deref()
    }

    /// All properties it has now: the declared ones, then those that its values bring with them.
    pub fn property_decls(&self) -> Vec<PropertyDecl> {
        self.resolve().0
    }

    /// The values of all properties it has now, defaults filled in.
    pub fn properties(&self) -> Properties {
        self.resolve().1
    }

    /// Ids of the properties that change nothing as the others are now, while only the outports in `used` are.
    pub fn idle_properties(&self, used: &BTreeSet<String>) -> BTreeSet<String> {
        let (_, properties) = self.resolve();
        self.processor_type.as_ref().map(|t| t.idle_properties(&properties, used)).unwrap_or_default()
    }

    /// The declaration of one property.
    pub fn property_decl(&self, property: &str) -> Option<PropertyDecl> {
        self.property_decls().into_iter().find(|decl| decl.id == property)
    }

    /// The value of one property.
    pub fn value(&self, property: &str) -> Option<Value> {
        self.properties().get(property).cloned()
    }

    /// Declarations and values, the declared properties first and then those that depend on their values.
    pub(crate) fn resolve(&self) -> (Vec<PropertyDecl>, Properties) {
        let Some(processor_type) = &self.processor_type else {
            return Default::default();
        };
        let mut decls = processor_type.declaration().properties.clone();
        let mut properties: Properties = decls.iter().map(|decl| (decl.id.clone(), self.setting(decl))).collect();
        for decl in processor_type.snippet_properties(&properties) {
            if !properties.contains(&decl.id) {
                properties.insert(decl.id.clone(), self.setting(&decl));
                decls.push(decl);
            }
        }
        (decls, properties)
    }

    /// The value of a property: what was set, else the default.
    fn setting(&self, decl: &PropertyDecl) -> Value {
        let set = self.settings.get(&decl.id).and_then(|setting| setting.value(decl));
        set.unwrap_or_else(|| decl.default.clone())
    }
}

impl Setting {
    /// The value for a property, if it satisfies the declaration.
    pub(crate) fn value(&self, decl: &PropertyDecl) -> Option<Value> {
        match self {
            Self::Value(value) => decl.check(value).is_ok().then(|| value.clone()),
            Self::Json(json) => decl.parse(json).ok(),
        }
    }

    /// What is stored of it when it is not a value of a property at the moment.
    pub(crate) fn to_json(&self) -> Json {
        match self {
            Self::Value(value) => value.to_json(),
            Self::Json(json) => json.clone(),
        }
    }
}

impl Network {
    /// A network without processors.
    pub fn new(registry: Arc<Registry>) -> Self {
        Self {
            name: String::new(),
            description: String::new(),
            visualization: Json::Null,
            registry,
            processors: Indexed::default(),
            connections: Indexed::default(),
            links: Indexed::default(),
            frames: Vec::new(),
        }
    }

    /// The processor types that can be added.
    pub fn registry(&self) -> &Arc<Registry> {
        &self.registry
    }

    /// All processors, in the order they were added.
    pub fn processors(&self) -> impl DoubleEndedIterator<Item = &Processor> {
        self.processors.as_slice().iter()
    }

    /// The processor of this id.
    pub fn processor(&self, id: &str) -> Option<&Processor> {
        self.processors.naming(id).next()
    }

    /// All connections, in the order in which they were made.
    pub fn connections(&self) -> &[Connection] {
        self.connections.as_slice()
    }

    /// The connections that end at a processor.
    pub fn inputs<'a>(&'a self, processor: &'a str) -> impl Iterator<Item = &'a Connection> + Clone {
        self.connections.naming(processor).filter(move |connection| connection.to.processor == processor)
    }

    /// The connections that end at a processor, in the order in which it sees them: sorted by the processor that they come
    /// from, then by its outport.
    pub fn inputs_in_order<'a>(&'a self, processor: &'a str) -> Vec<&'a Connection> {
        let mut inputs: Vec<&Connection> = self.inputs(processor).collect();
        inputs.sort();
        inputs
    }

    /// The connections that begin at a processor.
    pub fn outputs<'a>(&'a self, processor: &'a str) -> impl Iterator<Item = &'a Connection> {
        self.connections.naming(processor).filter(move |connection| connection.from.processor == processor)
    }

    /// All links.
    pub fn links(&self) -> &[Link] {
        self.links.as_slice()
    }

    /// The value of a property; `None` if there is none of this name.
    pub fn value(&self, processor: &str, property: &str) -> Option<Value> {
        self.processor(processor)?.value(property)
    }

    /// Ids of all processors, every one after those that feed it; otherwise in the order they were added: as if the list were
    /// gone through again and again, each time for what has all that feeds it. Processors of a cycle would be left out.
    pub fn order(&self) -> Vec<&str> {
        let places: HashMap<&str, usize> = self.ids().enumerate().map(|(place, id)| (id, place)).collect();
        let ids: Vec<&str> = self.ids().collect();
        let mut missing: Vec<usize> = ids.iter().map(|id| self.inputs(id).count()).collect();
        let mut rounds = vec![0_usize; ids.len()];
        let mut ready: VecDeque<usize> = (0..ids.len()).filter(|&place| missing[place] == 0).collect();
        let mut order = Vec::with_capacity(ids.len());
        while let Some(place) = ready.pop_front() {
            order.push(place);
            let next = self.outputs(ids[place]).filter_map(|connection| places.get(connection.to.processor.as_str()));
            for &next in next {
                rounds[next] = rounds[next].max(rounds[place] + usize::from(place > next));
                missing[next] -= 1;
                if missing[next] == 0 {
                    ready.push_back(next);
                }
            }
        }
        order.sort_by_key(|&place| (rounds[place], place));
        order.into_iter().map(|place| ids[place]).collect()
    }

    /// An id for a new processor: `base`, else `base_2`, `base_3`, ...
    pub fn free_id(&self, base: &str) -> String {
        let taken = |id: &str| self.processor(id).is_some();
        if !taken(base) {
            return base.to_owned();
        }
        let mut number = 2_u64;
        while taken(&format!("{base}_{number}")) {
            number += 1;
        }
        format!("{base}_{number}")
    }

    pub(crate) fn processor_mut(&mut self, id: &str) -> Option<&mut Processor> {
        self.processors.first_mut(id)
    }

    pub(crate) fn ids(&self) -> impl Iterator<Item = &str> {
        self.processors().map(Processor::id)
    }
}

impl fmt::Debug for Network {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_text(None))
    }
}
