//! The picture is compared with what it should be, in the window.

mod window;

use egui::{PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_studio::{Pane, Studio};

/// Marks a part of the picture, 12 x 8 points right of and below its middle.
fn mark(harness: &mut Harness<'_, Studio>) {
    let from = harness.get_by_label("compared picture").rect().center();
    for (to, pressed) in [(Vec2::ZERO, true), (Vec2::new(9.0, 6.0), true), (Vec2::new(12.0, 8.0), true)] {
        drag(harness, from + to, (to == Vec2::ZERO).then_some(pressed));
    }
    drag(harness, from + Vec2::new(12.0, 8.0), Some(false));
}

fn drag(harness: &mut Harness<'_, Studio>, pos: Pos2, pressed: Option<bool>) {
    harness.event(egui::Event::PointerMoved(pos));
    if let Some(pressed) = pressed {
        let (button, modifiers) = (PointerButton::Primary, egui::Modifiers::NONE);
        harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
    }
    harness.step();
}

#[test]
fn a_marked_part_is_compared_with_either_reference() {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.to_open.push(Pane::Accuracy);
    window::wait_for(&mut harness, "compared picture");
    window::wait_until(&mut harness, |studio| !studio.session.engine.is_busy());
    harness.get_by_label("Same samples").click();
    harness.step();
    mark(&mut harness);
    window::wait_for(&mut harness, "pixels at");
    assert!(harness.query_by_label("visible0.00 %").is_some(), "the device computes what the samples say");
    harness.get_by_label("Exact").click();
    harness.step();
    mark(&mut harness);
    window::wait_while(&mut harness, "visible0.00 %");
    window::keep_picture(&mut harness, "accuracy");
    harness.get_by_label("Everything").click();
    harness.step();
    harness.step();
    harness.get_by_label("Cancel").click();
    window::wait_for(&mut harness, "Everything");
}
