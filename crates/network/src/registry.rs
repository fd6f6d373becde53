//! The processor types that exist.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use thiserror::Error;

use crate::names::{closest, is_valid_id, is_valid_property_id};
use crate::processor::{Declaration, ProcessorType};

/// Processor types by id.
#[derive(Clone, Default)]
pub struct Registry {
    types: BTreeMap<String, Arc<dyn ProcessorType>>,
}

/// A processor type that cannot be registered. This is a slip in its declaration.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RegistryError {
    /// The id is taken.
    #[error("there is already a processor type `{0}`; give one of the two another id")]
    Duplicate(String),
    /// The declaration contradicts itself.
    #[error("the declaration of processor type `{processor_type}` is wrong: {problem}")]
    Invalid {
        /// The type.
        processor_type: String,
        /// What is wrong.
        problem: String,
    },
}

impl Registry {
    /// A registry without types.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a type.
    ///
    /// # Errors
    /// The id is taken or malformed, a port or property id occurs twice or is malformed, an inport accepts nothing, or a
    /// default does not satisfy its own property.
    pub fn add(&mut self, processor_type: Arc<dyn ProcessorType>) -> Result<(), RegistryError> {
        let declaration = processor_type.declaration();
        let id = declaration.id.clone();
        if self.types.contains_key(&id) {
            return Err(RegistryError::Duplicate(id));
        }
        if let Some(problem) = problem(declaration) {
            return Err(RegistryError::Invalid { processor_type: id, problem });
        }
        self.types.insert(id, processor_type);
        Ok(())
    }

    /// The type of this id.
    pub fn get(&self, id: &str) -> Option<&Arc<dyn ProcessorType>> {
        self.types.get(id)
    }

    /// All types, by id.
    pub fn iter(&self) -> impl Iterator<Item = &Arc<dyn ProcessorType>> {
        self.types.values()
    }

    /// The declarations of all types, by id.
    pub fn declarations(&self) -> impl Iterator<Item = &Declaration> {
        self.types.values().map(|t| t.declaration())
    }

    /// The ids most like a mistyped one.
    pub fn closest(&self, id: &str) -> Vec<&str> {
        closest(id, self.ids())
    }

    pub(crate) fn ids(&self) -> impl Iterator<Item = &str> {
        self.types.keys().map(String::as_str)
    }
}

/// What is wrong with a declaration.
fn problem(declaration: &Declaration) -> Option<String> {
    let Declaration { id, inports, outports, properties, .. } = declaration;
    if !is_valid_id(id) {
        return Some(format!("`{id}` is not a valid id"));
    }
    let ports = inports.iter().map(|p| &p.id).chain(outports.iter().map(|p| &p.id));
    let mut seen = BTreeSet::new();
    for port in ports {
        if !is_valid_id(port) || !seen.insert(port) {
            return Some(format!("the port id `{port}` is malformed or occurs twice"));
        }
    }
    if let Some(port) = inports.iter().find(|port| port.accepts.is_empty()) {
        return Some(format!("the inport `{}` accepts nothing", port.id));
    }
    let mut seen = BTreeSet::new();
    for property in properties {
        if !is_valid_property_id(&property.id) || !seen.insert(&property.id) {
            return Some(format!("the property id `{}` is malformed or occurs twice", property.id));
        }
        if let Err(error) = property.check(&property.default) {
            return Some(format!("the default of property `{}`: {error}", property.id));
        }
    }
    None
}
