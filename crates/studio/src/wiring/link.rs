//! Links that come about by themselves, and properties that fit each other.

use std::collections::BTreeSet;

use rayloom_network::{Address, Network, PropertyDecl, PropertyKind};

/// Links the cameras of a processor that was just added with the others, where all of these are one: there is a single one,
/// or all are linked. The new camera is as declared, so no value is lost. Cameras that differ stay apart.
pub fn link_cameras(network: &mut Network, new: &str) {
    let cameras = cameras(network);
    let (own, others): (Vec<Address>, Vec<Address>) = cameras.into_iter().partition(|camera| camera.processor == new);
    let Some(first) = others.first() else { return };
    let group: BTreeSet<Address> = network.linked_with(first).into_iter().collect();
    if !others.iter().all(|other| group.contains(other)) {
        return;
    }
    for camera in own {
        // A camera takes the value of any other.
        let _ = network.link(first, &camera);
    }
}

fn cameras(network: &Network) -> Vec<Address> {
    let of = |processor: &rayloom_network::Processor| {
        let id = processor.id().to_owned();
        let decls = processor.property_decls().into_iter().filter(|decl| decl.kind == PropertyKind::Camera);
        decls.map(move |decl| Address::new(id.as_str(), decl.id)).collect::<Vec<_>>()
    };
    network.processors().flat_map(of).collect()
}

/// The properties of a processor that may follow a property of another; those of the same name first.
pub fn followers(network: &Network, leader: &Address, processor: &str) -> Vec<(Address, PropertyDecl)> {
    let Some(processor) = network.processor(processor).filter(|p| p.id() != leader.processor) else {
        return Vec::new();
    };
    let decls = processor.property_decls().into_iter().map(|decl| (Address::new(processor.id(), &decl.id), decl));
    let mut found: Vec<_> = decls.filter(|(address, _)| network.can_link(leader, address).is_ok()).collect();
    found.sort_by_key(|(address, _)| address.item != leader.item);
    found
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use serde_json::json;

    use super::*;
    use crate::wiring::add;

    fn position(network: &Network, id: &str) -> serde_json::Value {
        network.value(id, "camera").expect("a camera").to_json()["position"].clone()
    }

    #[test]
    fn a_new_camera_joins_the_others_only_where_they_are_one() {
        let mut network = Network::new(Arc::new(rayloom_processors::registry()));
        let add = |network: &mut Network| add(network, "entry_exit_points", [0.0; 2]).expect("added");
        let first = add(&mut network);
        network.set_from_json(&first, "camera", &json!({"position": [1, 2, 3]})).expect("set");
        let second = add(&mut network);
        assert_eq!(network.links().len(), 1);
        assert_eq!(position(&network, &second), json!([1.0, 2.0, 3.0]));
        network.unlink((first.as_str(), "camera"), (second.as_str(), "camera"));
        network.set_from_json(&second, "camera", &json!({"position": [7, 8, 9]})).expect("set");
        let third = add(&mut network);
        assert!(network.links().is_empty(), "which of the two would it follow?");
        assert_eq!(position(&network, &second), json!([7.0, 8.0, 9.0]));
        let leader = Address::new(first, "camera");
        let fitting: Vec<_> = followers(&network, &leader, &third).into_iter().map(|(a, _)| a.item).collect();
        assert_eq!(fitting, ["camera"]);
        assert!(followers(&network, &leader, &leader.processor).is_empty());
    }
}
