//! Named sets of values, which a network's file keeps in `visualization.presets`.

use std::collections::BTreeMap;

use serde_json::{Map, Value as Json, json};

use crate::edit::EditError;
use crate::names::Address;
use crate::network::Network;

/// A set of values of properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// What it is called.
    pub name: String,
    /// JSON for each property that it sets.
    pub values: BTreeMap<Address, Json>,
}

impl Preset {
    /// Reads the form in the file, `{"name": ..., "values": {"processor.property": ...}}`.
    ///
    /// # Errors
    /// A sentence that says what is wrong, to follow on the place in the file and a colon.
    pub fn from_json(json: &Json) -> Result<Self, String> {
        let Json::Object(object) = json else {
            return Err(format!("found {json}, expected an object with name, values"));
        };
        if let Some(field) = object.keys().find(|field| !["name", "values"].contains(&field.as_str())) {
            return Err(format!("found the field `{field}`, expected only name, values"));
        }
        let name = match object.get("name") {
            Some(Json::String(name)) => name.clone(),
            _ => return Err("no `name`; give the preset one".into()),
        };
        let values = match object.get("values") {
            None => BTreeMap::new(),
            Some(Json::Object(values)) => values
                .iter()
                .map(|(address, value)| Ok((address.parse()?, value.clone())))
                .collect::<Result<_, crate::names::AddressError>>()
                .map_err(|error| error.to_string())?,
            Some(other) => {
                return Err(format!("found {other}, expected an object with a value for each `processor.property`"));
            }
        };
        Ok(Self { name, values })
    }

    /// The form in the file.
    pub fn to_json(&self) -> Json {
        let values: Map<String, Json> =
            self.values.iter().map(|(address, value)| (address.to_string(), value.clone())).collect();
        json!({"name": self.name, "values": values})
    }

    /// Sets all its values. Choices bring other properties with them: what is refused for want of a property is tried again
    /// after the others.
    ///
    /// # Errors
    /// A property that does not exist or refuses its value; the others are set.
    pub fn apply(&self, network: &mut Network) -> Result<(), EditError> {
        let mut left: Vec<_> = self.values.iter().collect();
        loop {
            let before = left.len();
            let mut refused = None;
            left.retain(|(address, value)| {
                let set = network.set_from_json(&address.processor, &address.item, value);
                let failed = set.is_err();
                refused = set.err().or(refused.take());
                failed
            });
            match refused {
                None => return Ok(()),
                Some(error) if left.len() == before => return Err(error),
                Some(_) => {}
            }
        }
    }
}

impl Network {
    /// The presets that the network keeps; what cannot be read as one is left out.
    pub fn presets(&self) -> Vec<Preset> {
        let presets = self.visualization.get("presets").and_then(Json::as_array);
        presets.into_iter().flatten().filter_map(|json| Preset::from_json(json).ok()).collect()
    }

    /// Keeps a preset, in the place of one of the same name if there is one.
    pub fn keep_preset(&mut self, preset: &Preset) {
        if !self.visualization.is_object() {
            self.visualization = Json::Object(Map::new());
        }
        let presets = &mut self.visualization["presets"];
        let mut kept = presets.as_array().cloned().unwrap_or_default();
        match kept.iter_mut().find(|known| known["name"] == preset.name.as_str()) {
            Some(known) => *known = preset.to_json(),
            None => kept.push(preset.to_json()),
        }
        *presets = Json::Array(kept);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_read_kept_and_replaced() {
        let json = json!({"name": "Fast", "values": {"traversal.rate": 0.5}});
        let preset = Preset::from_json(&json).expect("well formed");
        assert_eq!(preset.to_json(), json);
        for (wrong, reason) in [
            (json!([]), "expected an object"),
            (json!({"values": {}}), "no `name`"),
            (json!({"name": "x", "colour": 1}), "the field `colour`"),
            (json!({"name": "x", "values": {"rate": 1}}), "is not an address"),
            (json!({"name": "x", "values": []}), "a value for each"),
        ] {
            assert!(Preset::from_json(&wrong).is_err_and(|found| found.contains(reason)), "{wrong}");
        }
        let mut network = Network::new(std::sync::Arc::new(crate::Registry::new()));
        network.visualization = json!({"locked": true});
        network.keep_preset(&preset);
        network.keep_preset(&Preset { name: "Fine".into(), values: BTreeMap::new() });
        let slower = Preset { values: [(Address::new("traversal", "rate"), json!(2))].into(), ..preset };
        network.keep_preset(&slower);
        assert_eq!(network.presets(), [slower, Preset { name: "Fine".into(), values: BTreeMap::new() }]);
        assert_eq!(network.visualization["locked"], json!(true));
    }
}
