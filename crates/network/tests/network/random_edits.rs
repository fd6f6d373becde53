//! Whatever is done to a network, it has no cycle, and its file says all of it.

use std::path::Path;

use proptest::prelude::*;
use rayloom_network::*;

use crate::fake::{Counter, registry};

const TYPES: [&str; 9] =
    ["source", "generator", "proxy", "traversal", "preview", "filter", "compositor", "mixture", "canvas"];

#[derive(Clone, Debug)]
enum Edit {
    Add(usize),
    Remove(usize),
    Rename(usize),
    Connect(usize),
    Disconnect(usize),
    Set(usize, f64),
    Link(usize),
    Unlink(usize),
    Move(usize, f64),
}

fn edit() -> impl Strategy<Value = Edit> {
    let (p, k) = (0..12_usize, 0..100_000_usize);
    prop_oneof![
        5 => (0..TYPES.len()).prop_map(Edit::Add),
        1 => p.clone().prop_map(Edit::Remove),
        1 => p.clone().prop_map(Edit::Rename),
        30 => k.clone().prop_map(Edit::Connect),
        1 => p.clone().prop_map(Edit::Disconnect),
        20 => (k.clone(), -3.0..20.0_f64).prop_map(|(k, x)| Edit::Set(k, x)),
        10 => k.prop_map(Edit::Link),
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
        Edit::Connect(k) => {
            if let Some((from, to)) = pick(fitting(network), *k) {
                drop(network.connect(from, to));
            }
        }
        Edit::Disconnect(c) => {
            if let Some(connection) = network.connections().get(*c).cloned() {
                assert!(network.disconnect(connection.from, connection.to));
            }
        }
        Edit::Set(k, x) => {
            if let Some(Address { processor, item }) = pick(properties(network), *k) {
                drop(network.set_property(&processor, &item, value(&item, *x)));
            }
        }
        Edit::Link(k) => {
            if let Some((a, b)) = pick(alike(network), *k) {
                drop(network.link(a, b));
            }
        }
        Edit::Unlink(l) => {
            if let Some(link) = network.links().get(*l).cloned() {
                assert!(network.unlink(link.b, link.a));
            }
        }
        Edit::Move(p, x) => drop(network.set_position(&id(p), [*x, 0.5])),
    }
}

fn pick<T>(mut candidates: Vec<T>, k: usize) -> Option<T> {
    (!candidates.is_empty()).then(|| candidates.swap_remove(k % candidates.len()))
}

/// Every outport with every inport that takes what it gives, whether or not they may be connected now.
fn fitting(network: &Network) -> Vec<(Address, Address)> {
    let mut pairs = Vec::new();
    for (source, target) in network.processors().flat_map(|a| network.processors().map(move |b| (a, b))) {
        let (Some(from), Some(to)) = (source.declaration(), target.declaration()) else { continue };
        for (outport, inport) in from.outports.iter().flat_map(|o| to.inports.iter().map(move |i| (o, i))) {
            if inport.accepts.contains(&outport.port_type) {
                pairs.push(((source.id(), &*outport.id).into(), (target.id(), &*inport.id).into()));
            }
        }
    }
    pairs
}

fn properties(network: &Network) -> Vec<Address> {
    let of = |p: &Processor| {
        let address = |decl: PropertyDecl| Address::new(p.id(), decl.id);
        p.property_decls().into_iter().map(address).collect::<Vec<_>>()
    };
    network.processors().flat_map(of).collect()
}

/// Every two properties of the same name.
fn alike(network: &Network) -> Vec<(Address, Address)> {
    let properties = properties(network);
    let pairs = properties.iter().flat_map(|a| properties.iter().map(move |b| (a.clone(), b.clone())));
    pairs.filter(|(a, b)| a.item == b.item).collect()
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

        // The same connections made in another order are the same network.
        let backwards = rewired_backwards(&network).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert!(evaluator.evaluate(&backwards, &mut backend, &Request::default()).runs.is_empty());

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

/// The network with its connections made again, the last first.
fn rewired_backwards(network: &Network) -> Result<Network, Refusal> {
    let mut backwards = network.clone();
    for Connection { from, to } in network.connections() {
        backwards.disconnect(from, to);
    }
    network.connections().iter().rev().try_for_each(|Connection { from, to }| backwards.connect(from, to))?;
    Ok(backwards)
}

/// The path of a file comes back absolute, so it is left out.
fn without_file(properties: Properties) -> Vec<(String, Value)> {
    let kept = properties.iter().filter(|(id, _)| *id != "file");
    kept.map(|(id, value)| (id.to_owned(), value.clone())).collect()
}
