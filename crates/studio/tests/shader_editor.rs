//! Texts of snippets: edited live, broken, mended, kept as snippets of one's own.

mod window;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::Value;
use rayloom_studio::{Mode, Options, Pane, Studio};

type Window = Harness<'static, Studio>;

/// The flagship network with the text of its shading open.
fn opened() -> Window {
    let mut window = window::studio(window::flagship());
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    window.state_mut().session.to_open.push(Pane::Shader(("traversal", "shading.text").into()));
    window.run_steps(5);
    window
}

fn click(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::Button, label).click();
    window.run_steps(5);
}

/// Clicks what has to be scrolled to.
fn click_in_sight(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::Button, label).scroll_to_me();
    window.run_steps(30);
    click(window, label);
}

fn own_text(studio: &Studio) -> String {
    match studio.session.network().value("traversal", "shading.text") {
        Some(Value::Text(text)) => text,
        other => panic!("{other:?}"),
    }
}

/// Types behind the end of the text.
fn type_at_end(window: &mut Window, text: &str) {
    window.get_by_role_and_label(Role::MultilineTextInput, "Shading text").focus();
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::End);
    window.run_steps(2);
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(3);
}

fn failed(studio: &Studio) -> bool {
    studio.session.engine.results.report.failed.contains_key("traversal")
}

#[test]
fn a_live_text_is_broken_and_mended_while_the_picture_stays() {
    let mut window = opened();
    let before = own_text(window.state());
    window::keep_picture(&mut window, "shader-editor");
    click(&mut window, "Live");
    type_at_end(&mut window, "\nbroken");
    window::wait_until(&mut window, failed);
    window::wait_for(&mut window, "edited/shading.wgsl:");
    window.run_steps(3);
    window::keep_picture(&mut window, "shader-editor-broken");
    assert!(own_text(window.state()).ends_with("broken"));
    let results = &window.state().session.engine.results;
    assert!(results.canvases.contains_key("canvas"), "the last good picture is gone");
    assert!(results.shaders.contains_key("traversal"), "the last good shader is gone");

    // A click on the error moves the cursor there.
    window.get_by_role_and_label(Role::MultilineTextInput, "Shading text").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Home);
    window.run_steps(2);
    // The canvas says it too, after the processor's id.
    let listed = |label: &str| label.starts_with("edited/shading.wgsl:");
    window
        .get_by(|node| node.role() == Role::Label && node.value().or(node.label()).is_some_and(|label| listed(&label)))
        .click();
    window.run_steps(4);
    window.event(egui::Event::Text("still ".to_owned()));
    window::wait_until(&mut window, |studio| own_text(studio).ends_with("\nstill broken"));
    assert!(window.state_mut().session.document.undo());
    window.run_steps(3);

    // What is typed is undone like everything else.
    assert!(window.state_mut().session.document.undo());
    window::wait_until(&mut window, |studio| !failed(studio) && !studio.session.engine.is_busy());
    assert_eq!(own_text(window.state()), before);
    type_at_end(&mut window, "\n// fine");
    window::wait_until(&mut window, |studio| own_text(studio).ends_with("// fine") && !studio.session.engine.is_busy());
    assert!(window.state().session.engine.results.report.is_complete());
}

#[test]
fn a_text_among_exposed_properties_is_edited_without_the_network_in_sight() {
    let mut window = window::studio(Options {
        network: Some(window::project("networks/apps/snippet_playground.json")),
        mode: Some(Mode::Visualization),
        ..Options::default()
    });
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    type_at_end(&mut window, "\nbroken");
    assert_eq!(own_text(window.state()), "", "it is applied by the button");
    click_in_sight(&mut window, "Apply");
    window::wait_until(&mut window, failed);
    window::wait_for(&mut window, "edited/shading.wgsl:");
    window::keep_picture(&mut window, "playground-broken");
    assert!(window.state().session.engine.results.canvases.contains_key("canvas"), "the last good picture is gone");
    click_in_sight(&mut window, "Revert");
    window::wait_until(&mut window, |studio| !failed(studio) && !studio.session.engine.is_busy());
    assert_eq!(own_text(window.state()), "");
}

#[test]
fn a_text_is_kept_as_a_snippet_of_ones_own() {
    let Some(folder) = window::alone_with_snippets("a_text_is_kept_as_a_snippet_of_ones_own") else { return };
    let mut window = opened();
    type_at_end(&mut window, "\n// warm");
    click(&mut window, "Save as...");
    window.get_by_label("Name of the snippet").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(egui::Event::Text("warm".to_owned()));
    window.run_steps(2);
    click(&mut window, "Save");
    let chosen = |studio: &Studio| studio.session.network().value("traversal", "shading");
    window::wait_until(&mut window, |studio| matches!(chosen(studio), Some(Value::Text(id)) if id == "warm"));
    window::wait_until(&mut window, |studio| !studio.session.engine.is_busy());
    let session = &window.state().session;
    assert!(session.engine.results.report.is_complete(), "{:?}", session.engine.results.report.failed);
    assert!(session.engine.results.shaders["traversal"].assembled.text.contains("// warm"));
    assert!(std::fs::read_to_string(folder.join("warm.wgsl")).expect("a file").ends_with("// warm"));
}

#[test]
fn a_snippet_that_changes_on_the_disk_is_read_again() {
    let Some(folder) = window::alone_with_snippets("a_snippet_that_changes_on_the_disk_is_read_again") else { return };
    let write = |head: &str, factor: &str| {
        let text = format!(
            "//! slot: {head}\n//! label: Flat\n//! help: Evenly.\n//! param level: f32 = 0.5 [0, 1] -- how bright\n\n\
             fn shade(medium: vec4f, surface: Surface) -> vec4f {{\n    return medium * {factor};\n}}\n"
        );
        std::fs::write(folder.join("flat.wgsl"), text).expect("written");
    };
    let mut window = opened();
    // A file that comes while the program runs can be chosen.
    std::thread::sleep(std::time::Duration::from_millis(700));
    write("shading", "params.level");
    window::wait_for(&mut window, "your snippets changed and were read again");
    let choose = |network: &mut rayloom_network::Network| {
        network.set_from_json("traversal", "shading", &serde_json::json!("flat")).map(|_| ())
    };
    assert!(window.state_mut().session.edit("choose", choose));
    let shader = |studio: &Studio, text: &str| {
        let shader = studio.session.engine.results.shaders.get("traversal");
        !failed(studio) && shader.is_some_and(|shader| shader.assembled.text.contains(text))
    };
    window::wait_until(&mut window, |studio| shader(studio, "level;"));
    let error = |studio: &Studio| {
        studio.session.engine.results.report.failed.get("traversal").map(ToString::to_string).unwrap_or_default()
    };
    // Broken in its text, then in its head: the message names the place, the picture and the text stay.
    write("shading", "params.lvl");
    window::wait_until(&mut window, |studio| error(studio).contains("user/flat.wgsl:7:"));
    write("shadow", "0.25");
    window::wait_until(&mut window, |studio| error(studio).contains("user/flat.wgsl:1:"));
    window.run_steps(3);
    let results = &window.state().session.engine.results;
    assert!(results.canvases.contains_key("canvas") && results.shaders.contains_key("traversal"));
    assert!(window.query_all_by_label_contains("user/flat.wgsl:1:").next().is_some(), "it is not told");
    // Mended.
    write("shading", "0.25");
    window::wait_until(&mut window, |studio| shader(studio, "medium * 0.25"));
}
