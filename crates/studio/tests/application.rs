//! The author's panel: an application made by mouse and keyboard, and what its users see.

mod window;

use egui::accesskit::Role;
use egui::{Key, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::{Address, Value};
use rayloom_studio::{Application, Chooser, Mode, Options, Studio};

type Window = Harness<'static, Studio>;

fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// Types a text in place of what a field holds.
fn type_over(window: &mut Window, label: &str, text: &str) {
    click(window, label);
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(3);
}

fn application(window: &Window) -> Application {
    Application::of(window.state().session.network()).0
}

fn shown(window: &Window) -> Vec<Vec<String>> {
    let groups = application(window).groups;
    groups.iter().map(|group| group.properties.iter().map(|shown| shown.property.to_string()).collect()).collect()
}

fn drag(window: &mut Window, from: &str, to: egui::Pos2) {
    let from = window.get_by_label(from).rect().center();
    window.hover_at(from);
    window.run_steps(1);
    window.drag_at(from);
    window.run_steps(2);
    for part in [0.5, 1.0, 1.0] {
        window.hover_at(from.lerp(to, part));
        window.run_steps(1);
    }
    window.drop_at(to);
    window.run_steps(3);
}

/// Shows a property by the menu of its name.
fn expose(window: &mut Window, label: &str) {
    let menu = format!("Menu of {label}");
    window.get_by_label(&menu).scroll_to_me();
    window.run_steps(20);
    click(window, &menu);
    click(window, "Show in the application");
}

#[test]
fn an_application_is_made_by_mouse_saved_and_shows_just_that() {
    let folder = std::env::temp_dir().join(format!("rayloom-application-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("app.json");
    let chosen = file.clone();
    let chooser = Chooser::new(move |_| Box::pin(std::future::ready(Some(chosen.clone()))));
    let mut window = window::studio(Options { chooser, ..window::flagship() });
    window.run_steps(3);
    click(&mut window, "processor traversal (Ray traversal): idle");
    for label in ["Sampling rate", "Shading"] {
        expose(&mut window, label);
    }
    click(&mut window, "View");
    click(&mut window, "Show application");
    assert_eq!(shown(&window), [["traversal.sampling_rate", "traversal.shading"]]);

    // By the picker of the panel, into a second group; then dragged to the top of the first.
    click(&mut window, "Add group");
    click(&mut window, "Add property to group 2");
    click(&mut window, "background ⏵");
    click(&mut window, "First colour first");
    assert_eq!(shown(&window)[1], ["background.first"]);
    let top = window.get_by_label("Label of traversal.sampling_rate").rect();
    drag(&mut window, "Move background.first", top.left_top() + Vec2::new(40.0, 2.0));
    let expected = ["background.first", "traversal.sampling_rate", "traversal.shading"];
    assert_eq!(shown(&window), [expected.to_vec(), vec![]]);
    click(&mut window, "Remove group 2");

    type_over(&mut window, "Title of group 1", "Look");
    type_over(&mut window, "Label of traversal.sampling_rate", "Quality");
    window.get_all_by_label("limit").next().expect("limits").click();
    window.run_steps(3);
    type_over(&mut window, "Name of a new preset", "As shipped");
    click(&mut window, "Store");
    window::keep_picture(&mut window, "application");

    let made = application(&window);
    assert_eq!(made.groups[0].title, "Look");
    assert_eq!(made.groups[0].properties[1].label.as_deref(), Some("Quality"));
    assert!(made.groups[0].properties[1].range.is_some());
    assert_eq!(made.presets[0].values[&Address::new("traversal", "shading")], serde_json::json!("blinn_phong"));

    // Saved and opened as its users do.
    window.key_press_modifiers(egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT), Key::S);
    window::wait_until(&mut window, |studio| !studio.session.document.is_modified());
    while window.state_mut().session.document.undo() {}
    assert!(window.state().session.network().visualization.is_null(), "a change that cannot be undone");
    drop(window);
    let mut window =
        window::studio(Options { network: Some(file), mode: Some(Mode::Visualization), ..Options::default() });
    window::wait_for(&mut window, "Quality");
    for label in ["Look", "As shipped", "First colour", "Shading"] {
        assert!(window.query_all_by_label(label).next().is_some(), "{label} is not shown");
    }
    for hidden in ["Network", "Properties", "Camera", "Compositing", "File", "Second colour"] {
        assert!(window.query_by_label(hidden).is_none(), "{hidden} is shown");
    }
    click(&mut window, "Menu of Quality");
    assert!(window.query_by_label("Hide in the application").is_none());
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    window.run_steps(3);
    window::keep_picture(&mut window, "application_users");
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn an_application_follows_renames_and_names_what_is_gone() {
    let mut window = window::studio(window::flagship());
    window.run_steps(3);
    click(&mut window, "processor background (Background): idle");
    expose(&mut window, "First colour");
    click(&mut window, "id of the processor");
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    window.event(egui::Event::Text("sky".into()));
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(4);
    assert_eq!(shown(&window), [["sky.first"]]);
    assert!(window.state().session.selection.contains("sky"));
    assert!(matches!(window.state().session.network().value("sky", "first"), Some(Value::Color(_))));

    click(&mut window, "View");
    click(&mut window, "Show application");
    window.get_by_label_contains("processor sky").click();
    window.run_steps(3);
    window.key_press(Key::Delete);
    window.run_steps(3);
    assert!(window.state().session.network().processor("sky").is_none());
    assert!(window.query_by_label_contains("there is no processor `sky`").is_some());
    window::keep_picture(&mut window, "application_problem");
    click(&mut window, "Hide sky.first");
    assert_eq!(shown(&window), [Vec::<String>::new()]);

    // Locked with a warning; switching modes by the button, back by the key only while it is not locked.
    let lock = window.get_by_role_and_label(Role::CheckBox, "Keep users in visualization mode");
    lock.click();
    window.run_steps(3);
    assert!(window.query_by_label_contains("Locked: once in visualization mode").is_some());
    assert!(window.state_mut().session.document.undo());
    assert!(!application(&window).locked);
    window.run_steps(1);
    click(&mut window, "Preview");
    assert_eq!(window.state().session.mode, Mode::Visualization);
    window.key_press(Key::F5);
    window.run_steps(2);
    assert_eq!(window.state().session.mode, Mode::Development);
}
