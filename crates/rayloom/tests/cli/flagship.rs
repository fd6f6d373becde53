//! The flagship network, built from nothing in the window, gives the picture that the command line makes of its file.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use rayloom_network::PropertyKind;
use rayloom_studio::Options;
use serde_json::Value as Json;

use crate::program::{rayloom, root};
use crate::window::nodes::{Window, add, key, on_canvas, wire, zoom_out};
use crate::window::{keep_picture, studio, wait_until};

/// Where the processors are put, as share of the canvas.
const PLACES: [(f32, f32); 6] = [(0.15, 0.2), (0.15, 0.6), (0.42, 0.6), (0.55, 0.2), (0.8, 0.2), (0.82, 0.6)];

pub fn click(window: &mut Window, role: Role, label: &str) {
    window.get_by_role_and_label(role, label).scroll_to_me();
    window.run_steps(20);
    window.get_by_role_and_label(role, label).click();
    window.run_steps(4);
}

pub fn type_over(window: &mut Window, text: &str) {
    key(window, Modifiers::COMMAND, Key::A);
    window.event(Event::Text(text.to_owned()));
    window.run_steps(2);
}

/// Sets a property of a processor as a user does: chooses from its list, types its number, or types its text.
fn set(window: &mut Window, id: &str, property: &str, json: &Json) {
    let decl = window.state().session.network().processor(id).and_then(|p| p.property_decl(property));
    let decl = decl.unwrap_or_else(|| panic!("{id} has no {property}"));
    let text = json.as_str().map_or_else(|| json.to_string(), str::to_owned);
    match &decl.kind {
        PropertyKind::Snippet { .. } => {
            click(window, Role::ComboBox, &decl.label);
            let choice = match text.as_str() {
                "blinn_phong" => "Blinn-Phong",
                other => panic!("what is {other} called?"),
            };
            click(window, Role::Button, choice);
        }
        PropertyKind::Float { .. } => {
            click(window, Role::Slider, &decl.label);
            type_over(window, &text);
            key(window, Modifiers::NONE, Key::Enter);
        }
        _ => {
            click(window, Role::Button, &format!("Menu of {}", decl.label));
            click(window, Role::Button, "Edit as text");
            let one_line = matches!(decl.kind, PropertyKind::File { .. });
            let role = if one_line { Role::TextInput } else { Role::MultilineTextInput };
            click(window, role, &format!("{} as text", decl.label));
            type_over(window, &text);
            click(window, Role::Button, "Set");
        }
    }
    let value = window.state().session.network().value(id, property);
    assert_eq!(value.as_ref(), decl.parse(json).ok().as_ref(), "{id}.{property}");
}

#[test]
fn built_by_hand_it_is_the_same_picture() {
    let text = std::fs::read_to_string(root().join("networks/brain.json")).expect("the network");
    let file: Json = serde_json::from_str(&text).expect("JSON");
    let list = |field: &str| file[field].as_array().cloned().expect("a list");
    let mut window = studio(Options::default());
    window.run_steps(4);
    zoom_out(&mut window);
    for (processor, place) in list("processors").iter().zip(PLACES) {
        let type_id = processor["type"].as_str().expect("a type");
        let at = on_canvas(&window, place);
        // A click brings the keyboard back to the canvas.
        window.drag_at(at);
        window.run_steps(1);
        window.drop_at(at);
        window.run_steps(2);
        add(&mut window, &type_id.replace('_', " "), at);
        let id = window.state().session.selection.first().cloned().expect("the new processor");
        assert_eq!(window.state().session.network().processor(&id).map(|p| p.type_id()), Some(type_id));
        let mut properties: Vec<_> = processor["properties"].as_object().into_iter().flatten().collect();
        // What no snippet reads is folded away, so snippets are chosen first.
        properties.sort_by_key(|(property, _)| *property != "shading");
        for (property, json) in properties {
            // The path is typed as the user sees it, not relative to a file that is not there yet.
            let typed = match property.as_str() {
                "file" => root().join("networks").join(json.as_str().expect("a path")).to_string_lossy().into(),
                _ => json.clone(),
            };
            set(&mut window, &id, property, &typed);
        }
    }
    window.run_steps(20);
    for connection in list("connections") {
        let mut text = connection.as_str().expect("a connection").to_owned();
        for processor in list("processors") {
            let [id, type_id] = ["id", "type"].map(|field| processor[field].as_str().expect("a text"));
            text = format!(" {text}").replace(&format!(" {id}."), &format!(" {type_id}.")).trim().to_owned();
        }
        wire(&mut window, &text);
        assert_eq!(window.state().session.network().connections().last().map(ToString::to_string), Some(text));
    }
    wait_until(&mut window, |studio| {
        let engine = &studio.session.engine;
        engine.results.canvases.contains_key("canvas") && !engine.is_busy()
    });
    keep_picture(&mut window, "flagship");

    let session = &window.state().session;
    let image = &session.engine.results.canvases["canvas"];
    let [width, height] = image.size();
    let pixels = session.display.gpu().read_rgba_f32(&image.color).expect("pixels");
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("brain.npy");
    let size = format!("{width}x{height}");
    rayloom(["render", "networks/brain.json", "-o", picture.to_str().expect("a path"), "--size", &size]).output();
    let bytes = std::fs::read(picture).expect("a picture");
    let rendered: Vec<f32> = npyz::NpyFile::new(&bytes[..]).expect("an array").into_vec().expect("numbers");
    let differing = pixels.as_flattened().iter().zip(&rendered).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    assert_eq!(pixels.len() * 4, rendered.len());
    assert_eq!(differing, 0, "numbers that differ, of {}", rendered.len());
}
