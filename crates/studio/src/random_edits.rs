//! Whatever is edited, undoing it all leads back to the file byte for byte, and redoing it forth again.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rayloom_network::{Address, Frame, Network, PropertyDecl, PropertyKind};
use rayloom_processors::{registry, snippet_library};
use rayloom_wgsl::{Library, Slot};
use serde_json::{Value as Json, json};

use crate::document::Document;
use crate::visualization::{Change, Layout};
use crate::wiring;

/// Steps of the history in a case.
const STEPS: usize = 50;

/// Kinds of edits.
const KINDS: usize = 20;

/// What a random edit is made from: its kind, and choices.
#[derive(Clone, Copy, Debug)]
struct Roll {
    kind: usize,
    which: [usize; 3],
    number: f64,
}

fn roll() -> impl Strategy<Value = Roll> {
    let choice = || 0..10_000_usize;
    (0..KINDS, [choice(), choice(), choice()], 0.0..1.0_f64).prop_map(|(kind, which, number)| Roll {
        kind,
        which,
        number,
    })
}

fn pick<T: Clone>(items: &[T], which: usize) -> Option<T> {
    items.get(which % items.len().max(1)).cloned()
}

fn ids(network: &Network) -> Vec<String> {
    network.processors().map(|processor| processor.id().to_owned()).collect()
}

/// A property, with its declaration; the same choice is the same property as long as nothing else changes.
fn property(network: &Network, which: usize) -> Option<(Address, PropertyDecl)> {
    let of = |processor: &rayloom_network::Processor| {
        let id = processor.id().to_owned();
        processor.property_decls().into_iter().map(move |decl| (Address::new(id.as_str(), &decl.id), decl))
    };
    pick(&network.processors().flat_map(of).collect::<Vec<_>>(), which)
}

/// A value for a property, of its kind.
fn value(decl: &PropertyDecl, which: usize, x: f64) -> Json {
    let within = |[low, high]: [f64; 2]| {
        let (low, high) = (low.max(-1e3), high.min(1e3));
        low + x * (high - low)
    };
    let knots =
        json!([{"at": -x, "color": [x, 0, 1], "opacity": x}, {"at": 40.0 * x, "color": [1, x, 0], "opacity": 0.5}]);
    match &decl.kind {
        PropertyKind::Bool => json!(which.is_multiple_of(2)),
        PropertyKind::Int { range, .. } => json!(within(range.map(|end| end as f64)).round() as i64),
        PropertyKind::Float { range, .. } => json!(within(*range)),
        PropertyKind::Vector { len, range, whole, .. } => {
            let number = if *whole { within(*range).round() } else { within(*range) };
            json!(vec![number; *len])
        }
        PropertyKind::Color => json!([x, 0.5, 1.0 - x, 1.0]),
        PropertyKind::Choice { choices } => json!(pick(choices, which).map(|choice| choice.id)),
        PropertyKind::Snippet { slot } => {
            let (library, _) = snippet_library();
            let slot = Slot::from_id(slot).expect("a slot");
            json!(pick(
                &library.snippets(slot).map(|(path, _)| Library::id(path).to_owned()).collect::<Vec<_>>(),
                which
            ))
        }
        PropertyKind::Text { .. } => json!(format!("text {which}")),
        PropertyKind::File { .. } => json!(format!("data/volume {which}.nrrd")),
        PropertyKind::ShaderText { slot } => json!(format!("//! slot: {slot}\n// {which}\n\t\"quoted\" \\ end\n")),
        PropertyKind::TransferFunction => json!({"knots": knots}),
        PropertyKind::TransferFunction2D => {
            let shape = json!({"rectangle": {"value": [0, 1.0 + x], "gradient": [0, 1]}});
            json!({"primitives": [{"shape": shape, "color": [x, 1, 1], "opacity": x}]})
        }
        PropertyKind::Labels => json!({"3": {"name": format!("label {which}"), "transfer_function": {"knots": knots}}}),
        PropertyKind::Camera => json!({"position": [100.0 * x, 300.0, which], "focus": [0, 0, x]}),
        PropertyKind::Light => json!({"direction": [x, 1, 2], "color": [x, 1, 1]}),
    }
}

/// A change of what visualization mode shows.
fn change(network: &Network, Roll { which, number, .. }: Roll) -> Option<Change> {
    let place = (which[1] % 3, which[2] % 4);
    let canvas = || {
        let canvases = network.processors().filter(|processor| processor.type_id() == "canvas");
        pick(&canvases.map(|processor| processor.id().to_owned()).collect::<Vec<_>>(), which[1])
    };
    Some(match which[0] % 14 {
        0 => Change::AddGroup(format!("Group {}", which[1])),
        1 => Change::TitleGroup(place.0, format!("Title {}", which[2])),
        2 => Change::MoveGroup(place.0, place.1),
        3 => Change::RemoveGroup(place.0),
        4 | 5 => Change::Expose(property(network, which[1])?.0, which[2] % 3),
        6 => Change::Label(place, (number > 0.3).then(|| format!("Label {number}"))),
        7 => Change::Range(place, (number > 0.3).then_some([number, number + 1.0])),
        8 => Change::MoveProperty(place, (which[2] % 2, which[1] % 5)),
        9 => Change::ShowCanvas(canvas()?, number > 0.5),
        10 => Change::Arrange(if number > 0.5 { Layout::FirstLarge } else { Layout::Grid }),
        11 => Change::StorePreset(format!("Preset {}", which[1] % 3)),
        12 => Change::RemovePreset(place.0),
        _ => Change::Lock(number > 0.5),
    })
}

