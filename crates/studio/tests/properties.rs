//! The property panel as a user meets it.

mod window;

use egui::accesskit::Role;
use egui::{Key, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::Value;
use rayloom_studio::Studio;

/// The flagship network with a processor selected.
fn selected(id: &str) -> Harness<'static, Studio> {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.selection = [id.to_owned()].into();
    harness.run_steps(3);
    harness
}

fn value(harness: &Harness<'_, Studio>, property: &str) -> Option<Value> {
    let session = &harness.state().session;
    let id = session.selection.first()?;
    session.network().value(id, property)
}

/// Brings something into sight and clicks it.
fn click(harness: &mut Harness<'_, Studio>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).scroll_to_me();
    // Scrolling takes a moment.
    harness.run_steps(30);
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(3);
}

/// Clicks a number and types another in its place.
fn type_number(harness: &mut Harness<'_, Studio>, label: &str, text: &str) {
    click(harness, Role::Slider, label);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
}

#[test]
fn a_number_is_typed_bad_input_keeps_it_and_reset_puts_it_back() {
    let mut harness = selected("traversal");
    type_number(&mut harness, "Sampling rate", "2.5");
    assert_eq!(value(&harness, "sampling_rate"), Some(Value::Float(2.5)));
    for (bad, why) in [("fast", "`fast` is not a number"), ("1e9", "above the largest value")] {
        type_number(&mut harness, "Sampling rate", bad);
        assert_eq!(value(&harness, "sampling_rate"), Some(Value::Float(2.5)));
        assert!(harness.query_by_label_contains(why).is_some(), "{why}");
    }
    type_number(&mut harness, "Sampling rate", "3");
    assert!(harness.query_by_label_contains("above the largest value").is_none());
    harness.get_by_label("Reset Sampling rate").click();
    harness.run_steps(3);
    assert_eq!(value(&harness, "sampling_rate"), Some(Value::Float(1.0)));
    assert!(harness.query_by_label("Reset Sampling rate").is_none());
    // Every typed number is a step of its own.
    let document = &mut harness.state_mut().session.document;
    assert!(document.undo() && document.undo());
    assert_eq!(value(&harness, "sampling_rate"), Some(Value::Float(2.5)));
}

#[test]
fn another_snippet_brings_its_own_parameters() {
    let mut harness = selected("traversal");
    assert!(harness.query_by_role_and_label(Role::Slider, "Ambient").is_some());
    click(&mut harness, Role::ComboBox, "Shading");
    window::keep_picture(&mut harness, "properties_choice");
    harness.get_by_label("None").click();
    harness.run_steps(3);
    assert_eq!(value(&harness, "shading"), Some(Value::Text("none".into())));
    assert!(harness.query_by_role_and_label(Role::Slider, "Ambient").is_none());
}

#[test]
fn dragging_a_knot_is_one_step() {
    let mut harness = selected("traversal");
    let before = harness.state().session.document.text();
    let knot = harness.get_by_label("Knot 2 of Transfer function").rect().center();
    harness.drag_at(knot);
    harness.run_steps(2);
    for step in 1..=5 {
        harness.hover_at(knot + Vec2::new(4.0, 3.0) * step as f32);
        harness.step();
    }
    harness.drop_at(knot + Vec2::new(20.0, 15.0));
    harness.run_steps(3);
    let Some(Value::TransferFunction(function)) = value(&harness, "transfer_function") else { panic!("no function") };
    assert!(function.knots[1].at > 70.0 && function.knots[1].opacity < 0.35, "{function:?}");
    assert!(harness.state_mut().session.document.undo());
    assert_eq!(harness.state().session.document.text(), before);
}

#[test]
fn a_click_adds_a_knot_and_the_right_button_removes_it() {
    let mut harness = selected("traversal");
    let count = |harness: &Harness<'_, Studio>| match value(harness, "transfer_function") {
        Some(Value::TransferFunction(function)) => function.knots.len(),
        _ => 0,
    };
    let plot = harness.get_by_label("Plot of Transfer function").rect();
    let place = Pos2::new(plot.left() + 0.9 * plot.width(), plot.center().y);
    harness.drag_at(place);
    harness.drop_at(place);
    harness.run_steps(3);
    assert_eq!(count(&harness), 5);
    harness.get_by_label("Knot 5 of Transfer function").click_secondary();
    harness.run_steps(3);
    assert_eq!(count(&harness), 4);
}

#[test]
fn looks() {
    for id in ["traversal", "view", "background", "source"] {
        let mut harness = selected(id);
        window::wait_for(&mut harness, "ready, took");
        std::thread::sleep(std::time::Duration::from_millis(500));
        harness.run_steps(10);
        window::keep_picture(&mut harness, &format!("properties_{id}"));
    }
}
