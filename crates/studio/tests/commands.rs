//! Every command is within reach of the keyboard.

mod window;

use egui::{Event, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_studio::{Chooser, Mode, Options, Studio};

fn press(window: &mut Harness<'_, Studio>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

/// Runs a command by its name, with the keyboard alone.
fn command(window: &mut Harness<'_, Studio>, name: &str) {
    press(window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text(name.into()));
    window.run_steps(2);
    press(window, Modifiers::NONE, Key::Enter);
}

#[test]
fn the_palette_runs_commands_and_keys_do_too() {
    let mut window = window::studio(window::flagship());
    window.run_steps(3);
    let processors = |window: &Harness<'_, Studio>| window.state().session.network().processors().count();
    let before = processors(&window);

    command(&mut window, "select all");
    assert_eq!(window.state().session.selection.len(), before);
    command(&mut window, "no such words");
    assert_eq!(processors(&window), before, "no such words in any command: nothing happens");
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(processors(&window), 0);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(processors(&window), before);

    press(&mut window, Modifiers::COMMAND, Key::Plus);
    assert!((window.ctx.zoom_factor() - 1.1).abs() < 1e-6);
    command(&mut window, "normal size");
    assert!((window.ctx.zoom_factor() - 1.0).abs() < 1e-6);
    command(&mut window, "light theme");
    assert_eq!(window.ctx.theme(), egui::Theme::Light);
    command(&mut window, "visualization mode");
    assert_eq!(window.state().session.mode, Mode::Visualization);
    press(&mut window, Modifiers::NONE, Key::F5);
    assert_eq!(window.state().session.mode, Mode::Development);
}

#[test]
fn one_key_lists_all_keys() {
    let mut window = window::studio(window::flagship());
    window.run_steps(3);
    assert!(window.query_by_label("Delete and reconnect").is_none());
    press(&mut window, Modifiers::NONE, Key::F1);
    for line in ["Delete and reconnect", "cut a wire", "roll"] {
        assert!(window.query_by_label(line).is_some(), "{line} is not listed");
    }
    window::keep_picture(&mut window, "keys");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Delete and reconnect").is_none());
    press(&mut window, Modifiers::COMMAND, Key::P);
    window::keep_picture(&mut window, "palette");
}

#[test]
fn canvases_and_the_network_are_written_as_pictures() {
    let folder = std::env::temp_dir().join(format!("rayloom-pictures-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let files = folder.clone();
    let chooser = Chooser::new(move |question| {
        let file = question.save_as.map(|name| files.join(name));
        Box::pin(std::future::ready(file))
    });
    let mut window = window::studio(Options { chooser, ..window::flagship() });
    window.run_steps(3);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window::keep_picture(&mut window, "picture_dialog");
    press(&mut window, Modifiers::NONE, Key::Enter);
    window::wait_for(&mut window, "canvas.png");
    let picture = rayloom_processors::read_picture(&folder.join("canvas.png")).expect("a picture");
    let shown = window.state().session.shown["canvas"];
    assert_eq!(picture.size, shown, "the size that the canvas has in the window");
    assert!(picture.pixels.iter().any(|pixel| pixel[3] > 0.5));

    command(&mut window, "picture of the network");
    window::wait_for(&mut window, "network.svg");
    let drawing = std::fs::read_to_string(folder.join("network.svg")).expect("a drawing");
    let session = &window.state().session;
    for processor in session.network().processors() {
        assert!(drawing.contains(&format!(">{}<", processor.id())), "{} is missing", processor.id());
    }
    assert_eq!(drawing.matches("<polyline").count(), session.network().connections().len());
    std::fs::copy(folder.join("network.svg"), concat!(env!("CARGO_TARGET_TMPDIR"), "/studio/network.svg"))
        .expect("kept");
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn keys_do_nothing_behind_a_dialog() {
    let mut window = window::studio(window::flagship());
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    assert!(window.query_by_label("Picture of a canvas").is_some());
    window.key_press_modifiers(Modifiers::NONE, Key::F5);
    window.run_steps(3);
    assert_eq!(window.state().session.mode, rayloom_studio::Mode::Development);
}
