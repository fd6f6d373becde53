use std::collections::BTreeSet;
use std::sync::Arc;

use rayloom_network::{Connection, Network};
use serde_json::json;

use super::*;

/// source -> proxy -> view -> traversal -> canvas, the volume also into the traversal.
fn chain() -> Network {
    let mut network = Network::new(Arc::new(rayloom_processors::registry()));
    for (type_id, id) in [
        ("volume_generator", "source"),
        ("cube_proxy", "proxy"),
        ("entry_exit_points", "view"),
        ("ray_traversal", "traversal"),
        ("canvas", "canvas"),
    ] {
        network.add(type_id, id).expect("added");
    }
    for text in [
        "source.volume -> proxy.volume",
        "proxy.geometry -> view.geometry",
        "source.volume -> traversal.volume",
        "view.entry -> traversal.entry",
        "view.exit -> traversal.exit",
        "traversal.image -> canvas.image",
    ] {
        connect(&mut network, &wire(text)).expect("connected");
    }
    network
}

fn wire(text: &str) -> Connection {
    let (from, to) = text.split_once(" -> ").expect("a wire");
    Connection { from: from.parse().expect("an address"), to: to.parse().expect("an address") }
}

fn wires(network: &Network) -> Vec<String> {
    network.connections().iter().map(ToString::to_string).collect()
}

fn set(ids: &[&str]) -> BTreeSet<String> {
    ids.iter().map(|id| (*id).to_owned()).collect()
}

#[test]
fn a_taken_inport_is_fed_anew_and_cycles_are_refused_all_the_same() {
    let mut network = chain();
    let id = add(&mut network, "volume_generator", [0.0, 0.0]).expect("added");
    connect(&mut network, &wire(&format!("{id}.volume -> proxy.volume"))).expect("connected");
    assert!(wires(&network).contains(&format!("{id}.volume -> proxy.volume")));
    assert!(!wires(&network).contains(&"source.volume -> proxy.volume".to_owned()));
    let end = |text: &str| End::Outport(text.parse().expect("an address"));
    let entry = End::Inport("traversal.entry".parse().expect("an address"));
    assert_eq!(
        verdict(&network, &end("view.entry"), &entry),
        Err("view.entry and traversal.entry are already connected.".into())
    );
    let reason = verdict(&network, &end("proxy.geometry"), &entry).expect_err("another type");
    assert!(reason.contains("proxy.geometry gives a geometry, but traversal.entry takes"), "{reason}");
    add(&mut network, "background", [0.0, 0.0]).expect("added");
    connect(&mut network, &wire("traversal.image -> background.front")).expect("connected");
    add(&mut network, "compositor", [0.0, 0.0]).expect("added");
    let own = verdict(&network, &end("background.image"), &End::Inport("background.front".parse().expect("address")));
    assert!(own.expect_err("itself").contains("cannot feed itself"));
}

#[test]
fn only_processors_that_fit_are_offered() {
    let network = chain();
    let registry = network.registry().clone();
    let at =
        |end: End| fitting(&registry, &network, &end).iter().map(|fit| fit.declaration.to_owned()).collect::<Vec<_>>();
    let after_proxy = at(End::Outport("proxy.geometry".parse().expect("an address")));
    assert!(after_proxy.contains(&"entry_exit_points".to_owned()) && !after_proxy.contains(&"cube_proxy".to_owned()));
    let before_proxy = at(End::Inport("proxy.volume".parse().expect("an address")));
    assert!(before_proxy.contains(&"volume_source".to_owned()) && !before_proxy.contains(&"canvas".to_owned()));
}

#[test]
fn a_processor_is_put_into_a_wire_or_refused_with_the_reason() {
    let mut network = chain();
    let image = wire("traversal.image -> canvas.image");
    let id = insert(&mut network, "background", [1.0, 2.0], &image).expect("inserted");
    assert!(wires(&network).contains(&format!("traversal.image -> {id}.front")));
    assert!(wires(&network).contains(&format!("{id}.image -> canvas.image")));
    let refused = insert(&mut network, "cube_proxy", [0.0, 0.0], &wire("view.entry -> traversal.entry"));
    assert!(refused.expect_err("refused").to_string().contains("does not fit into view.entry -> traversal.entry"));
    remove_and_reconnect(&mut network, &set(&[&id])).expect("removed");
    assert!(wires(&network).contains(&image.to_string()));
}

#[test]
fn replacing_keeps_what_fits() {
    let mut network = chain();
    network.set_position("source", [5.0, 6.0]).expect("moved");
    replace(&mut network, "source", "volume_source").expect("replaced");
    let source = network.processor("source").expect("there");
    assert_eq!((source.type_id(), source.position()), ("volume_source", [5.0, 6.0]));
    assert!(wires(&network).contains(&"source.volume -> proxy.volume".to_owned()));
    assert_eq!(wires(&network).len(), 6);
}

#[test]
fn copies_keep_values_and_the_wires_among_them() {
    let mut network = chain();
    network.set_from_json("traversal", "sampling_rate", &json!(3.0)).expect("set");
    let text = copy(&network, &set(&["view", "traversal"]));
    let pasted = paste(&mut network, &text, [100.0, 50.0]).expect("pasted");
    assert_eq!(pasted, set(&["view_2", "traversal_2"]));
    assert_eq!(network.value("traversal_2", "sampling_rate"), network.value("traversal", "sampling_rate"));
    assert!(wires(&network).contains(&"view_2.entry -> traversal_2.entry".to_owned()));
    let copied = duplicate(&mut network, &set(&["traversal_2"])).expect("duplicated");
    assert_eq!(copied, set(&["traversal_3"]));
    assert!(wires(&network).contains(&"view_2.entry -> traversal_3.entry".to_owned()));
    let refused = paste(&mut network, "not a network", [0.0, 0.0]).expect_err("refused");
    assert!(refused.to_string().starts_with("the clipboard holds no processors: "), "{refused}");
}

#[test]
fn what_is_put_into_a_wire_pushes_aside_what_lies_behind() {
    let mut network = chain();
    for (id, x) in [("source", -220.0), ("traversal", 0.0), ("canvas", 220.0)] {
        network.set_position(id, [x, 0.0]).expect("moved");
    }
    let x = |network: &Network, id: &str| network.processor(id).expect("there").position()[0];
    let new =
        insert(&mut network, "background", [110.0, 20.0], &wire("traversal.image -> canvas.image")).expect("fits");
    assert_eq!([x(&network, &new), x(&network, "canvas"), x(&network, "source")], [220.0, 440.0, -220.0]);
    // Where there is room, nothing moves.
    network.set_position("canvas", [900.0, 0.0]).expect("moved");
    let wire = wire(&format!("{new}.image -> canvas.image"));
    let newer = insert(&mut network, "background", [500.0, 0.0], &wire).expect("fits");
    assert_eq!([x(&network, &newer), x(&network, "canvas")], [500.0, 900.0]);
}
