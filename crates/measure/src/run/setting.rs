//! Settings of a network, and their variation.

use std::str::FromStr;

use rayloom_network::{Address, EditError, Network};
use serde::Serialize;
use serde_json::Value as Json;

/// A value for a property.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// The property.
    pub property: Address,
    /// Its value, as the command line's `--set` takes it.
    pub value: Json,
}

/// Properties of a network set to certain values, everything else as saved.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// What it is called in tables and plots.
    pub name: String,
    /// The values.
    pub assignments: Vec<Assignment>,
}

impl Setting {
    /// The network as it was saved.
    pub fn saved() -> Self {
        Self { name: "as saved".into(), assignments: Vec::new() }
    }

    /// The network with these values.
    ///
    /// # Errors
    /// A property that does not exist or refuses its value.
    pub fn applied(&self, network: &Network) -> Result<Network, EditError> {
        let mut network = network.clone();
        for Assignment { property, value } in &self.assignments {
            network.set_from_json(&property.processor, &property.item, value)?;
        }
        Ok(network)
    }
}

/// A property and the values it is to take in turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Vary {
    /// The property.
    pub property: Address,
    /// The values; at least one.
    pub values: Vec<Json>,
}

impl FromStr for Vary {
    type Err = String;

    /// `PROCESSOR.PROPERTY=a,b,c`: each value JSON, or a bare word for a text.
    fn from_str(text: &str) -> Result<Self, String> {
        let (property, values) = text
            .split_once('=')
            .ok_or("there is no `=`; write PROCESSOR.PROPERTY=a,b,c, such as traversal.sampling_rate=0.5,1,2")?;
        let property = property.trim().parse().map_err(|error: rayloom_network::AddressError| error.to_string())?;
        let values = split(values).into_iter().map(value).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { property, values })
    }
}

/// The parts between commas that stand outside brackets and quotes.
fn split(text: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth, mut quoted) = (Vec::new(), 0, 0_i32, false);
    for (i, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            ',' if !quoted && depth <= 0 => {
                parts.push(&text[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

fn value(text: &str) -> Result<Json, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err("a value is empty; write values between commas, such as 0.5,1,2".into());
    }
    match serde_json::from_str(text) {
        Ok(json) => Ok(json),
        Err(error) if text.starts_with(['{', '[', '"']) => Err(format!("`{text}` is not JSON: {error}")),
        Err(_) => Ok(Json::from(text)),
    }
}

/// Every combination of the values, the last property varying fastest. One empty combination for nothing to vary.
pub(crate) fn combinations(vary: &[Vary]) -> Vec<Setting> {
    let mut found = vec![Vec::new()];
    for Vary { property, values } in vary {
        let assignment = |value: &Json| Assignment { property: property.clone(), value: value.clone() };
        let extended = |one: &Vec<Assignment>| {
            values.iter().map(|value| [&one[..], &[assignment(value)]].concat()).collect::<Vec<_>>()
        };
        found = found.iter().flat_map(extended).collect();
    }
    found.into_iter().map(|assignments| Setting { name: name(&assignments), assignments }).collect()
}

/// Number of combinations.
pub(crate) fn count(vary: &[Vary]) -> usize {
    vary.iter().fold(1, |count: usize, vary| count.saturating_mul(vary.values.len()))
}

/// The values with the names of their properties: "sampling_rate 2, target 16-bit".
fn name(assignments: &[Assignment]) -> String {
    let part = |Assignment { property, value }: &Assignment| format!("{} {}", property.item, plain(value));
    assignments.iter().map(part).collect::<Vec<_>>().join(", ")
}

/// JSON without the quotes of a text and the ".0" of a whole number.
pub(crate) fn plain(value: &Json) -> String {
    match value {
        Json::String(text) => text.clone(),
        Json::Number(number) => {
            let text = number.to_string();
            text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
        }
        other => other.to_string(),
    }
}

impl Serialize for Setting {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let set: serde_json::Map<String, Json> =
            self.assignments.iter().map(|one| (one.property.to_string(), one.value.clone())).collect();
        serde_json::json!({"name": self.name, "set": set}).serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_split_at_outer_commas() {
        let vary: Vary = "a.b=1, word,[1, 2],{\"x\":[3,4]},\"p,q\"".parse().expect("well formed");
        assert_eq!(vary.property, Address::new("a", "b"));
        let plain: Vec<String> = vary.values.iter().map(plain).collect();
        assert_eq!(plain, ["1", "word", "[1,2]", "{\"x\":[3,4]}", "p,q"]);
        for refused in ["a.b", "a=1", "a.b=", "a.b=1,,2", "a.b=[1"] {
            assert!(refused.parse::<Vary>().is_err(), "{refused}");
        }
    }

    #[test]
    fn every_combination_occurs_once() {
        let vary = ["a.x=1,2", "a.y=p,q,r"].map(|text| text.parse().expect("well formed"));
        let settings = combinations(&vary);
        assert_eq!((settings.len(), count(&vary)), (6, 6));
        assert_eq!((settings[0].name.as_str(), settings[5].name.as_str()), ("x 1, y p", "x 2, y r"));
    }
}
