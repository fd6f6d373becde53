//! The node canvas, by mouse and keyboard, with the real evaluator.

mod window;

use egui::{Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use rayloom_studio::Options;
use window::nodes::{self, Window, add, canvas, drag, drag_and_drop, key, on_canvas, socket, wire};
use window::{keep_picture, studio, wait_for};

const SOURCE_TO_CANVAS: [&str; 6] = [
    "volume_generator.volume -> cube_proxy.volume",
    "cube_proxy.geometry -> entry_exit_points.geometry",
    "volume_generator.volume -> ray_traversal.volume",
    "entry_exit_points.entry -> ray_traversal.entry",
    "entry_exit_points.exit -> ray_traversal.exit",
    "ray_traversal.image -> canvas.image",
];

fn wires(window: &Window) -> Vec<String> {
    window.state().session.network().connections().iter().map(ToString::to_string).collect()
}

fn text(window: &Window) -> String {
    window.state().session.document.text()
}

/// The network from source to canvas, from nothing.
fn chain() -> Window {
    let mut window = studio(Options::default());
    window.run_steps(4);
    nodes::zoom_out(&mut window);
    let places =
        [(0.2, 0.15), (0.2, 0.45), (0.5, 0.45), (0.6, 0.75), (0.85, 0.55)].map(|place| on_canvas(&window, place));
    let names = ["volume gen", "cube", "entry", "ray tra", "canvas"];
    for (name, place) in names.into_iter().zip(places) {
        add(&mut window, name, place);
    }
    window.run_steps(20);
    for text in SOURCE_TO_CANVAS {
        wire(&mut window, text);
    }
    window
}

#[test]
fn a_network_is_wired_from_nothing_by_mouse_and_keyboard() {
    let mut window = chain();
    assert_eq!(wires(&window), SOURCE_TO_CANVAS);
    wait_for(&mut window, "processor canvas (Canvas): ready");
    window::wait_until(&mut window, |studio| !studio.session.first_look.is_waiting());
    keep_picture(&mut window, "chain");
    let built = text(&window);
    let steps = 5 + SOURCE_TO_CANVAS.len();
    for _ in 0..steps {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(window.state().session.network().processors().count(), 0);
    assert!(!window.state().session.document.is_modified());
    for _ in 0..steps {
        key(&mut window, Modifiers::COMMAND, Key::Y);
    }
    assert_eq!(text(&window), built);

    // A drag of a node is one step.
    let node = window.get_by_label_contains("processor canvas").rect();
    let grip = node.left_top() + Vec2::new(30.0, 12.0);
    drag_and_drop(&mut window, grip, grip + Vec2::new(-20.0, -100.0));
    window.run_steps(20);
    assert_ne!(text(&window), built);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(text(&window), built);
}

#[test]
fn wires_are_refused_with_the_reason_replugged_cut_and_offered_what_fits() {
    let mut window = chain();
    // Refused: the reason is at the pointer before, and among the messages after.
    let (from, to) = (socket(&window, "output cube_proxy.geometry"), socket(&window, "input ray_traversal.entry"));
    drag(&mut window, from, to);
    let reason = "cube_proxy.geometry gives a geometry, but ray_traversal.entry takes an image of entry points.";
    assert!(window.query_by_label(reason).is_some(), "no tooltip");
    keep_picture(&mut window, "refused");
    window.drop_at(to);
    window.run_steps(3);
    assert_eq!(wires(&window), SOURCE_TO_CANVAS);
    assert!(window.state().session.messages.iter().any(|message| message.text == reason));

    // Taken off and dropped on empty canvas: cut.
    let (held, empty) = (socket(&window, "input canvas.image"), on_canvas(&window, (0.8, 0.15)));
    drag_and_drop(&mut window, held, empty);
    assert!(!wires(&window).contains(&SOURCE_TO_CANVAS[5].to_owned()));

    // Drawn to empty canvas: a menu of what fits, connected at once.
    let from = socket(&window, "output ray_traversal.image");
    drag_and_drop(&mut window, from, empty);
    assert!(window.query_by_label("Cube proxy  (Volume)").is_none(), "offered although it does not fit");
    window.get_by_label("Background  (Front)").click();
    window.run_steps(20);
    assert!(wires(&window).contains(&"ray_traversal.image -> background.front".to_owned()));

    // Deleted with reconnecting: what fed it feeds what it fed.
    wire(&mut window, "background.image -> canvas.image");
    window.get_by_label_contains("processor background").click();
    window.run_steps(3);
    assert!(window.state().session.selection.contains("background"));
    key(&mut window, Modifiers::SHIFT, Key::Delete);
    assert_eq!(wires(&window).last().map(String::as_str), Some(SOURCE_TO_CANVAS[5]));

    // A wire is selected by a click and removed by a key.
    let middle =
        socket(&window, "output cube_proxy.geometry").lerp(socket(&window, "input entry_exit_points.geometry"), 0.5);
    window.hover_at(middle);
    window.run_steps(3);
    window.drag_at(middle);
    window.run_steps(1);
    window.drop_at(middle);
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert!(!wires(&window).contains(&SOURCE_TO_CANVAS[1].to_owned()));
}

#[test]
fn copies_are_text_and_the_list_adds_into_wires() {
    let mut window = chain();
    window.get_by_label_contains("processor entry_exit_points").click();
    window.run_steps(3);
    window.event(Event::Copy);
    window.run_steps(1);
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let copied = copied.expect("something copied");
    assert!(copied.contains("\"type\": \"entry_exit_points\""), "{copied}");
    window.hover_at(on_canvas(&window, (0.2, 0.7)));
    window.event(Event::Paste(copied));
    window.run_steps(5);
    assert!(window.state().session.network().processor("entry_exit_points_2").is_some());
    key(&mut window, Modifiers::COMMAND, Key::D);
    assert!(window.state().session.network().processor("entry_exit_points_3").is_some());

    // Dragged from the list onto a wire: inserted.
    let entry = window.get_by_label("Background").rect().center();
    let middle = socket(&window, "output ray_traversal.image").lerp(socket(&window, "input canvas.image"), 0.5);
    drag_and_drop(&mut window, entry, middle);
    assert!(wires(&window).contains(&"ray_traversal.image -> background.front".to_owned()));
    assert!(wires(&window).contains(&"background.image -> canvas.image".to_owned()));
    // Clicked in the list: added.
    window.get_by_label("Compositor").click();
    window.run_steps(5);
    assert!(window.state().session.network().processor("compositor").is_some());
    // Arranged: nothing overlaps.
    key(&mut window, Modifiers::NONE, Key::Escape);
    window.get_by_label("Arrange").click();
    window.run_steps(30);
    let network = window.state().session.network();
    let at = |id: &str| network.processor(id).expect("there").position();
    assert!(at("volume_generator")[0] < at("cube_proxy")[0] && at("ray_traversal")[0] < at("canvas")[0]);
    keep_picture(&mut window, "arranged");
}

/// Distance of the sockets of a node, points of the canvas.
const ROW: f32 = 20.0;

/// A wire of each kind: volume, geometry, entry points, exit points, colour, data.
const KINDS: [&str; 6] = [
    "source.volume -> proxy.volume",
    "proxy.geometry -> view.geometry",
    "view.entry -> traversal.entry",
    "view.exit -> traversal.exit",
    "background.image -> canvas.image",
    "traversal.image2 -> depth.source",
];

/// The middle of a wire: it is the same upside down.
fn middle(window: &Window, wire: &str) -> Pos2 {
    let (from, to) = wire.split_once(" -> ").expect("a wire");
    let [from, to] = [format!("output {from}"), format!("input {to}")].map(|label| window.get_by_label(&label).rect());
    from.center().lerp(to.center(), 0.5)
}

/// Rests somewhere until a tooltip is there.
fn rest(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.run_steps(24);
}

#[test]
fn resting_on_a_wire_of_any_kind_or_its_socket_shows_what_flows_there_at_any_zoom() {
    let network = Some(window::project("networks/depth_color.json"));
    let mut window = studio(Options { network, ..Options::default() });
    wait_for(&mut window, "processor canvas (Canvas): ready");
    for wire in KINDS {
        let (outport, _) = wire.split_once(" -> ").expect("a wire");
        let output = format!("output {outport}");
        for zoom in [0.5, 1.0, 2.0] {
            window.get_by_label("Show all").click();
            window.run_steps(8);
            let at = middle(&window, wire);
            window.hover_at(at);
            window.run_steps(2);
            let height = |label: &str| window.get_by_label(label).rect().center().y;
            let shown = (height("output view.exit") - height("output view.entry")) / ROW;
            window.event(Event::Zoom(zoom / shown));
            window.run_steps(3);
            rest(&mut window, Pos2::new(600.0, 10.0));
            assert!(window.query_by_label(outport).is_none(), "{outport} is shown although nothing rests there");
            let at = middle(&window, wire);
            rest(&mut window, at);
            assert!(window.query_by_label(outport).is_some(), "nothing shown on {wire} at zoom {zoom}");
            let socket = window.get_by_label(&output).rect().center();
            if canvas(&window).contains(socket) {
                rest(&mut window, Pos2::new(600.0, 10.0));
                rest(&mut window, socket);
                assert!(window.query_by_label(outport).is_some(), "nothing shown on {output} at zoom {zoom}");
            }
        }
    }
    // The key pins what rests under the pointer, the middle button any wire.
    window.get_by_label("Show all").click();
    window.run_steps(8);
    let at = middle(&window, KINDS[0]);
    rest(&mut window, at);
    key(&mut window, Modifiers::NONE, Key::P);
    let at = middle(&window, KINDS[4]);
    window.hover_at(at);
    window.run_steps(3);
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Middle, Modifiers::NONE);
        window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
        window.run_steps(2);
    }
    window.hover_at(Pos2::new(600.0, 10.0));
    window.run_steps(10);
    for pinned in ["source.volume", "background.image"] {
        assert!(window.query_all_by_label(pinned).next().is_some(), "{pinned} is not pinned");
    }
    keep_picture(&mut window, "pinned");
}

