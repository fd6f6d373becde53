//! The tutorial (docs/TUTORIAL.md), step by step as its reader does it, and its pictures: `cargo xtask tutorial` renews them.

use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use rayloom_network::Value;
use rayloom_studio::{Chooser, Folders, Mode, Options};

use crate::flagship::{click, type_over};
use crate::program::{rayloom_with_snippets, root};
use crate::window::nodes::{Window, add, drag, drag_and_drop, key, on_canvas, socket, wire, zoom_out};
use crate::window::{alone_with_snippets, studio, wait_for, wait_until, wait_while};

/// Set to renew the pictures.
const UPDATE: &str = "RAYLOOM_UPDATE_TUTORIAL";
/// Of the pictures, 1 to 100.
const QUALITY: u8 = 82;

/// The processors in the order of the tutorial: what is typed to find them, and where they are put.
const PROCESSORS: [(&str, (f32, f32)); 6] = [
    ("volume source", (0.10, 0.55)),
    ("cube proxy", (0.27, 0.18)),
    ("entry", (0.45, 0.18)),
    ("ray tra", (0.56, 0.55)),
    ("background", (0.74, 0.55)),
    ("canvas", (0.89, 0.55)),
];

const WIRES: [&str; 7] = [
    "volume_source.volume -> cube_proxy.volume",
    "cube_proxy.geometry -> entry_exit_points.geometry",
    "volume_source.volume -> ray_traversal.volume",
    "entry_exit_points.entry -> ray_traversal.entry",
    "entry_exit_points.exit -> ray_traversal.exit",
    "ray_traversal.image -> background.front",
    "background.image -> canvas.image",
];

/// Frames until nothing is to be computed or to be animated.
fn settle(window: &mut Window) {
    for _ in 0..2 {
        wait_until(window, |studio| !studio.session.engine.is_busy());
        window.run_steps(20);
    }
}

/// Keeps what is on the window for the tutorial.
fn picture(window: &mut Window, name: &str) {
    if std::env::var_os(UPDATE).is_none() {
        return;
    }
    settle(window);
    // They name folders of this run.
    window.state_mut().session.messages.clear();
    window.step();
    let picture = window.render().expect("a picture");
    let folder = root().join("docs/images/tutorial");
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut encoder = jpeg_encoder::Encoder::new_file(folder.join(format!("{name}.jpg")), QUALITY).expect("a file");
    encoder.set_progressive(true);
    encoder.set_optimized_huffman_tables(true);
    let [width, height] = [picture.width(), picture.height()].map(|side| u16::try_from(side).expect("a small side"));
    encoder.encode(picture.as_raw(), width, height, jpeg_encoder::ColorType::Rgba).expect("written");
}

/// Takes the pointer out of the window.
fn rest_pointer(window: &mut Window) {
    window.remove_cursor();
    window.run_steps(6);
}

fn select(window: &mut Window, id: &str) {
    let at = window.get_by_label_contains(&format!("processor {id} (")).rect().left_top() + Vec2::new(20.0, 10.0);
    press(window, at, Modifiers::NONE);
    assert!(window.state().session.selection.contains(id), "{id} is not selected");
}

fn press(window: &mut Window, pos: Pos2, modifiers: Modifiers) {
    window.hover_at(pos);
    window.run_steps(2);
    for pressed in [true, false] {
        window.event_modifiers(
            Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers },
            modifiers,
        );
        window.run_steps(1);
    }
    window.run_steps(4);
}

/// From the welcome page to an empty canvas.
fn empty_canvas(home: &Path, saved: PathBuf) -> Window {
    let chooser = Chooser::new(move |question| {
        let volume = root().join("data/ch2better.nii.gz");
        let chosen = if question.save_as.is_some() { saved.clone() } else { volume };
        Box::pin(std::future::ready(Some(chosen)))
    });
    let folders = Some(Folders::within(home));
    let mut window = studio(Options { chooser, folders, welcome: true, ..Options::default() });
    wait_for(&mut window, "New network");
    window.get_by_label("New network").click();
    wait_for(&mut window, "The network is empty");
    rest_pointer(&mut window);
    picture(&mut window, "empty");
    window
}

