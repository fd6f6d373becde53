//! Visualization mode shows what the author exposed and nothing else.

mod window;

use egui_kittest::kittest::Queryable;
use rayloom_studio::{Application, Mode, Options};
use serde_json::json;

const APPLICATIONS: [&str; 3] = ["mri_viewer", "compositing_modes", "snippet_playground"];

fn opened(network: &str) -> Options {
    Options { network: Some(window::project(network)), mode: Some(Mode::Visualization), ..Options::default() }
}

#[test]
fn shipped_applications_fit_their_networks_and_are_drawn() {
    for name in APPLICATIONS {
        let mut harness = window::studio(opened(&format!("networks/apps/{name}.json")));
        let session = &harness.state().session;
        assert!(session.messages.is_empty(), "{name}: {:?}", session.messages);
        let (application, problems) = Application::of(session.network());
        assert_eq!(problems, Vec::<String>::new(), "{name}");
        assert!(!application.groups.is_empty() && !application.presets.is_empty(), "{name}");
        let title = application.groups[0].title.clone();
        let canvases = application.shown_canvases(session.network()).len();
        window::wait_for(&mut harness, &title);
        window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.len() == canvases);
        window::wait_until(&mut harness, |studio| !studio.session.engine.is_busy());
        let report = &harness.state().session.engine.results.report;
        assert!(report.is_complete(), "{name}: {:?} {:?}", report.failed, report.not_ready);
        window::keep_picture(&mut harness, name);
    }
}

#[test]
fn only_exposed_properties_are_shown_and_presets_set_them() {
    let mut harness = window::studio(opened("networks/brain.json"));
    let application = json!({
        "groups": [{"title": "Sampling", "properties": [
            {"property": "traversal.sampling_rate", "label": "Quality", "range": [0.5, 4.0]},
            {"property": "traversal.samplin_rate"}
        ]}],
        "presets": [{"name": "Coarse", "values": {"traversal.sampling_rate": 0.5}}]
    });
    let session = &mut harness.state_mut().session;
    assert!(session.edit("expose", |network| {
        network.visualization = application;
        Ok::<(), std::convert::Infallible>(())
    }));
    window::wait_for(&mut harness, "Quality");
    window::wait_for(&mut harness, "did you mean sampling_rate");
    for hidden in ["Network", "Messages", "Shading", "Camera", "File"] {
        assert!(harness.query_by_label(hidden).is_none(), "{hidden} is shown");
    }
    harness.get_by_label("Coarse").click();
    harness.run_steps(3);
    let rate = |harness: &egui_kittest::Harness<'_, rayloom_studio::Studio>| {
        harness.state().session.network().value("traversal", "sampling_rate").map(|value| value.to_json())
    };
    assert_eq!(rate(&harness), Some(json!(0.5)));
    assert!(harness.state_mut().session.document.undo(), "a preset is one step of the history");
    assert_ne!(rate(&harness), Some(json!(0.5)));
}

#[test]
fn one_key_switches_back_unless_the_file_is_locked() {
    for (locked, expected) in [(false, Mode::Development), (true, Mode::Visualization)] {
        let mut harness = window::studio(opened("networks/brain.json"));
        let session = &mut harness.state_mut().session;
        session.edit("lock", |network| {
            network.visualization = json!({"locked": locked});
            Ok::<(), std::convert::Infallible>(())
        });
        harness.step();
        harness.key_press(egui::Key::F5);
        harness.run_steps(2);
        assert_eq!(harness.state().session.mode, expected);
    }
}

#[test]
fn keys_and_double_clicks_move_the_camera_of_the_canvas_under_the_pointer() {
    use rayloom_network::{Projection, Value};
    let mut harness = window::studio(opened("networks/brain.json"));
    window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    let camera = |studio: &rayloom_studio::Studio| match studio.session.network().value("view", "camera") {
        Some(Value::Camera(camera)) => camera,
        other => panic!("no camera but {other:?}"),
    };
    let middle = harness.get_by_label("canvas canvas").rect().center();
    harness.hover_at(middle + egui::vec2(60.0, 40.0));
    harness.step();
    let before = camera(harness.state());
    harness.key_press(egui::Key::O);
    harness.run_steps(2);
    assert!(matches!(camera(harness.state()).projection, Projection::Orthographic { .. }));
    harness.state_mut().session.document.undo();
    assert_eq!(camera(harness.state()), before);
    for pressed in [true, false, true, false] {
        let pos = middle + egui::vec2(60.0, 40.0);
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        harness.step();
    }
    window::wait_until(&mut harness, |studio| camera(studio).focus != before.focus);
    let after = camera(harness.state());
    assert!((after.distance() - before.distance()).abs() < 1e-6, "centring neither turns nor approaches");
    assert_eq!(after.up, before.up);
}

#[test]
fn every_canvas_gets_a_picture_of_its_own_size_and_only_those_in_sight_are_rendered() {
    let sizes = [("canvas_axial", [120, 90]), ("canvas", [64, 80])];
    let mut harness = window::harness("networks/apps/mri_viewer.json", move |_, session| {
        session.shown = sizes.map(|(id, size)| (id.to_owned(), size)).into();
    });
    // The first pictures are coarse.
    window::wait_until(&mut harness, move |piece| {
        let canvases = &piece.studio.session.engine.results.canvases;
        sizes.iter().all(|(id, size)| canvases.get(*id).is_some_and(|picture| picture.size() == *size))
    });
    let results = &harness.state().studio.session.engine.results;
    assert!(!results.runs.contains_key("coronal"), "nobody sees the coronal slice");
}
