//! An inport for several wires on the node canvas, by mouse and keyboard.

mod window;

use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable;
use rayloom_network::{Declaration, ImageKind, InportDecl, OutportDecl, Outputs, PortType, ProcessError};
use rayloom_processors::{PlainProcess, Process};
use rayloom_studio::Options;
use serde_json::json;
use window::nodes::{Window, drag_and_drop, key, on_canvas, socket, wire};
use window::{keep_picture, studio, wait_for};

/// A processor that takes several images and gives the first of them.
fn mixer() -> Vec<Arc<dyn Process>> {
    let color = PortType::Image(ImageKind::Color);
    let declaration = Declaration::new("mixer", "Mixer", "Image")
        .input(InportDecl::new("layers", "Layers", &[color]).several().help("What is mixed."))
        .output(OutportDecl::new("image", "Image", color));
    vec![PlainProcess::shared(declaration, |_, job| match job.inputs("layers") {
        [first, ..] => Ok(Outputs::new().with("image", first.data.clone())),
        [] => Err(ProcessError::new("nothing to mix")),
    })]
}

/// Three backgrounds, of which one is mixed, and two canvases.
fn opened(folder: &Path) -> Window {
    let file = folder.join("several.json");
    let node = |id: &str, type_id: &str, at: [f64; 2]| json!({"id": id, "type": type_id, "position": at});
    let network = json!({
        "rayloom": 1,
        "processors": [
            node("red", "background", [0.0, 0.0]),
            node("green", "background", [0.0, 140.0]),
            node("blue", "background", [0.0, 280.0]),
            node("mix", "mixer", [320.0, 100.0]),
            node("canvas", "canvas", [600.0, 60.0]),
            node("other", "canvas", [600.0, 260.0]),
        ],
        "connections": ["red.image -> mix.layers", "mix.image -> canvas.image"],
    });
    std::fs::write(&file, network.to_string()).expect("written");
    let mut window = studio(Options { network: Some(file), more_processors: Some(mixer), ..Options::default() });
    wait_for(&mut window, "processor canvas (Canvas): ready");
    window.run_steps(8);
    window
}

/// What feeds an inport, in the order of the file.
fn into(window: &Window, inport: &str) -> Vec<String> {
    let wires = window.state().session.network().connections().iter();
    wires.filter(|wire| wire.to.to_string() == inport).map(|wire| wire.from.to_string()).collect()
}

#[test]
fn wires_are_added_moved_and_cut_one_by_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    // Dropped on the port they add, and so they do on the socket of a wire that is there.
    wire(&mut window, "green.image -> mix.layers");
    assert_eq!(into(&window, "mix.layers"), ["red.image", "green.image"]);
    let (from, to) = (socket(&window, "output blue.image"), socket(&window, "input mix.layers from green.image"));
    drag_and_drop(&mut window, from, to);
    let all = ["red.image", "green.image", "blue.image"];
    assert_eq!(into(&window, "mix.layers"), all);
    wait_for(&mut window, "processor canvas (Canvas): ready");
    keep_picture(&mut window, "several");
    // A second time: refused with the reason.
    wire(&mut window, "green.image -> mix.layers");
    assert_eq!(into(&window, "mix.layers"), all);
    let told = |window: &Window, text: &str| window.state().session.messages.iter().any(|m| m.text == text);
    assert!(told(&window, "green.image and mix.layers are already connected."));

    // The end of one is taken off and plugged in elsewhere; the others stay.
    let (held, other) = (socket(&window, "input mix.layers from green.image"), socket(&window, "input other.image"));
    drag_and_drop(&mut window, held, other);
    assert_eq!(into(&window, "mix.layers"), ["red.image", "blue.image"]);
    assert_eq!(into(&window, "other.image"), ["green.image"]);
    // Taken off that again and brought back.
    let (held, port) = (socket(&window, "input other.image"), socket(&window, "input mix.layers"));
    drag_and_drop(&mut window, held, port);
    assert_eq!(into(&window, "mix.layers"), ["red.image", "blue.image", "green.image"]);
    assert!(into(&window, "other.image").is_empty());
    // Let go where it was: nothing happens.
    let before = window.state().session.document.text();
    let held = socket(&window, "input mix.layers from blue.image");
    drag_and_drop(&mut window, held, port);
    assert_eq!(window.state().session.document.text(), before);
    // Let go over nothing: that one is cut.
    let empty = on_canvas(&window, (0.5, 0.9));
    let held = socket(&window, "input mix.layers from blue.image");
    drag_and_drop(&mut window, held, empty);
    assert_eq!(into(&window, "mix.layers"), ["red.image", "green.image"]);
    assert!(window.query_by_label("input mix.layers from blue.image").is_none());
    // Every step is undone on its own.
    for expected in [vec!["red.image", "blue.image", "green.image"], vec!["red.image", "blue.image"], all.to_vec()] {
        key(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(into(&window, "mix.layers"), expected);
    }
}

#[test]
fn every_one_of_several_wires_shows_what_flows_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    wire(&mut window, "green.image -> mix.layers");
    wire(&mut window, "blue.image -> mix.layers");
    wait_for(&mut window, "processor canvas (Canvas): ready");
    let nothing = Pos2::new(600.0, 10.0);
    for outport in ["red.image", "green.image", "blue.image"] {
        let (output, input) = (format!("output {outport}"), format!("input mix.layers from {outport}"));
        let center = |label: &str| window.get_by_label(label).rect().center();
        for at in [center(&output).lerp(center(&input), 0.5), center(&input)] {
            window.hover_at(nothing);
            window.run_steps(24);
            assert!(window.query_by_label(outport).is_none(), "{outport} is shown although nothing rests there");
            window.hover_at(at);
            window.run_steps(24);
            assert!(window.query_by_label(outport).is_some(), "nothing shown on the wire from {outport}");
        }
    }
    // The port itself says that it takes several.
    let port = window.get_by_label("input mix.layers").rect().center();
    window.hover_at(port);
    window.run_steps(24);
    assert!(window.query_by_label("mix.layers, an image of colour, takes several").is_some());
    keep_picture(&mut window, "several_hovered");
}
