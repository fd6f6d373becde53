//! The value of a property.

use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D};
use serde::Serialize;
use serde_json::Value as Json;

use crate::camera::Camera;
use crate::light::Light;

/// The value of a property. Choices, files, snippets and shader text are `Text`.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A finite number.
    Float(f64),
    /// Several finite numbers.
    Vector(Vec<f64>),
    /// Red, green, blue and alpha in 0..=1, straight alpha.
    Color([f64; 4]),
    /// Text, or the id of a choice or snippet, or the path of a file (empty: none chosen).
    Text(String),
    /// Colour and opacity over data values.
    TransferFunction(TransferFunction),
    /// Colour and opacity over data values and gradient magnitudes.
    TransferFunction2D(TransferFunction2D),
    /// A transfer function for each label.
    Labels(LabelTable),
    /// A camera.
    Camera(Camera),
    /// A light.
    Light(Light),
}

impl Value {
    /// What kind of value this is, for messages.
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Bool(_) => "a yes/no value",
            Self::Int(_) => "a whole number",
            Self::Float(_) => "a number",
            Self::Vector(_) => "a vector",
            Self::Color(_) => "a colour",
            Self::Text(_) => "a text",
            Self::TransferFunction(_) => "a transfer function",
            Self::TransferFunction2D(_) => "a 2-D transfer function",
            Self::Labels(_) => "a label table",
            Self::Camera(_) => "a camera",
            Self::Light(_) => "a light",
        }
    }

    /// The JSON form; [`crate::PropertyDecl::parse`] reads it back.
    pub fn to_json(&self) -> Json {
        match self {
            Self::Bool(b) => (*b).into(),
            Self::Int(n) => (*n).into(),
            Self::Float(x) => (*x).into(),
            Self::Vector(v) => v.clone().into(),
            Self::Color(c) => c.to_vec().into(),
            Self::Text(s) => s.clone().into(),
            Self::TransferFunction(t) => serialised(t),
            Self::TransferFunction2D(t) => serialised(t),
            Self::Labels(l) => serialised(l),
            Self::Camera(c) => c.to_json(),
            Self::Light(l) => l.to_json(),
        }
    }
}

/// The transfer functions serialise to plain objects with text keys, which cannot fail; null would be refused on reading.
fn serialised(value: &impl Serialize) -> Json {
    serde_json::to_value(value).unwrap_or(Json::Null)
}