#[test]
fn cameras_link_by_themselves_and_properties_by_dragging_their_names() {
    let mut window = chain();
    let second = on_canvas(&window, (0.45, 0.85));
    add(&mut window, "entry", second);
    let links = |window: &Window| -> Vec<String> {
        window.state().session.network().links().iter().map(ToString::to_string).collect()
    };
    let linked = "entry_exit_points.camera = entry_exit_points_2.camera";
    assert_eq!(links(&window), [linked]);
    assert!(
        window.state().session.messages.iter().any(|message| message.text.contains("follows entry_exit_points.camera"))
    );
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(links(&window).is_empty() && window.state().session.network().processor("entry_exit_points_2").is_none());
    key(&mut window, Modifiers::COMMAND, Key::Y);
    assert_eq!(links(&window), [linked]);

    // Dragged onto a node: a menu of what may follow.
    let session = &mut window.state_mut().session;
    session.edit("cut", |network| {
        network.unlink(("entry_exit_points", "camera"), ("entry_exit_points_2", "camera"));
        Ok::<(), std::convert::Infallible>(())
    });
    session.selection = ["entry_exit_points_2".to_owned()].into();
    window.run_steps(3);
    let name = window.get_by_label("Menu of Camera").rect().center();
    let node = window.get_by_label_contains("processor entry_exit_points (").rect().center();
    drag_and_drop(&mut window, name, node);
    keep_picture(&mut window, "link_menu");
    window.get_by_role_and_label(egui::accesskit::Role::Button, "Camera").click();
    window.run_steps(4);
    assert_eq!(links(&window), ["entry_exit_points_2.camera = entry_exit_points.camera"]);
}