/// Adds the processors, chooses the file, and looks at it.
fn processors(window: &mut Window) {
    zoom_out(window);
    let (first, place) = PROCESSORS[0];
    let at = on_canvas(window, place);
    window.hover_at(at);
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Space);
    window.event(Event::Text(first.to_owned()));
    window.run_steps(3);
    picture(window, "palette");
    key(window, Modifiers::NONE, Key::Enter);
    window.run_steps(4);
    // The menu is called so, too.
    window.get_all_by_role_and_label(Role::Button, "File").last().expect("the property").click();
    wait_until(
        window,
        |studio| matches!(studio.session.network().value("volume_source", "file"), Some(Value::Text(file)) if !file.is_empty()),
    );
    // A pointer that moves right after a click does not rest, as the library sees it.
    window.run_steps(12);
    let output = window.get_by_label("output volume_source.volume").rect().center();
    window.hover_at(output);
    wait_for(window, "on the device");
    window.run_steps(10);
    picture(window, "source");
    for (search, place) in &PROCESSORS[1..] {
        let at = on_canvas(window, *place);
        press(window, at, Modifiers::NONE);
        add(window, search, at);
    }
    window.run_steps(10);
}

/// Connects them, and looks at the first picture.
fn wires(window: &mut Window) {
    for text in &WIRES[..2] {
        wire(window, text);
    }
    let [from, to] = ["output volume_source.volume", "input ray_traversal.volume"].map(|label| socket(window, label));
    drag(window, from, to);
    picture(window, "wiring");
    window.drop_at(to);
    window.run_steps(4);
    for text in &WIRES[3..] {
        wire(window, text);
    }
    let network = window.state().session.network();
    assert_eq!(network.connections().iter().map(ToString::to_string).collect::<Vec<_>>(), WIRES);
    wait_until(window, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    settle(window);
    let middle = window.get_by_label("canvas canvas").rect().center();
    window.hover_at(middle);
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::A);
    drag_and_drop(window, middle, middle + Vec2::new(150.0, 60.0));
    window.hover_at(middle);
    for _ in 0..3 {
        let (unit, phase) = (egui::MouseWheelUnit::Line, egui::TouchPhase::Move);
        window.event(Event::MouseWheel { unit, delta: Vec2::new(0.0, 1.0), phase, modifiers: Modifiers::NONE });
        window.run_steps(10);
    }
    for label in ["Arrange", "Show all"] {
        window.get_by_label(label).click();
        window.run_steps(30);
    }
    rest_pointer(window);
    picture(window, "network");
}

/// Colours and opacities.
fn transfer_function(window: &mut Window) {
    select(window, "ray_traversal");
    click(window, Role::Button, "Presets");
    window.get_by_label("Soft tissue").click();
    window.run_steps(4);
    let knots = |window: &Window| match window.state().session.network().value("ray_traversal", "transfer_function") {
        Some(Value::TransferFunction(function)) => function.knots.iter().map(|knot| knot.at).collect::<Vec<_>>(),
        _ => Vec::new(),
    };
    let before = knots(window);
    let strip = window.get_by_label("Plot of Transfer function").rect().center_bottom() + Vec2::new(-60.0, 21.0);
    drag_and_drop(window, strip, strip + Vec2::new(110.0, -60.0));
    let after = knots(window);
    assert!(after[0] > before[0] && after[3] - after[0] > 1.5 * (before[3] - before[0]), "{before:?} {after:?}");
    settle(window);
    let knot = window.get_by_label("Knot 2 of Transfer function").rect().center();
    press(window, knot, Modifiers::NONE);
    picture(window, "transfer_function");
}

/// Rests on a wire; chooses another shading.
fn hover_and_swap(window: &mut Window) {
    let [from, to] = ["output entry_exit_points.entry", "input ray_traversal.entry"]
        .map(|label| window.get_by_label(label).rect().center());
    window.hover_at(from.lerp(to, 0.5));
    wait_for(window, "entry_exit_points.entry");
    window.run_steps(20);
    wait_while(window, "counting");
    picture(window, "hover");
    rest_pointer(window);
    click(window, Role::ComboBox, "Shading");
    let choice = window.get_by_role_and_label(Role::Button, "Blinn-Phong").rect().center();
    window.hover_at(choice);
    window.run_steps(4);
    picture(window, "snippets");
    window.get_by_role_and_label(Role::Button, "Blinn-Phong").click();
    window.run_steps(4);
    settle(window);
    assert!(window.state().session.engine.results.report.is_complete());
}

/// The snippet of the tutorial, taken from its page.
fn snippet() -> String {
    let page = std::fs::read_to_string(root().join("docs/TUTORIAL.md")).expect("the tutorial");
    let begun = page.split("```wgsl\n").nth(1).expect("a snippet");
    let text = begun.split("```").next().expect("its end").trim_end().to_owned();
    assert_eq!(text.lines().count(), 10, "the tutorial promises ten lines");
    text
}

