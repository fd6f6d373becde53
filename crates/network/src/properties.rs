//! The resolved properties of a processor, read by type.

use std::collections::BTreeMap;
use std::path::Path;

use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D};
use thiserror::Error;

use crate::camera::Camera;
use crate::light::Light;
use crate::value::Value;

/// All properties of a processor with their current values, defaults filled in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Properties {
    values: BTreeMap<String, Value>,
}

/// A property was asked for that the processor does not have, or as a type it is not of. This is a slip in the processor.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PropertyError {
    /// No property of this id.
    #[error("the processor has no property `{0}`; declare it or correct the id where it is read")]
    Missing(String),
    /// Another type.
    #[error("the property `{id}` is {found} but was read as {wanted}; read it as what it is declared to be")]
    Type {
        /// The property.
        id: String,
        /// Kind of its value.
        found: &'static str,
        /// Kind asked for.
        wanted: &'static str,
    },
}

/// Generates the typed getters.
macro_rules! getters {
    ($($(#[$doc:meta])* $name:ident -> $type:ty = $pattern:pat => $result:expr, $wanted:literal;)*) => {$(
        $(#[$doc])*
        ///
        /// # Errors
        /// No such property, or one of another type.
        pub fn $name(&self, id: &str) -> Result<$type, PropertyError> {
            match self.values.get(id) {
                Some($pattern) => Ok($result),
                Some(other) => {
                    Err(PropertyError::Type { id: id.to_owned(), found: other.kind_name(), wanted: $wanted })
                }
                None => Err(PropertyError::Missing(id.to_owned())),
            }
        }
    )*};
}

impl Properties {
    getters! {
        /// A yes/no value.
        bool -> bool = Value::Bool(b) => *b, "a yes/no value";
        /// A whole number.
        int -> i64 = Value::Int(n) => *n, "a whole number";
        /// A number.
        f64 -> f64 = Value::Float(x) => *x, "a number";
        /// A vector's components.
        vector -> &[f64] = Value::Vector(v) => v, "a vector";
        /// A colour: red, green, blue, alpha in 0..=1, straight alpha.
        color -> [f64; 4] = Value::Color(c) => *c, "a colour";
        /// A text, or the id of a choice or snippet.
        text -> &str = Value::Text(s) => s, "a text";
        /// The path of a file; empty when none is chosen.
        path -> &Path = Value::Text(s) => Path::new(s), "a file";
        /// A transfer function.
        transfer_function -> &TransferFunction = Value::TransferFunction(t) => t, "a transfer function";
        /// A 2-D transfer function.
        transfer_function_2d -> &TransferFunction2D = Value::TransferFunction2D(t) => t, "a 2-D transfer function";
        /// A label table.
        labels -> &LabelTable = Value::Labels(l) => l, "a label table";
        /// A camera; valid.
        camera -> Camera = Value::Camera(c) => *c, "a camera";
        /// A light; valid.
        light -> Light = Value::Light(l) => *l, "a light";
    }

    /// The first `N` components of a vector.
    ///
    /// # Errors
    /// No such property, one of another type, or a shorter vector.
    pub fn array<const N: usize>(&self, id: &str) -> Result<[f64; N], PropertyError> {
        let wanted = "a longer vector";
        let short = || PropertyError::Type { id: id.to_owned(), found: "a vector", wanted };
        self.vector(id)?.first_chunk::<N>().copied().ok_or_else(short)
    }

    /// The value of any type.
    pub fn get(&self, id: &str) -> Option<&Value> {
        self.values.get(id)
    }

    /// All of them, by id.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.values.iter().map(|(id, value)| (id.as_str(), value))
    }

    /// Adds or replaces a value; for building a set by hand, as tests of a processor do.
    pub fn insert(&mut self, id: impl Into<String>, value: Value) {
        self.values.insert(id.into(), value);
    }

    /// Whether a property of this id is there.
    pub fn contains(&self, id: &str) -> bool {
        self.values.contains_key(id)
    }
}

impl FromIterator<(String, Value)> for Properties {
    fn from_iter<I: IntoIterator<Item = (String, Value)>>(values: I) -> Self {
        Self { values: values.into_iter().collect() }
    }
}