/// Makes a random edit. What does not fit is refused, as it would be in the window, and leaves no step.
fn edit(network: &mut Network, roll: Roll) -> Result<(), String> {
    fn text(error: impl Display) -> String {
        error.to_string()
    }
    let Roll { which, number, .. } = roll;
    let all = ids(network);
    let one = |which: usize| pick(&all, which).ok_or_else(|| "there is none".to_owned());
    let some = |which: usize| one(which).map(|id| BTreeSet::from([id]));
    let types: Vec<String> = network.registry().declarations().map(|declaration| declaration.id.clone()).collect();
    let type_id = types[which[0] % types.len()].clone();
    let at = [(900.0 * number).round(), which[2] as f64];
    let wire = pick(network.connections(), which[1]).ok_or_else(|| "there is no wire".to_owned());
    match roll.kind {
        0 => wiring::add(network, &type_id, at).map(drop).map_err(text),
        1 => wiring::insert(network, &type_id, at, &wire?).map(drop).map_err(text),
        2 => wiring::replace(network, &one(which[1])?, &type_id).map(drop).map_err(text),
        3 => wiring::duplicate(network, &some(which[1])?).map(drop).map_err(text),
        4 => wiring::remove(network, &some(which[1])?, &BTreeSet::new()).map_err(text),
        5 => wiring::remove_and_reconnect(network, &some(which[1])?).map_err(text),
        6 => network.set_position(&one(which[1])?, at).map_err(text),
        7 => {
            let copied = wiring::copy(network, &BTreeSet::from([one(which[0])?, one(which[1])?]));
            wiring::paste(network, &copied, at).map(drop).map_err(text)
        }
        8 => {
            let wire = wire?;
            network.disconnect(&wire.from, &wire.to);
            Ok(())
        }
        9 => {
            let wire = wire?;
            let other = one(which[2])?;
            let inport = network.processor(&other).and_then(|p| p.declaration()).map(|d| d.inports.clone());
            let inport = pick(&inport.unwrap_or_default(), which[0]).ok_or("there is no inport")?;
            wiring::connect(network, &rayloom_network::Connection { to: Address::new(other, inport.id), ..wire })
                .map_err(text)
        }
        10 => wiring::rename(network, &one(which[1])?, &network.free_id("renamed")).map_err(text),
        11 => network.set_label(&one(which[1])?, Some(format!("Name {number}"))).map_err(text),
        12 => {
            let (a, decl) = property(network, which[0]).ok_or("there is none")?;
            let same =
                |network: &Network, id: &str| network.processor(id).and_then(|p| p.property_decl(&decl.id)).is_some();
            let others: Vec<String> =
                all.iter().filter(|id| **id != a.processor && same(network, id)).cloned().collect();
            let other = pick(&others, which[1]).ok_or("there is none")?;
            network.link(&a, Address::new(other, &a.item)).map_err(text)
        }
        13 | 14 => {
            change(network, roll).ok_or("nothing to show")?.apply(network);
            Ok(())
        }
        15 => {
            let mut frames = network.frames().to_vec();
            match frames.get(which[0] % 4) {
                Some(_) if number < 0.2 => drop(frames.remove(which[0] % 4)),
                Some(_) => frames[which[0] % 4].rect[2] += number,
                None => frames.push(Frame {
                    title: format!("Frame {number}"),
                    text: "two\nlines".into(),
                    rect: [at[0], at[1], 200.0, 100.0],
                }),
            }
            network.set_frames(frames).map_err(text)
        }
        _ => {
            let (address, decl) = property(network, which[1]).ok_or("there is none")?;
            let json = value(&decl, which[2], number);
            network.set_from_json(&address.processor, &address.item, &json).map(drop).map_err(text)
        }
    }
}

/// Edits a document as the window does: most edits are a step, a dragged value is many edits in one.
fn make_step(document: &mut Document, roll: Roll) {
    let dragged = roll.kind == KINDS - 1;
    let numbers = if dragged { vec![0.1, 0.7, roll.number] } else { vec![roll.number] };
    for number in numbers {
        let key = format!("{:?}", roll.which);
        let edit = |network: &mut Network| edit(network, Roll { number, ..roll });
        let _ = match dragged {
            true => document.edit_merged("drag", &key, edit),
            false => document.edit("edit", edit),
        };
    }
    document.settle();
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 8,
        rng_seed: RngSeed::Fixed(7),
        failure_persistence: None,
        max_shrink_iters: 40,
        ..ProptestConfig::default()
    })]

    #[test]
    fn fifty_random_edits_are_undone_and_redone_byte_for_byte(rolls in prop::collection::vec(roll(), 600)) {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks/brain.json");
        let registry = Arc::new(registry());
        let (mut document, _) = Document::load(&shipped, &registry).expect("loaded");
        let mut texts = vec![document.text()];
        let mut rolls = rolls.into_iter();
        while texts.len() <= STEPS {
            make_step(&mut document, rolls.next().expect("enough edits that fit"));
            let text = document.text();
            if texts.last() != Some(&text) {
                texts.push(text);
            }
        }
        for text in texts.iter().rev().skip(1) {
            prop_assert!(document.undo());
            prop_assert_eq!(&document.text(), text);
        }
        prop_assert!(!document.undo() && !document.is_modified());
        for text in &texts[1..] {
            prop_assert!(document.redo());
            prop_assert_eq!(&document.text(), text);
        }
        let again = Network::from_text(&document.text(), &shipped, &registry);
        let again = again.map_err(|error| TestCaseError::fail(error.to_string()))?.network;
        prop_assert_eq!(again.to_text(shipped.parent()), document.text());
    }
}
