//! Reading JSON with errors that name the place, what was found there and what was expected.

use std::collections::HashSet;
use std::fmt;

use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value as Json};
use thiserror::Error;

use crate::names::hint;

/// A JSON value (or a property's value) that is not what its place needs.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}found {found}, expected {expected}{}", prefix(path), full_stop(expected))]
pub struct ValueError {
    /// Where: a JSON path such as `processors[2].properties.camera`, empty for the value itself.
    pub path: String,
    /// What is there.
    pub found: String,
    /// What should be there.
    pub expected: String,
}

fn prefix(path: &str) -> String {
    if path.is_empty() { String::new() } else { format!("{path}: ") }
}

/// Ends a sentence that a hint may have ended already.
fn full_stop(text: &str) -> &'static str {
    if text.ends_with(['.', '?']) { "" } else { "." }
}

impl ValueError {
    /// An error about the value itself (empty path).
    pub fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { path: String::new(), found: found.into(), expected: expected.into() }
    }

    /// The same error seen from outside: `path` goes before its own.
    pub(crate) fn within(mut self, path: &str) -> Self {
        self.path = join(path, &self.path);
        self
    }
}

/// `outer.inner`, without a dot before an index or beside an empty part.
fn join(outer: &str, inner: &str) -> String {
    let dot = if outer.is_empty() || inner.is_empty() || inner.starts_with('[') { "" } else { "." };
    format!("{outer}{dot}{inner}")
}

/// A JSON value together with the path to it.
#[derive(Clone, Debug)]
pub(crate) struct Node<'a> {
    pub path: String,
    pub json: &'a Json,
}

impl<'a> Node<'a> {
    pub fn root(json: &'a Json) -> Self {
        Self { path: String::new(), json }
    }

    pub fn error(&self, found: impl Into<String>, expected: impl Into<String>) -> ValueError {
        ValueError { path: self.path.clone(), found: found.into(), expected: expected.into() }
    }

    fn mismatch(&self, expected: &str) -> ValueError {
        self.error(describe(self.json), expected)
    }

    pub fn object(&self) -> Result<&'a Map<String, Json>, ValueError> {
        self.json.as_object().ok_or_else(|| self.mismatch("an object"))
    }

    pub fn array(&self) -> Result<Vec<Node<'a>>, ValueError> {
        let items = self.json.as_array().ok_or_else(|| self.mismatch("an array"))?;
        Ok(items.iter().enumerate().map(|(i, json)| Node { path: format!("{}[{i}]", self.path), json }).collect())
    }

    /// The field of an object, if it is there.
    pub fn field(&self, name: &str) -> Result<Option<Node<'a>>, ValueError> {
        Ok(self.object()?.get(name).map(|json| Node { path: join(&self.path, name), json }))
    }

    /// The field of an object, or the error that it is missing.
    pub fn required(&self, name: &str, expected: &str) -> Result<Node<'a>, ValueError> {
        self.field(name)?.ok_or_else(|| self.error(format!("no field `{name}`"), format!("one with {expected}")))
    }

    /// Refuses fields other than `known`.
    pub fn only(&self, known: &[&str]) -> Result<(), ValueError> {
        match self.object()?.keys().find(|key| !known.contains(&key.as_str())) {
            None => Ok(()),
            Some(key) => {
                let place = join(&self.path, key);
                let hint = hint(key, known.iter().copied());
                Err(ValueError::new("an unknown field", format!("a known one.{hint}")).within(&place))
            }
        }
    }

    pub fn string(&self) -> Result<&'a str, ValueError> {
        self.json.as_str().ok_or_else(|| self.mismatch("a text"))
    }

    pub fn bool(&self) -> Result<bool, ValueError> {
        self.json.as_bool().ok_or_else(|| self.mismatch("true or false"))
    }

    pub fn f64(&self) -> Result<f64, ValueError> {
        self.json.as_f64().filter(|x| x.is_finite()).ok_or_else(|| self.mismatch("a finite number"))
    }

    /// A whole number; `2.0` counts as one.
    pub fn i64(&self) -> Result<i64, ValueError> {
        /// Above this a float cannot tell neighbouring integers apart.
        const EXACT: f64 = 9_007_199_254_740_992.0;
        let whole = |x: &f64| x.fract() == 0.0 && x.abs() <= EXACT;
        self.json
            .as_i64()
            .or_else(|| self.json.as_f64().filter(whole).map(|x| x as i64))
            .ok_or_else(|| self.mismatch("a whole number"))
    }

    /// An array of `len` finite numbers.
    pub fn numbers(&self, len: usize) -> Result<Vec<f64>, ValueError> {
        let expected = format!("an array of {len} numbers");
        let items = self.array().map_err(|_| self.mismatch(&expected))?;
        if items.len() != len {
            return Err(self.error(format!("an array of {}", items.len()), expected));
        }
        items.iter().map(Node::f64).collect()
    }

    /// Three finite numbers.
    pub fn triple(&self) -> Result<[f64; 3], ValueError> {
        let v = self.numbers(3)?;
        Ok([v[0], v[1], v[2]])
    }
}

/// A short description of a JSON value for an error message.
pub(crate) fn describe(json: &Json) -> String {
    /// Longest text that is quoted whole.
    const QUOTED: usize = 40;
    match json {
        Json::Null => "null".to_owned(),
        Json::Bool(b) => b.to_string(),
        Json::Number(n) => n.to_string(),
        Json::String(s) if s.chars().count() <= QUOTED => format!("the text {s:?}"),
        Json::String(s) => format!("the text {:?}...", s.chars().take(QUOTED).collect::<String>()),
        Json::Array(items) => format!("an array of {}", items.len()),
        Json::Object(map) => format!("an object of {} fields", map.len()),
    }
}

/// A JSON value whose objects have no field twice (plain `serde_json` would silently keep the last).
pub(crate) struct Strict(pub Json);

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StrictVisitor).map(Strict)
    }
}

struct StrictVisitor;

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Json, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E: de::Error>(self, b: bool) -> Result<Json, E> {
        Ok(Json::Bool(b))
    }

    fn visit_i64<E: de::Error>(self, n: i64) -> Result<Json, E> {
        Ok(n.into())
    }

    fn visit_u64<E: de::Error>(self, n: u64) -> Result<Json, E> {
        Ok(n.into())
    }

    fn visit_f64<E: de::Error>(self, n: f64) -> Result<Json, E> {
        Ok(n.into())
    }

    fn visit_str<E: de::Error>(self, s: &str) -> Result<Json, E> {
        Ok(s.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Json, A::Error> {
        let mut items = Vec::new();
        while let Some(Strict(item)) = seq.next_element()? {
            items.push(item);
        }
        Ok(Json::Array(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Json, A::Error> {
        let (mut object, mut seen) = (Map::new(), HashSet::new());
        while let Some(key) = map.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(de::Error::custom(format!("the field `{key}` appears twice in one object")));
            }
            object.insert(key, map.next_value::<Strict>()?.0);
        }
        Ok(Json::Object(object))
    }
}