/// Writes a snippet of one's own, breaks and mends it, and keeps it.
fn own_snippet(window: &mut Window, folder: &Path) {
    click(window, Role::Button, "Shading text");
    wait_for(window, "Live");
    window.get_by_role_and_label(Role::Button, "Live").click();
    window.run_steps(3);
    let text = snippet();
    let type_in = |window: &mut Window, text: &str| {
        window.get_by_role_and_label(Role::MultilineTextInput, "Shading text").focus();
        window.run_steps(2);
        type_over(window, text);
    };
    let failed = |studio: &rayloom_studio::Studio| !studio.session.engine.results.report.failed.is_empty();
    type_in(window, &text.replace("surface.view", "surface.eye"));
    wait_until(window, failed);
    wait_for(window, "edited/shading.wgsl:7:");
    type_in(window, &text);
    wait_until(window, |studio| !failed(studio) && !studio.session.engine.is_busy());
    wait_for(window, "in use in this processor");
    window.get_by_role_and_label(Role::Button, "Assembled").click();
    rest_pointer(window);
    picture(window, "own_snippet");
    window.get_by_role_and_label(Role::Button, "Save as...").click();
    window.run_steps(3);
    window.get_by_label("Name of the snippet").focus();
    window.run_steps(2);
    type_over(window, "rim");
    key(window, Modifiers::NONE, Key::Enter);
    wait_until(window, |studio| {
        let chosen = studio.session.network().value("ray_traversal", "shading");
        matches!(chosen, Some(Value::Text(id)) if id == "rim")
    });
    assert_eq!(std::fs::read_to_string(folder.join("rim.wgsl")).expect("the snippet"), text);
    window.get_by_role_and_label(Role::Button, "Close").click();
    settle(window);
}

/// Follows the ray of a pixel.
fn ray_probe(window: &mut Window) {
    let at = window.get_by_label("canvas canvas").rect().center() + Vec2::new(-20.0, 20.0);
    press(window, at, Modifiers::COMMAND);
    wait_for(window, "Plot of value");
    window.run_steps(5);
    let plot = window.get_by_label("Plot of value").rect();
    window.hover_at(plot.lerp_inside(Vec2::new(0.8, 0.5)));
    wait_for(window, "classified");
    picture(window, "ray_probe");
}

/// Chooses what users see.
fn application(window: &mut Window) {
    window.get_all_by_role_and_label(Role::Button, "Close").last().expect("the probe's").click();
    window.run_steps(4);
    for label in ["Shading", "Edge", "Sampling rate"] {
        let menu = format!("Menu of {label}");
        click(window, Role::Button, &menu);
        window.get_by_label("Show in the application").click();
        window.run_steps(4);
    }
    click(window, Role::Slider, "Edge");
    type_over(window, "4");
    key(window, Modifiers::NONE, Key::Enter);
    settle(window);
    window.get_by_label("View").click();
    window.run_steps(4);
    window.get_by_label("Show application").click();
    window.run_steps(4);
    let name = |window: &mut Window, field: &str, text: &str| {
        window.get_by_label(field).click();
        window.run_steps(3);
        type_over(window, text);
        key(window, Modifiers::NONE, Key::Enter);
    };
    name(window, "Title of the application", "My brain");
    name(window, "Title of group 1", "Look");
    name(window, "Label of ray_traversal.sampling_rate", "Quality");
    name(window, "Name of a new preset", "Thin rim");
    rest_pointer(window);
    picture(window, "application");
}

/// Saves, and opens as users do; and runs from the command line.
fn visualization(mut window: Window, file: &Path, snippets: &Path) {
    key(&mut window, Modifiers::COMMAND, Key::S);
    wait_until(&mut window, |studio| !studio.session.document.is_modified());
    key(&mut window, Modifiers::NONE, Key::F5);
    assert_eq!(window.state().session.mode, Mode::Visualization);
    wait_for(&mut window, "Quality");
    rest_pointer(&mut window);
    picture(&mut window, "visualization");
    drop(window);
    let picture = file.with_extension("png");
    let [file, picture] = [file, &picture].map(|path| path.to_str().expect("a path"));
    rayloom_with_snippets(snippets, ["check", file]).output();
    let edge = "ray_traversal.shading.edge=4";
    rayloom_with_snippets(snippets, ["render", file, "-o", picture, "--size", "64x64", "--set", edge]).output();
}

#[test]
fn every_step_does_what_the_page_says() {
    let Some(snippets) = alone_with_snippets("tutorial::every_step_does_what_the_page_says") else { return };
    let home = tempfile::tempdir().expect("a folder");
    let file = home.path().join("my_brain.json");
    let mut window = empty_canvas(home.path(), file.clone());
    processors(&mut window);
    wires(&mut window);
    transfer_function(&mut window);
    hover_and_swap(&mut window);
    own_snippet(&mut window, &snippets);
    ray_probe(&mut window);
    application(&mut window);
    visualization(window, &file, &snippets);
}
