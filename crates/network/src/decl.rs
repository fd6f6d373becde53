//! Checking and reading a property's value against its declaration.

use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D};
use serde::de::DeserializeOwned;
use serde_json::Value as Json;

use crate::camera::Camera;
use crate::json::{Node, ValueError};
use crate::light::Light;
use crate::names::hint;
use crate::property::{PropertyDecl, PropertyKind};
use crate::value::Value;

impl PropertyDecl {
    /// Reads a value from its JSON form and checks it.
    ///
    /// # Errors
    /// Says where in `json`, what was found and what was expected: wrong type, wrong length, out of range, not one of the
    /// choices, a camera or light that makes no sense.
    pub fn parse(&self, json: &Json) -> Result<Value, ValueError> {
        let value = read(&self.kind, &Node::root(json))?;
        self.check(&value)?;
        Ok(value)
    }

    /// Checks that a value is of the property's kind and within its range.
    ///
    /// # Errors
    /// As [`PropertyDecl::parse`].
    pub fn check(&self, value: &Value) -> Result<(), ValueError> {
        use PropertyKind as K;
        match (&self.kind, value) {
            (K::Bool, Value::Bool(_)) => Ok(()),
            (K::Int { range: [min, max], unit }, Value::Int(n)) => {
                let inside = (min..=max).contains(&n);
                inside.then_some(()).ok_or_else(|| outside(n, *min != i64::MIN, min, *max != i64::MAX, max, unit))
            }
            (K::Float { range, unit, .. }, Value::Float(x)) => in_range(*x, *range, unit),
            (K::Vector { len, range, unit, whole }, Value::Vector(v)) => check_vector(v, *len, *range, unit, *whole),
            (K::Color, Value::Color(c)) => check_color(c),
            (K::Choice { choices }, Value::Text(id)) => {
                let ids = || choices.iter().map(|choice| choice.id.as_str());
                if ids().any(|known| known == id) {
                    return Ok(());
                }
                let hint = hint(id, ids());
                Err(ValueError::new(format!("`{id}`"), format!("one of the choices.{hint}")))
            }
            (K::Text { .. } | K::File { .. } | K::Snippet { .. } | K::ShaderText { .. }, Value::Text(_)) => Ok(()),
            (K::TransferFunction, Value::TransferFunction(_)) => Ok(()),
            (K::TransferFunction2D, Value::TransferFunction2D(_)) => Ok(()),
            (K::Labels, Value::Labels(_)) => Ok(()),
            (K::Camera, Value::Camera(camera)) => camera.check(),
            (K::Light, Value::Light(light)) => light.check(),
            _ => Err(ValueError::new(value.kind_name(), self.kind.value_name())),
        }
    }
}

impl PropertyKind {
    /// The kind of value the property takes, for messages.
    pub fn value_name(&self) -> &'static str {
        match self {
            Self::Bool => "a yes/no value",
            Self::Int { .. } => "a whole number",
            Self::Float { .. } => "a number",
            Self::Vector { .. } => "a vector",
            Self::Color => "a colour",
            Self::Choice { .. } => "a choice",
            Self::Text { .. } => "a text",
            Self::File { .. } => "a file",
            Self::TransferFunction => "a transfer function",
            Self::TransferFunction2D => "a 2-D transfer function",
            Self::Labels => "a label table",
            Self::Camera => "a camera",
            Self::Light => "a light",
            Self::Snippet { .. } => "a snippet",
            Self::ShaderText { .. } => "a shader text",
        }
    }
}

/// Reads a value of a kind, without its range.
fn read(kind: &PropertyKind, node: &Node<'_>) -> Result<Value, ValueError> {
    use PropertyKind as K;
    Ok(match kind {
        K::Bool => Value::Bool(node.bool()?),
        K::Int { .. } => Value::Int(node.i64()?),
        K::Float { .. } => Value::Float(node.f64()?),
        K::Vector { len, .. } => Value::Vector(node.numbers(*len)?),
        K::Color => Value::Color(read_color(node)?),
        K::Choice { .. } | K::Text { .. } | K::File { .. } | K::Snippet { .. } | K::ShaderText { .. } => {
            Value::Text(node.string()?.to_owned())
        }
        K::TransferFunction => Value::TransferFunction(read_serde::<TransferFunction>(kind, node)?),
        K::TransferFunction2D => Value::TransferFunction2D(read_serde::<TransferFunction2D>(kind, node)?),
        K::Labels => Value::Labels(read_serde::<LabelTable>(kind, node)?),
        K::Camera => Value::Camera(Camera::from_node(node)?),
        K::Light => Value::Light(Light::from_node(node)?),
    })
}

/// Three components mean an opaque colour.
fn read_color(node: &Node<'_>) -> Result<[f64; 4], ValueError> {
    const EXPECTED: &str = "an array of 3 or 4 numbers from 0 to 1";
    match node.array().map(|items| items.len()) {
        Ok(3) => node.triple().map(|[r, g, b]| [r, g, b, 1.0]),
        Ok(4) => node.numbers(4).map(|c| [c[0], c[1], c[2], c[3]]),
        _ => Err(node.error(crate::json::describe(node.json), EXPECTED)),
    }
}

fn read_serde<T: DeserializeOwned>(kind: &PropertyKind, node: &Node<'_>) -> Result<T, ValueError> {
    let name = kind.value_name();
    T::deserialize(node.json).map_err(|e| node.error(format!("something that is not {name} ({e})"), name))
}

fn check_vector(v: &[f64], len: usize, range: [f64; 2], unit: &str, whole: bool) -> Result<(), ValueError> {
    if v.len() != len {
        return Err(ValueError::new(format!("{} components", v.len()), format!("{len} components")));
    }
    for (i, x) in v.iter().enumerate() {
        let place = format!("[{i}]");
        if whole && x.fract() != 0.0 {
            return Err(ValueError::new(x.to_string(), "a whole number").within(&place));
        }
        in_range(*x, range, unit).map_err(|e| e.within(&place))?;
    }
    Ok(())
}

fn check_color(color: &[f64; 4]) -> Result<(), ValueError> {
    color
        .iter()
        .enumerate()
        .try_for_each(|(i, x)| in_range(*x, [0.0, 1.0], "").map_err(|e| e.within(&format!("[{i}]"))))
}

fn in_range(x: f64, [min, max]: [f64; 2], unit: &str) -> Result<(), ValueError> {
    if !x.is_finite() {
        return Err(ValueError::new(x.to_string(), "a finite number"));
    }
    if min <= x && x <= max { Ok(()) } else { Err(outside(x, min.is_finite(), min, max.is_finite(), max, unit)) }
}

/// The error of a number outside its range; an end that does not exist is not mentioned.
fn outside<T: std::fmt::Display>(x: T, lower: bool, min: T, upper: bool, max: T, unit: &str) -> ValueError {
    let range = match (lower, upper) {
        (true, true) => format!("a number from {min} to {max}"),
        (true, false) => format!("a number of at least {min}"),
        _ => format!("a number of at most {max}"),
    };
    let space = if unit.is_empty() { "" } else { " " };
    ValueError::new(x.to_string(), format!("{range}{space}{unit}"))
}
