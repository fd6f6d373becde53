//! Links keep properties of several processors equal.

use std::collections::BTreeSet;
use std::fmt;

use thiserror::Error;

use crate::edit::EditError;
use crate::json::ValueError;
use crate::names::Address;
use crate::network::{Network, Setting};
use crate::property::{PropertyDecl, PropertyKind};
use crate::value::Value;

/// Two properties that are kept equal. A link has no direction; chains and rings of links are fine.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Link {
    /// One property.
    pub a: Address,
    /// The other.
    pub b: Address,
}

impl Link {
    /// The property at the other end.
    pub fn other(&self, end: &Address) -> Option<&Address> {
        if self.a == *end { Some(&self.b) } else { (self.b == *end).then_some(&self.a) }
    }

    fn joins(&self, a: &Address, b: &Address) -> bool {
        (self.a == *a && self.b == *b) || (self.a == *b && self.b == *a)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.a, self.b)
    }
}

/// Why a link is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LinkRefusal {
    /// Both ends are the same property.
    #[error("{0} cannot be linked to itself; choose two properties.")]
    Itself(Address),
    /// The link exists.
    #[error("{0} and {1} are already linked.")]
    Already(Address, Address),
    /// The properties are not of the same kind, length, unit or choices.
    #[error("{} is {kind_a}, but {} is {kind_b}; only properties of the same kind can be linked.", link.a, link.b)]
    Kind {
        /// The properties.
        link: Box<Link>,
        /// What the first is.
        kind_a: String,
        /// What the second is.
        kind_b: String,
    },
    /// The present value does not fit the other side.
    #[error("the value of {from} does not fit {to}: {error} Change it first.")]
    Value {
        /// Where the value comes from.
        from: Address,
        /// The property that refuses it.
        to: Address,
        /// Why.
        error: Box<ValueError>,
    },
}

impl Network {
    /// Whether two properties may be linked: same kind, length, unit and choices, and the value of `a` (which `b` and
    /// everything linked to it would take) is within their ranges.
    ///
    /// # Errors
    /// An unknown property, or the reason in [`EditError::Link`].
    pub fn can_link(&self, a: &Address, b: &Address) -> Result<(), EditError> {
        let (decl_a, decl_b) = (self.declared(a)?, self.declared(b)?);
        self.link_shape(a, b)?;
        let (kind_a, kind_b) = (nature(&decl_a), nature(&decl_b));
        if kind_a != kind_b {
            let link = Box::new(Link { a: a.clone(), b: b.clone() });
            return Err(LinkRefusal::Kind { link, kind_a, kind_b }.into());
        }
        let value = self.current(a, &decl_a);
        for to in self.linked_with(b) {
            if let Some(decl) = self.declared_if_present(&to)
                && let Err(error) = decl.check(&value)
            {
                let (from, error) = (a.clone(), Box::new(error));
                return Err(LinkRefusal::Value { from, to, error }.into());
            }
        }
        Ok(())
    }

    /// Links two properties; `b`, and what it is linked to, takes the value of `a`.
    ///
    /// # Errors
    /// As [`Network::can_link`].
    pub fn link(&mut self, a: impl Into<Address>, b: impl Into<Address>) -> Result<(), EditError> {
        let (a, b) = (a.into(), b.into());
        self.can_link(&a, &b)?;
        let value = self.current(&a, &self.declared(&a)?);
        for address in self.linked_with(&b) {
            self.store(&address, &value);
        }
        self.links.push(Link { a, b });
        Ok(())
    }

    /// Removes a link, whichever way round it is named; the values stay. `false` if there was none.
    pub fn unlink(&mut self, a: impl Into<Address>, b: impl Into<Address>) -> bool {
        let (a, b) = (a.into(), b.into());
        self.links.retain(|link| !link.joins(&a, &b))
    }

    /// The property itself, then all that are linked to it directly or through others, each once.
    pub fn linked_with(&self, address: &Address) -> Vec<Address> {
        let mut group = vec![address.clone()];
        let mut seen: BTreeSet<Address> = group.iter().cloned().collect();
        let mut next = 0;
        while next < group.len() {
            for link in self.links.naming(&group[next].processor) {
                if let Some(other) = link.other(&group[next])
                    && seen.insert(other.clone())
                {
                    group.push(other.clone());
                }
            }
            next += 1;
        }
        group
    }

    /// Refuses a link to itself and one that exists.
    pub(crate) fn link_shape(&self, a: &Address, b: &Address) -> Result<(), LinkRefusal> {
        if a == b {
            return Err(LinkRefusal::Itself(a.clone()));
        }
        if self.links.naming_both(&a.processor, &b.processor).any(|link| link.joins(a, b)) {
            return Err(LinkRefusal::Already(a.clone(), b.clone()));
        }
        Ok(())
    }

    /// Sets a property without checks and without links; `true` if its value is another now. A property that is not there at
    /// the moment remembers the value for when it is; a placeholder keeps what its file says.
    pub(crate) fn store(&mut self, address: &Address, value: &Value) -> bool {
        let decl = self.declared_if_present(address);
        let changed = decl.as_ref().is_some_and(|decl| self.current(address, decl) != *value);
        let Some(processor) = self.processor_mut(&address.processor).filter(|p| !p.is_placeholder()) else {
            return false;
        };
        if decl.is_some_and(|decl| decl.default == *value) {
            processor.settings.remove(&address.item);
        } else {
            processor.settings.insert(address.item.clone(), Setting::Value(value.clone()));
        }
        changed
    }

    pub(crate) fn current(&self, address: &Address, decl: &PropertyDecl) -> Value {
        self.value(&address.processor, &address.item).unwrap_or_else(|| decl.default.clone())
    }

    pub(crate) fn declared_if_present(&self, address: &Address) -> Option<PropertyDecl> {
        self.processor(&address.processor)?.property_decl(&address.item)
    }
}

/// What two properties must have in common to be linked, in words.
fn nature(decl: &PropertyDecl) -> String {
    let name = decl.kind.value_name();
    let in_unit = |unit: &str| {
        if unit.is_empty() { String::new() } else { format!(" in {unit}") }
    };
    match &decl.kind {
        PropertyKind::Int { unit, .. } | PropertyKind::Float { unit, .. } => {
            format!("{name}{}", in_unit(unit))
        }
        PropertyKind::Vector { len, unit, whole, .. } => {
            let numbers = if *whole { "whole numbers" } else { "numbers" };
            format!("{name} of {len} {numbers}{}", in_unit(unit))
        }
        PropertyKind::Choice { choices } => {
            let ids = choices.iter().map(|choice| choice.id.as_str()).collect::<Vec<_>>().join(", ");
            format!("{name} among {ids}")
        }
        PropertyKind::Snippet { slot } | PropertyKind::ShaderText { slot } => {
            format!("{name} for {slot}")
        }
        PropertyKind::File { save: true, .. } => "a file to write".to_owned(),
        _ => name.to_owned(),
    }
}
