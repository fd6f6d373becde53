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

#[test]
fn the_error_is_estimated_once_the_picture_stands_still() {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.estimating = true;
    window::wait_for(&mut harness, "error about");
    let outport = "traversal.image".parse().expect("an address");
    let context = harness.ctx.clone();
    let judged = harness.state_mut().session.judgement(&context, &outport).expect("judged").expect("without failure");
    // `rayloom measure` finds an error of 0.009 root mean square for this network as saved.
    assert!((0.0045..0.018).contains(&judged.estimate.rmse), "{judged:?}");
    assert!((0.0..1.0).contains(&judged.contributing), "{judged:?}");
    harness.get_by_label_contains("error about").click();
    harness.step();
    window::wait_for(&mut harness, "Estimated error");
    harness.get_by_label("Map of samples").click();
    harness.step();
    window::wait_for(&mut harness, "traversal.samples");
    window::keep_picture(&mut harness, "estimate");
}