#[test]
fn three_hundred_nodes_and_five_hundred_wires_are_drawn() {
    let folder = std::env::temp_dir().join(format!("rayloom-large-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("large.json");
    let node = |i: usize| serde_json::json!({"id": format!("n{i}"), "type": "compositor", "position": [(i % 20) * 220, (i / 20) * 140]});
    let first = (0..299).map(|i| format!("n{i}.image -> n{}.first", i + 1));
    let second = (0..201).map(|i| format!("n{i}.image -> n{}.second", i + 2));
    let network = serde_json::json!({
        "rayloom": 1,
        "processors": (0..300).map(node).collect::<Vec<_>>(),
        "connections": first.chain(second).collect::<Vec<_>>(),
    });
    std::fs::write(&file, network.to_string()).expect("written");
    let mut window = studio(Options { network: Some(file), ..Options::default() });
    window.run_steps(10);
    assert_eq!(wires(&window).len(), 500);
    let center = on_canvas(&window, (0.5, 0.5));
    window.hover_at(center);
    window.event(Event::Zoom(4.0));
    window.run_steps(5);
    keep_picture(&mut window, "large");
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn a_frame_moves_with_what_is_in_it_and_the_map_goes_there() {
    let mut window = chain();
    window::wait_until(&mut window, |studio| !studio.session.first_look.is_waiting());
    let at = |window: &Window, id: &str| window.state().session.network().processor(id).expect("there").position();
    let (inside, outside) = (at(&window, "cube_proxy"), at(&window, "canvas"));
    let before = text(&window);
    window.get_by_label_contains("processor cube_proxy").click();
    window.run_steps(4);
    key(&mut window, Modifiers::NONE, Key::G);
    assert_eq!(window.state().session.network().frames().len(), 1);
    let head = window.get_by_label("frame Notes").rect();
    let grip = head.left_center() + Vec2::new(30.0, 0.0);
    drag_and_drop(&mut window, grip, grip + Vec2::new(30.0, -24.0));
    let moved = at(&window, "cube_proxy");
    assert!(moved[0] > inside[0] + 10.0 && moved[1] < inside[1] - 10.0, "{inside:?} {moved:?}");
    assert_eq!(at(&window, "canvas"), outside);
    key(&mut window, Modifiers::NONE, Key::M);
    let map = window.get_by_label("map of the network").rect();
    keep_picture(&mut window, "frame");
    let seen = window.get_by_label_contains("processor canvas").rect().center();
    window.hover_at(map.left_center());
    window.run_steps(1);
    window.drag_at(map.left_center() + Vec2::new(4.0, 0.0));
    window.run_steps(2);
    window.drop_at(map.left_center() + Vec2::new(4.0, 0.0));
    window.run_steps(4);
    let now = window.query_by_label_contains("processor canvas").map(|node| node.rect().center());
    assert!(now.is_none_or(|now| now.x > seen.x + 20.0), "the view did not move");
    // A drag is one step, as is the frame.
    for _ in 0..2 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(text(&window), before);
}

fn zoom(window: &Window) -> f32 {
    window.get_by_label_contains("processor canvas (").rect().width()
}

#[test]
fn the_wheel_zooms_to_the_pointer_also_over_a_node() {
    let mut window = window::studio(window::flagship());
    window.run_steps(5);
    let node = window.get_by_label_contains("processor canvas (").rect().center();
    for at in [node, on_canvas(&window, (0.5, 0.04))] {
        let before = zoom(&window);
        for notches in [1.0, -1.0] {
            window.hover_at(at);
            window.run_steps(2);
            let (unit, delta) = (egui::MouseWheelUnit::Line, Vec2::new(0.0, notches));
            let phase = egui::TouchPhase::Move;
            window.event(Event::MouseWheel { unit, delta, phase, modifiers: Modifiers::NONE });
            window.run_steps(20);
            let expected =
                if notches > 0.0 { zoom(&window) / before > 1.05 } else { (zoom(&window) / before - 1.0).abs() < 0.01 };
            assert!(expected, "{notches} at {at:?}: {before} {}", zoom(&window));
            if at == node {
                assert!(window.get_by_label_contains("processor canvas (").rect().contains(node));
            }
        }
    }
}

#[test]
fn a_quick_click_selects_a_node_and_keys_need_no_click_first() {
    let mut window = window::studio(window::flagship());
    window.run_steps(5);
    let click = |window: &mut Window, label: &str| {
        let pos = window.get_by_label_contains(label).rect().center();
        window.hover_at(pos);
        window.run_steps(2);
        for pressed in [true, false] {
            let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::NONE);
            window.event(Event::PointerButton { pos, button, pressed, modifiers });
        }
        window.run_steps(4);
    };
    for id in ["traversal", "canvas"] {
        click(&mut window, &format!("processor {id} ("));
        assert_eq!(Vec::from_iter(&window.state().session.selection), [id]);
    }
    // A click on a panel beside it, and back with the pointer only.
    let beside = window.get_by_label("Properties").rect().center();
    window.hover_at(beside);
    window.step();
    window.drag_at(beside);
    window.step();
    window.drop_at(beside);
    window.run_steps(2);
    let at = on_canvas(&window, (0.5, 0.04));
    window.hover_at(at);
    window.run_steps(3);
    key(&mut window, Modifiers::NONE, Key::Delete);
    assert!(window.state().session.network().processor("canvas").is_none());
}

#[test]
fn what_replaces_a_processor_does_not_keep_the_name_of_its_type() {
    let mut window = window::studio(Options::default());
    window.run_steps(3);
    let at = on_canvas(&window, (0.5, 0.5));
    add(&mut window, "volume generator", at);
    assert!(window.state().session.network().processor("volume_generator").is_some());
    let node = window.get_by_label_contains("processor volume_generator").rect().center();
    window.hover_at(node);
    window.run_steps(2);
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        window.event(Event::PointerButton { pos: node, button, pressed, modifiers: Modifiers::NONE });
        window.run_steps(2);
    }
    for label in ["Replace by", "Source", "Volume source"] {
        // The list of processors has some of these words, too; menus come after it.
        window.query_all_by_label_contains(label).last().expect("in the menu").click();
        window.run_steps(6);
    }
    assert!(window.state().session.network().processor("volume_source").is_some());
    assert!(window.state().session.selection.contains("volume_source"));
}

#[test]
fn a_new_chain_shows_its_first_data_well() {
    let mut window = chain();
    let default = |window: &Window, id: &str, property: &str| {
        let processor = window.state().session.network().processor(id).expect("it was added");
        let decls = processor.property_decls();
        let decl = decls.iter().find(|decl| decl.id == property).expect("declared");
        processor.properties().get(property) == Some(&decl.default)
    };
    window::wait_until(&mut window, |studio| !studio.session.first_look.is_waiting());
    assert!(!default(&window, "ray_traversal", "transfer_function"), "a white blob");
    assert!(!default(&window, "entry_exit_points", "camera"), "the camera sees what there is");
    keep_picture(&mut window, "first_look");
}
