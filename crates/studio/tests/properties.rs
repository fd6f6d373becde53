//! The property panel as a user meets it.

mod window;

use egui::accesskit::Role;
use egui::{Key, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
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
    assert!(harness.state().session.interacting);
    harness.drop_at(knot + Vec2::new(20.0, 15.0));
    harness.run_steps(3);
    assert!(!harness.state().session.interacting);
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
    click(&mut harness, Role::Button, "Split");
    let Some(Value::TransferFunction(function)) = value(&harness, "transfer_function") else { panic!("no function") };
    assert!(function.knots[3].right.is_some() && function.check().is_ok());
    harness.get_by_label("Knot 4 of Transfer function").click_secondary();
    harness.run_steps(3);
    assert_eq!(count(&harness), 4);
}

/// Sets a property of the selected processor.
fn set(harness: &mut Harness<'_, Studio>, property: &str, value: &str) {
    let json: serde_json::Value = serde_json::from_str(value).expect("JSON");
    let session = &mut harness.state_mut().session;
    let id = session.selection.first().cloned().expect("a selection");
    let set = |network: &mut rayloom_network::Network| network.set_from_json(&id, property, &json).map(|_| ());
    assert!(session.edit("set", set));
    harness.run_steps(3);
}

#[test]
fn every_editor_of_a_traversal_works_on_the_real_volume() {
    let mut harness = selected("traversal");
    window::wait_for(&mut harness, "ready, took");
    set(&mut harness, "classification", "\"transfer_function_2d\"");
    // Shapes can be added once the gradients are known.
    let start = std::time::Instant::now();
    while harness.get_by_role_and_label(Role::Button, "Add a shape").accesskit_node().is_disabled() {
        assert!(start.elapsed().as_secs() < 60, "the gradients are not counted");
        std::thread::sleep(std::time::Duration::from_millis(50));
        harness.step();
    }
    click(&mut harness, Role::Button, "Add a shape");
    harness.get_by_label("Triangle").click();
    harness.run_steps(3);
    let Some(Value::TransferFunction2D(function)) = value(&harness, "transfer_function_2d") else { panic!("none") };
    assert_eq!(function.primitives.len(), 1);
    let handle = harness.get_by_label("Handle 1 of 2-D transfer function").rect().center();
    harness.drag_at(handle);
    harness.run_steps(2);
    harness.hover_at(handle + Vec2::new(30.0, -20.0));
    harness.run_steps(2);
    harness.drop_at(handle + Vec2::new(30.0, -20.0));
    harness.run_steps(3);
    assert_ne!(value(&harness, "transfer_function_2d"), Some(Value::TransferFunction2D(function)));
    window::wait_for(&mut harness, "ready, took");
    window::keep_picture(&mut harness, "properties_2d");

    set(&mut harness, "classification", "\"labels\"");
    for _ in 0..3 {
        click(&mut harness, Role::Button, "Add a label");
    }
    type_number(&mut harness, "Opacity of label 2", "0.8");
    let Some(Value::Labels(table)) = value(&harness, "label_table") else { panic!("none") };
    assert_eq!((table.labels.len(), table.labels[&2].transfer_function.knots[0].opacity), (3, 0.8));
    window::keep_picture(&mut harness, "properties_labels");

    set(&mut harness, "classification", "\"transfer_function\"");
    harness.get_by_label("Direction of Light").scroll_to_me();
    harness.run_steps(30);
    window::keep_picture(&mut harness, "properties_light");
    let sphere = harness.get_by_label("Direction of Light").rect();
    harness.drag_at(sphere.center());
    harness.run_steps(2);
    harness.drop_at(sphere.center());
    harness.run_steps(3);
    let Some(Value::Light(light)) = value(&harness, "light") else { panic!("none") };
    assert_eq!(light.direction, [0.0, 0.0, 1.0]);
}

#[test]
fn a_snippet_is_edited_broken_and_reverted() {
    let mut harness = selected("traversal");
    window::wait_for(&mut harness, "ready, took");
    click(&mut harness, Role::Button, "Shading text");
    harness.get_by_role_and_label(Role::MultilineTextInput, "Shading text").focus();
    harness.run_steps(3);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::End);
    harness.run_steps(2);
    harness.event(egui::Event::Text("\nbroken".to_owned()));
    harness.run_steps(3);
    assert_eq!(value(&harness, "shading.text"), Some(Value::Text(String::new())));
    click(&mut harness, Role::Button, "Apply");
    window::wait_for(&mut harness, "edited/shading.wgsl:");
    window::keep_picture(&mut harness, "properties_broken");
    assert!(matches!(value(&harness, "shading.text"), Some(Value::Text(text)) if text.ends_with("broken")));
    click(&mut harness, Role::Button, "Revert");
    assert_eq!(value(&harness, "shading.text"), Some(Value::Text(String::new())));
    window::wait_for(&mut harness, "ready, took");
}

#[test]
fn cameras_keep_their_distance_and_links_are_made_and_cut() {
    let mut harness = selected("view");
    window::wait_for(&mut harness, "ready, took");
    let distance = |harness: &Harness<'_, Studio>| match value(harness, "camera") {
        Some(Value::Camera(camera)) => (camera.distance(), camera.basis()[2]),
        _ => panic!("no camera"),
    };
    let before = distance(&harness).0;
    click(&mut harness, Role::Button, "Top");
    let (after, forward) = distance(&harness);
    assert!((after - before).abs() < 1e-9 && forward.z < -0.999);
    type_number(&mut harness, "Up x", "nonsense");
    assert!(harness.query_by_label_contains("is not a number").is_some());

    let add = |network: &mut rayloom_network::Network| network.add("entry_exit_points", "second");
    assert!(harness.state_mut().session.edit("add", add));
    click(&mut harness, Role::Button, "Menu of Camera");
    harness.get_by_label_contains("Link with").click();
    harness.run_steps(5);
    harness.get_by_label("second.camera").click();
    harness.run_steps(5);
    assert_eq!(harness.state().session.network().links().len(), 1);
    click(&mut harness, Role::Button, "Menu of Camera");
    window::keep_picture(&mut harness, "properties_link");
    harness.get_by_label("Cut the link with second.camera").click();
    harness.run_steps(5);
    assert!(harness.state().session.network().links().is_empty());
}
