//! A mistake in a shader is told, the last good picture stays, and mending it makes a new one.

mod window;

use rayloom_network::{EditError, Network};
use rayloom_studio::{Folders, Options, Session, Studio};
use serde_json::json;

fn set(session: &mut Session, property: &'static str, value: &str) {
    let set = |network: &mut Network| -> Result<(), EditError> {
        network.set_from_json("traversal", property, &json!(value)).map(|_| ())
    };
    assert!(session.edit("set", set), "{:?}", session.messages);
}

fn failed(studio: &Studio) -> bool {
    studio.session.engine.results.report.failed.contains_key("traversal")
}

#[test]
fn a_broken_snippet_keeps_the_last_good_picture_until_it_is_mended() {
    let mut harness = window::studio(window::flagship());
    window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    set(
        &mut harness.state_mut().session,
        "shading.text",
        "//! slot: shading\nfn shade(medium: vec4f, surface: Surface) -> vec4f { return medum; }\n",
    );
    window::wait_until(&mut harness, failed);
    let results = &harness.state().session.engine.results;
    assert!(results.report.failed["traversal"].message.contains("edited/shading.wgsl:2:"));
    assert!(results.canvases.contains_key("canvas"), "the last good picture is gone");
    set(&mut harness.state_mut().session, "shading.text", "");
    window::wait_until(&mut harness, |studio| !failed(studio) && !studio.session.engine.is_busy());
    assert!(harness.state().session.engine.results.report.is_complete());
}

#[test]
fn a_lost_device_is_told_and_changes_stay_safe() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = Folders::within(home.path());
    let copies = folders.state.join("recovery");
    let mut harness = window::studio(Options { folders: Some(folders), ..window::flagship() });
    window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    let gpu = harness.state().session.display.gpu().clone();
    gpu.device.destroy();
    // A driver that loses its device says so at once; this one does when it is asked.
    let _ = gpu.wait("the loss");
    // Whatever is edited next finds no device.
    let rate = |network: &mut Network| network.set_from_json("traversal", "sampling_rate", &json!(1.75)).map(|_| ());
    assert!(harness.state_mut().session.edit("set", rate));
    window::wait_for(&mut harness, "Error: the graphics device was lost");
    let kept = || {
        let files = std::fs::read_dir(&copies).into_iter().flatten().flatten();
        files.filter_map(|file| std::fs::read_to_string(file.path()).ok()).any(|text| text.contains("1.75"))
    };
    window::wait_until(&mut harness, |_| kept());
    // The window goes on: edits, keys and the end of the program work as before.
    window::wait_until(&mut harness, |studio| !studio.session.engine.is_busy());
    let session = &harness.state().session;
    assert!(!session.engine.results.report.failed.is_empty(), "evaluated without a device");
    let told = session.messages.iter().filter(|message| message.text.contains("device was lost")).count();
    assert_eq!(told, 1, "{:?}", session.messages);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run_steps(3);
    assert!(!harness.state().session.document.is_modified());
}
