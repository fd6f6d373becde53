//! Whatever is done to a network, it has no cycle, and its file says all of it.

use std::path::Path;

use proptest::prelude::*;
use rayloom_network::*;

use crate::fake::{Counter, registry};

const TYPES: [&str; 8] = ["source", "generator", "proxy", "traversal", "preview", "filter", "compositor", "canvas"];
const OUTPORTS: [&str; 5] = ["volume", "geometry", "image", "depth", "image_out"];
const INPORTS: [&str; 4] = ["volume", "geometry", "image", "layers"];
const PROPERTIES: [&str; 10] =
    ["file", "precision", "rate", "camera", "tint", "shading", "shading.ambient", "size", "early", "extent"];

#[derive(Clone, Debug)]
enum Edit {
    Add(usize),
    Remove(usize),
    Rename(usize),
    Connect(usize, usize, usize, usize),
    Disconnect(usize),
    Set(usize, usize, f64),
    Link(usize, usize, usize),
    Unlink(usize),
    Move(usize, f64),
}

fn edit() -> impl Strategy<Value = Edit> {
    let (p, o, i, q) = (0..12_usize, 0..OUTPORTS.len(), 0..INPORTS.len(), 0..PROPERTIES.len());
    prop_oneof![
        5 => (0..TYPES.len()).prop_map(Edit::Add),
        1 => p.clone().prop_map(Edit::Remove),
        1 => p.clone().prop_map(Edit::Rename),
        40 => (p.clone(), o, p.clone(), i).prop_map(|(a, o, b, i)| Edit::Connect(a, o, b, i)),
        1 => p.clone().prop_map(Edit::Disconnect),
        10 => (p.clone(), q.clone(), -3.0..20.0_f64).prop_map(|(p, q, x)| Edit::Set(p, q, x)),
        10 => (p.clone(), p.clone(), q).prop_map(|(a, b, q)| Edit::Link(a, b, q)),
        1 => p.clone().prop_map(Edit::Unlink),
        2 => (p, any::<f64>()).prop_map(|(p, x)| Edit::Move(p, x)),
    ]
}

/// A value that may or may not suit a property of this name.
fn value(property: &str, x: f64) -> Value {
    match property {
        "file" => Value::Text(format!("data/{x}.nrrd")),
        "precision" => Value::Text(if x > 3.0 { "8-bit" } else { "auto" }.into()),
        "camera" => Value::Camera(Camera { position: [x.floor(), 0.0, 0.1], ..Camera::default() }),
        "tint" => Value::Color([x / 10.0, 0.25, 1.0 / 3.0, 1.0]),
        "shading" => Value::Text(if x > 3.0 { "phong" } else { "flat" }.into()),
        "size" => Value::Vector(vec![(x * 100.0).floor(), 64.0]),
        "early" => Value::Bool(x > 3.0),
        "extent" => Value::Vector(vec![x, x.floor(), 1e-7]),
        _ => Value::Float(x),
    }
}

/// Applies an edit; a refusal is fine.
fn apply(network: &mut Network, edit: &Edit) {
    let ids: Vec<String> = network.processors().map(|p| p.id().to_owned()).collect();
    let id = |i: &usize| ids.get(i % ids.len().max(1)).cloned().unwrap_or_default();
    match edit {
        Edit::Add(t) => network.add(TYPES[*t], &network.free_id(TYPES[*t])).unwrap(),
        Edit::Remove(p) => drop(network.remove(&id(p))),
        Edit::Rename(p) => drop(network.rename(&id(p), &network.free_id("named"))),
        Edit::Connect(a, o, b, i) => drop(network.connect((id(a), OUTPORTS[*o]), (id(b), INPORTS[*i]))),
        Edit::Disconnect(c) => {
            if let Some(connection) = network.connections().get(*c).cloned() {
                assert!(network.disconnect(connection.from, connection.to));
            }
        }
        Edit::Set(p, q, x) => drop(network.set_property(&id(p), PROPERTIES[*q], value(PROPERTIES[*q], *x))),
        Edit::Link(a, b, q) => drop(network.link((id(a), PROPERTIES[*q]), (id(b), PROPERTIES[*q]))),
        Edit::Unlink(l) => {
            if let Some(link) = network.links().get(*l).cloned() {
                assert!(network.unlink(link.b, link.a));
            }
        }
        Edit::Move(p, x) => drop(network.set_position(&id(p), [*x, 0.5])),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn networks_stay_sound(edits in prop::collection::vec(edit(), 1..120)) {
        let mut network = Network::new(registry());
        let (mut evaluator, mut backend) = (Evaluator::new(), Counter::default());
        for (i, edit) in edits.iter().enumerate() {
            apply(&mut network, edit);
            // Every processor has a place in the order only if there is no cycle.
            prop_assert_eq!(network.order().len(), network.processors().count());
            for link in network.links() {
                let (a, b) = (&link.a, &link.b);
                let (a, b) = (network.value(&a.processor, &a.item), network.value(&b.processor, &b.item));
                prop_assert!(a == b || a.is_none() || b.is_none(), "{} differs", link);
            }
            if i % 16 == 0 {
                evaluator.evaluate(&network, &mut backend, &Request::default());
            }
        }
        evaluator.evaluate(&network, &mut backend, &Request::default());
        prop_assert!(evaluator.evaluate(&network, &mut backend, &Request::default()).runs.is_empty());

        let file = Path::new("/nets/some.json");
        let text = network.to_text(file.parent());
        let loaded = Network::from_text(&text, file, &registry()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(loaded.network.to_text(file.parent()), text);
        // The same network again: the values, not only the text.
        for processor in network.processors() {
            let again = loaded.network.processor(processor.id()).map(|p| p.properties());
            let (was, is) = (without_file(processor.properties()), again.map(without_file));
            prop_assert_eq!(Some(was), is);
        }
    }
}

/// The path of a file comes back absolute, so it is left out.
fn without_file(properties: Properties) -> Vec<(String, Value)> {
    let kept = properties.iter().filter(|(id, _)| *id != "file");
    kept.map(|(id, value)| (id.to_owned(), value.clone())).collect()
}
