//! Removing processors and wires.

use std::collections::BTreeSet;

use rayloom_network::{Connection, EditError, Network};

/// Removes wires and processors with all that is connected to them.
///
/// # Errors
/// There is no such processor.
pub fn remove(network: &mut Network, ids: &BTreeSet<String>, wires: &BTreeSet<Connection>) -> Result<(), EditError> {
    for wire in wires {
        network.disconnect(&wire.from, &wire.to);
    }
    ids.iter().try_for_each(|id| network.remove(id))
}

/// Removes processors, and lets what fed each of them feed what it fed, where that fits.
///
/// # Errors
/// There is no such processor.
pub fn remove_and_reconnect(network: &mut Network, ids: &BTreeSet<String>) -> Result<(), EditError> {
    for id in ids {
        let inputs: Vec<Connection> = network.inputs(id).cloned().collect();
        let outputs: Vec<Connection> = network.outputs(id).cloned().collect();
        network.remove(id)?;
        for output in &outputs {
            // An inport for one is taken by the first that fits; the other inputs have nowhere to go.
            inputs.iter().for_each(|input| drop(network.connect(&input.from, &output.to)));
        }
    }
    Ok(())
}
