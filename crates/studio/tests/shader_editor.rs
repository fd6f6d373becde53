//! Texts of snippets: edited live, broken, mended, kept as snippets of one's own.

mod window;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::Value;
use rayloom_studio::{Pane, Studio};

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

    // What is typed is undone like everything else.
    assert!(window.state_mut().session.document.undo());
    window::wait_until(&mut window, |studio| !failed(studio) && !studio.session.engine.is_busy());
    assert_eq!(own_text(window.state()), before);
    type_at_end(&mut window, "\n// fine");
    window::wait_until(&mut window, |studio| own_text(studio).ends_with("// fine") && !studio.session.engine.is_busy());
    assert!(window.state().session.engine.results.report.is_complete());
}

/// The folder of the user's snippets is named by the environment, so this test runs itself with one.
#[test]
fn a_text_is_kept_as_a_snippet_of_ones_own() {
    const FOLDER: &str = "RAYLOOM_SNIPPETS";
    const INSIDE: &str = "RAYLOOM_SNIPPETS_OF_TEST";
    if std::env::var_os(INSIDE).is_none() {
        let folder = std::env::temp_dir().join(format!("rayloom-snippets-{}", std::process::id()));
        let program = std::env::current_exe().expect("a program");
        let status = std::process::Command::new(program)
            .args(["a_text_is_kept_as_a_snippet_of_ones_own", "--exact"])
            .envs([(FOLDER, folder.as_os_str()), (INSIDE, "1".as_ref())])
            .status();
        let kept = std::fs::read_to_string(folder.join("warm.wgsl"));
        std::fs::remove_dir_all(&folder).expect("a folder");
        assert!(status.expect("it runs").success());
        assert!(kept.expect("a file").ends_with("// warm"));
        return;
    }
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
}
