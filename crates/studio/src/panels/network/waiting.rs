//! Which processors cannot run, in one pass over the network. (Why a single one cannot is told by its tooltip.)

use std::collections::{BTreeMap, BTreeSet};

use rayloom_network::{Address, Network, Processor, PropertyKind, Value};

/// Ids of the processors that wait: a required inport is open or a file not chosen, here or at anything that feeds them.
pub fn waiting(network: &Network) -> BTreeSet<&str> {
    let fed: BTreeSet<&Address> = network.connections().iter().map(|wire| &wire.to).collect();
    let mut fed_by: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for wire in network.connections() {
        fed_by.entry(&wire.from.processor).or_default().push(&wire.to.processor);
    }
    let mut stack: Vec<&str> = network.processors().filter(|p| waits(p, &fed)).map(Processor::id).collect();
    let mut waiting: BTreeSet<&str> = stack.iter().copied().collect();
    while let Some(id) = stack.pop() {
        let next = fed_by.get(id).into_iter().flatten().copied();
        stack.extend(next.filter(|next| waiting.insert(next)));
    }
    waiting
}

/// Whether a processor itself lacks something.
fn waits(processor: &Processor, fed: &BTreeSet<&Address>) -> bool {
    let Some(declaration) = processor.declaration() else { return true };
    let open = |port: &str| !fed.contains(&Address::new(processor.id(), port));
    let file = |property: &str| processor.value(property) == Some(Value::Text(String::new()));
    declaration.inports.iter().any(|port| !port.optional && open(&port.id))
        || declaration
            .properties
            .iter()
            .any(|property| matches!(property.kind, PropertyKind::File { required: true, .. }) && file(&property.id))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rayloom_network::readiness;

    use super::*;

    #[test]
    fn the_same_processors_wait_as_the_network_says() {
        let mut network = Network::new(Arc::new(rayloom_processors::registry()));
        let types = ["volume_source", "volume_generator", "cube_proxy", "entry_exit_points", "background", "canvas"];
        for id in types {
            network.add(id, id).expect("added");
        }
        network.add("cube_proxy", "ready").expect("added");
        for (from, to) in [
            ("volume_source.volume", "cube_proxy.volume"),
            ("cube_proxy.geometry", "entry_exit_points.geometry"),
            ("volume_generator.volume", "ready.volume"),
        ] {
            let (from, to): (Address, Address) = (from.parse().expect("address"), to.parse().expect("address"));
            network.connect(from, to).expect("connected");
        }
        let found = waiting(&network);
        for processor in network.processors() {
            assert_eq!(
                found.contains(processor.id()),
                !readiness(&network, processor.id()).is_ready(),
                "{}",
                processor.id()
            );
        }
    }
}
