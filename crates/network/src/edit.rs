//! Editing a network: processors and property values. (Connecting is in `connect`, linking in `link`.)

use serde_json::Value as Json;
use thiserror::Error;

use crate::connect::Refusal;
use crate::json::ValueError;
use crate::link::LinkRefusal;
use crate::names::{Address, hint, is_valid_id};
use crate::network::{Network, Processor};
use crate::property::{PropertyDecl, PropertyKind};
use crate::value::Value;

/// Why an edit is refused; the network is as it was.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EditError {
    /// There is no such processor type.
    #[error("there is no processor type `{id}`.{hint}")]
    UnknownType {
        /// The id.
        id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// There is no such processor.
    #[error("there is no processor `{id}`.{hint}")]
    UnknownProcessor {
        /// The id.
        id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// The processor has no such property now.
    #[error("`{}` (a {type_id}) has no property `{}`.{hint}", address.processor, address.item)]
    UnknownProperty {
        /// What was asked for.
        address: Address,
        /// Type of the processor.
        type_id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// The processor is a placeholder.
    #[error("`{id}` is of the unknown type `{type_id}`, so its properties cannot be changed.")]
    Placeholder {
        /// The processor.
        id: String,
        /// Its type.
        type_id: String,
    },
    /// A malformed id.
    #[error("`{0}` cannot be an id; use 1 to 64 letters, digits, `_` or `-`.")]
    BadId(String),
    /// The id is taken.
    #[error("there is already a processor `{0}`; choose another id.")]
    Taken(String),
    /// The value does not fit the property.
    #[error("{address} cannot be set: {error}")]
    Value {
        /// The property.
        address: Address,
        /// Why.
        error: Box<ValueError>,
    },
    /// The value does not fit a property that is linked to the one that was to be set.
    #[error("{address} cannot be set: it is linked to {linked}, which refuses the value: {error}")]
    LinkedValue {
        /// The property that was to be set.
        address: Address,
        /// The one that refuses.
        linked: Address,
        /// Why.
        error: Box<ValueError>,
    },
    /// A position that is not finite.
    #[error("the position of `{0}` is not finite; give two finite numbers.")]
    Position(String),
    /// A frame that cannot be drawn.
    #[error("the frame `{0}` has no size or is not finite; give a place, and a width and height above 0.")]
    Frame(String),
    /// A connection was refused.
    #[error(transparent)]
    Connection(#[from] Refusal),
    /// A link was refused.
    #[error(transparent)]
    Link(#[from] LinkRefusal),
}

impl Network {
    /// Adds a processor of a registered type with every property at its default.
    ///
    /// # Errors
    /// An unknown type, a malformed id or one that is taken ([`Network::free_id`] finds a free one).
    pub fn add(&mut self, type_id: &str, id: &str) -> Result<(), EditError> {
        let unknown = || EditError::UnknownType { id: type_id.to_owned(), hint: hint(type_id, self.registry.ids()) };
        let processor_type = self.registry.get(type_id).ok_or_else(unknown)?.clone();
        self.check_new_id(id)?;
        self.processors.push(Processor {
            id: id.to_owned(),
            type_id: type_id.to_owned(),
            processor_type: Some(processor_type),
            settings: Default::default(),
            position: [0.0; 2],
            label: None,
            extra: Default::default(),
        });
        Ok(())
    }

    /// Removes a processor with its connections and links.
    ///
    /// # Errors
    /// There is no such processor.
    pub fn remove(&mut self, id: &str) -> Result<(), EditError> {
        self.existing(id)?;
        self.processors.retain(|p| p.id != id);
        self.connections.retain(|c| c.from.processor != id && c.to.processor != id);
        self.links.retain(|l| l.a.processor != id && l.b.processor != id);
        Ok(())
    }

    /// Gives a processor another id; connections and links follow. (What `visualization` says is up to whoever wrote it.)
    ///
    /// # Errors
    /// There is no such processor, or the new id is malformed or taken.
    pub fn rename(&mut self, id: &str, new: &str) -> Result<(), EditError> {
        self.existing(id)?;
        if id == new {
            return Ok(());
        }
        self.check_new_id(new)?;
        let rename = |place: &mut String| {
            if place == id {
                new.clone_into(place);
            }
        };
        self.connections.change(|c| [&mut c.from, &mut c.to].into_iter().for_each(|end| rename(&mut end.processor)));
        self.links.change(|l| [&mut l.a, &mut l.b].into_iter().for_each(|end| rename(&mut end.processor)));
        self.processors.change(|p| rename(&mut p.id));
        Ok(())
    }

    /// Sets where a processor stands in the editor.
    ///
    /// # Errors
    /// There is no such processor, or a coordinate is not finite.
    pub fn set_position(&mut self, id: &str, position: [f64; 2]) -> Result<(), EditError> {
        if !position.iter().all(|x| x.is_finite()) {
            return Err(EditError::Position(id.to_owned()));
        }
        self.existing_mut(id)?.position = position;
        Ok(())
    }

    /// Sets or removes the user's own name for a processor.
    ///
    /// # Errors
    /// There is no such processor.
    pub fn set_label(&mut self, id: &str, label: Option<String>) -> Result<(), EditError> {
        self.existing_mut(id)?.label = label;
        Ok(())
    }

    /// Sets a property and everything linked to it, or nothing at all. Returns the properties whose value is another now:
    /// none when it was that value before.
    ///
    /// # Errors
    /// An unknown processor or property, or a value that the property or one linked to it refuses.
    pub fn set_property(&mut self, processor: &str, property: &str, value: Value) -> Result<Vec<Address>, EditError> {
        let address = Address::new(processor, property);
        self.declared(&address)?;
        let group = self.linked_with(&address);
        for linked in &group {
            if let Some(Err(error)) = self.declared_if_present(linked).map(|decl| decl.check(&value)) {
                let error = Box::new(error);
                return Err(match *linked == address {
                    true => EditError::Value { address, error },
                    false => EditError::LinkedValue { address, linked: linked.clone(), error },
                });
            }
        }
        Ok(group.into_iter().filter(|linked| self.store(linked, &value)).collect())
    }

    /// Sets a property from JSON, as the command line's `--set` does. A camera or light may leave out fields: they keep their
    /// current value (a new projection replaces the old one), and one field of it may be named alone (`camera.fov_degrees`).
    /// A relative path of a file stays relative to the working directory.
    ///
    /// # Errors
    /// As [`Network::set_property`], with the closest names for a mistyped one.
    pub fn set_from_json(&mut self, processor: &str, property: &str, json: &Json) -> Result<Vec<Address>, EditError> {
        let address = Address::new(processor, property);
        if let (Err(EditError::UnknownProperty { .. }), Some((whole, field))) =
            (self.declared(&address), property.rsplit_once('.'))
            && self.declared(&Address::new(processor, whole)).is_ok_and(|decl| has_fields(&decl))
        {
            return self.set_from_json(processor, whole, &serde_json::json!({ field: json }));
        }
        let decl = self.declared(&address)?;
        let merged =
            if has_fields(&decl) { merge(self.current(&address, &decl).to_json(), json) } else { json.clone() };
        let value = decl.parse(&merged).map_err(|error| EditError::Value { address, error: Box::new(error) })?;
        self.set_property(processor, property, value)
    }

    /// Sets a property, and everything linked to it, to its default.
    ///
    /// # Errors
    /// As [`Network::set_property`].
    pub fn reset_property(&mut self, processor: &str, property: &str) -> Result<Vec<Address>, EditError> {
        let default = self.declared(&Address::new(processor, property))?.default;
        self.set_property(processor, property, default)
    }

    /// The declaration of a property that must be there.
    pub(crate) fn declared(&self, address: &Address) -> Result<PropertyDecl, EditError> {
        let processor = self.existing(&address.processor)?;
        let type_id = processor.type_id.clone();
        if processor.is_placeholder() {
            return Err(EditError::Placeholder { id: address.processor.clone(), type_id });
        }
        let mut decls = processor.property_decls();
        match decls.iter().position(|decl| decl.id == address.item) {
            Some(index) => Ok(decls.swap_remove(index)),
            None => {
                let hint = hint(&address.item, decls.iter().map(|decl| decl.id.as_str()));
                Err(EditError::UnknownProperty { address: address.clone(), type_id, hint })
            }
        }
    }

    fn existing(&self, id: &str) -> Result<&Processor, EditError> {
        let unknown = || EditError::UnknownProcessor { id: id.to_owned(), hint: hint(id, self.ids()) };
        self.processor(id).ok_or_else(unknown)
    }

    fn existing_mut(&mut self, id: &str) -> Result<&mut Processor, EditError> {
        self.existing(id)?;
        let unknown = EditError::UnknownProcessor { id: id.to_owned(), hint: String::new() };
        self.processor_mut(id).ok_or(unknown)
    }

    fn check_new_id(&self, id: &str) -> Result<(), EditError> {
        if !is_valid_id(id) {
            return Err(EditError::BadId(id.to_owned()));
        }
        match self.processor(id) {
            Some(_) => Err(EditError::Taken(id.to_owned())),
            None => Ok(()),
        }
    }
}

/// Whether the value is an object whose fields can be set one by one.
fn has_fields(decl: &PropertyDecl) -> bool {
    matches!(decl.kind, PropertyKind::Camera | PropertyKind::Light)
}

/// The fields of `part` over those of `whole`; of the two projections of a camera only the new one stays.
fn merge(mut whole: Json, part: &Json) -> Json {
    let (Some(fields), Some(changes)) = (whole.as_object_mut(), part.as_object()) else {
        return part.clone();
    };
    for (one, other) in [("fov_degrees", "orthographic_height"), ("orthographic_height", "fov_degrees")] {
        if changes.contains_key(one) {
            fields.remove(other);
        }
    }
    fields.extend(changes.clone());
    whole
}
