//! Ctrl and a click on a picture show the ray of that pixel, live, and mark its values in the transfer function.

mod window;

use egui::{Event, Modifiers, PointerButton, Pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::{EditError, Network};
use rayloom_processors::Trace;
use rayloom_studio::{Mark, Pane, Studio};
use serde_json::json;

fn trace(studio: &Studio) -> Option<&Trace> {
    studio.session.engine.results.trace.as_deref()?.as_ref().ok()
}

fn ctrl_click(harness: &mut Harness<'_, Studio>, pos: Pos2) {
    harness.hover_at(pos);
    harness.step();
    for pressed in [true, false] {
        let event =
            Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::COMMAND };
        harness.event_modifiers(event, Modifiers::COMMAND);
        harness.step();
    }
}

#[test]
fn a_clicked_pixel_shows_its_ray_live() {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.selection = ["traversal".to_owned()].into();
    window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    let canvas = harness.get_by_label("canvas canvas").rect();
    ctrl_click(&mut harness, canvas.center());
    window::wait_for(&mut harness, "Plot of value");
    let [x, y] = harness.state().session.probe.ray.as_ref().expect("a ray").at;
    // Counted from the middle.
    assert!(x.abs() < 0.01 && y.abs() < 0.01, "{x} {y}");
    let samples = trace(harness.state()).expect("a ray").samples.len();
    assert!(samples > 20, "{samples}");

    // The number under the pointer, and its place in the transfer function.
    assert_eq!(harness.state().session.probe.marker("traversal"), None);
    let plot = harness.get_by_label("Plot of value").rect();
    harness.hover_at(plot.center());
    window::wait_for(&mut harness, "classified");
    harness.step();
    let marker = harness.state().session.probe.marker("traversal").expect("a marked value");
    assert!(trace(harness.state()).expect("a ray").samples.iter().any(|sample| {
        let mark = Mark { value: sample.value, gradient: sample.gradient };
        mark == marker && mark.gradient.is_some()
    }));
    window::keep_picture(&mut harness, "ray-probe");

    // Edits show at once.
    let count = trace(harness.state()).expect("a ray").count;
    let halve = |network: &mut Network| -> Result<(), EditError> {
        network.set_from_json("traversal", "sampling_rate", &json!(0.5)).map(|_| ())
    };
    assert!(harness.state_mut().session.edit("set", halve));
    window::wait_until(&mut harness, |studio| trace(studio).is_some_and(|trace| 2 * trace.count < count + 3));
}

#[test]
fn a_pinned_picture_can_be_probed_and_what_is_no_picture_of_rays_cannot() {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.to_open.push(Pane::Inspector(("traversal", "image").into()));
    window::wait_for(&mut harness, "Point at a pixel");
    let hint = harness.get_by_label_contains("Point at a pixel").rect();
    ctrl_click(&mut harness, hint.left_top() + egui::vec2(150.0, -100.0));
    window::wait_until(&mut harness, |studio| trace(studio).is_some());
    assert_eq!(
        harness.state().session.probe.mark_in("traversal.image").map(|at| at.map(f32::is_finite)),
        Some([true; 2])
    );
    assert!(!harness.state_mut().session.probe("view", "view.entry", [0.5; 2]));
}
