//! Sets of values: setting them, and which of them cannot be set.

use rayloom_network::{Address, EditError, Network};
use serde_json::Value as Json;

use super::{Preset, declared};

impl Preset {
    /// Sets all values. Choices come first, since they bring other properties with them: what is refused for want of a
    /// property is tried again after the others.
    ///
    /// # Errors
    /// A value cannot be set; the others are.
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

    /// The properties that cannot have the stored value, each with the reason.
    pub fn refused(&self, network: &Network) -> Vec<(Address, String)> {
        let refused = |(address, value)| Some((Address::clone(address), refusal(network, address, value)?));
        self.values.iter().filter_map(refused).collect()
    }
}

/// Why a property cannot have a value. A value for a property that another choice brings with it may well be fine.
fn refusal(network: &Network, address: &Address, value: &Json) -> Option<String> {
    let mut trial = network.clone();
    match declared(network, address) {
        Ok(_) => trial.set_from_json(&address.processor, &address.item, value).err().map(|error| error.to_string()),
        Err(problem) if network.processor(&address.processor).is_none() => Some(problem),
        Err(_) => None,
    }
}
