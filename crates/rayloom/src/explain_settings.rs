//! Which properties of a processor are set, and which are at their default.

use std::collections::BTreeSet;

use rayloom_network::{Network, Processor};
use serde_json::{Map, Value as Json, json};

/// Columns of a line of text.
const WIDTH: usize = 110;
/// Longer values are not written out.
const SHORT: usize = 48;
const INDENT: usize = 13;

/// The properties that can change something as the network is wired.
pub struct Settings {
    /// What differs from the default: property, value and default.
    set: Vec<(String, Json, Json)>,
    /// What does not.
    default: Vec<(String, Json)>,
}

impl Settings {
    /// Those of a processor. A value that was set to the default is at its default: files do not tell them apart.
    pub fn of(network: &Network, processor: &Processor) -> Self {
        let used: BTreeSet<String> =
            network.outputs(processor.id()).map(|connection| connection.from.item.clone()).collect();
        let idle = processor.idle_properties(&used);
        let mut settings = Self { set: Vec::new(), default: Vec::new() };
        for property in processor.property_decls().into_iter().filter(|property| !idle.contains(&property.id)) {
            let Some(value) = processor.value(&property.id) else { continue };
            match value == property.default {
                false => settings.set.push((property.id, value.to_json(), property.default.to_json())),
                // A slot without a text of the user's own.
                true if value.to_json() == "" => {}
                true => settings.default.push((property.id, value.to_json())),
            }
        }
        settings
    }

    /// For programs.
    pub fn to_json(&self) -> Json {
        let set: Map<String, Json> = self
            .set
            .iter()
            .map(|(id, value, default)| (id.clone(), json!({"value": value, "default": default})))
            .collect();
        let default: Map<String, Json> = self.default.iter().cloned().collect();
        json!({"set": set, "default": default})
    }

    /// For people.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for (id, value, default) in &self.set {
            let default = short(default).map(|default| format!(", default {default}")).unwrap_or_default();
            let value = short(value).map_or(" of its own".into(), |value| format!(" {value}"));
            text += &format!("  {:<11}{id}{value}{default}\n", "set");
        }
        let one = |(id, value): &(String, Json)| short(value).map_or(id.clone(), |value| format!("{id} {value}"));
        let defaults: Vec<String> = self.default.iter().map(one).collect();
        for (index, line) in wrapped(&defaults).into_iter().enumerate() {
            text += &format!("  {:<11}{line}\n", if index == 0 { "default" } else { "" });
        }
        text
    }
}

/// A value in few words; `None` for long ones.
fn short(value: &Json) -> Option<String> {
    let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    match text.len() {
        0 => Some("(nothing)".into()),
        length => (length <= SHORT).then_some(text),
    }
}

/// A list in lines.
fn wrapped(parts: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        match lines.last_mut() {
            Some(line) if INDENT + line.len() + part.len() + 2 <= WIDTH => *line += &format!(", {part}"),
            Some(line) => {
                line.push(',');
                lines.push(part.clone());
            }
            None => lines.push(part.clone()),
        }
    }
    lines
}
