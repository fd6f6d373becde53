//! Which values of a preset cannot be set.

use rayloom_network::{Address, Network, Preset};
use serde_json::Value as Json;

use super::declared;

/// The properties that cannot have the value that a preset stores, each with the reason.
pub fn refused(preset: &Preset, network: &Network) -> Vec<(Address, String)> {
    let refused = |(address, value)| Some((Address::clone(address), refusal(network, address, value)?));
    preset.values.iter().filter_map(refused).collect()
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
