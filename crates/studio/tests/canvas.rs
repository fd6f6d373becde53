//! Pictures in canvases: coarse while something moves and then exact; what they cost; how cameras and slices are moved.

mod window;

use std::time::Duration;

use egui::{Event, Key, Modifiers, PointerButton, Pos2, TouchPhase, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::{Address, Camera, Evaluator, Request, Value};
use rayloom_processors::{Data, Image, Runner};
use rayloom_studio::{Mode, Options, Pane, Studio};

type Window = Harness<'static, Studio>;

/// A network whose data are computed in a moment, and its picture nearly so.
fn quick() -> Window {
    let mut window = window::studio(Options {
        network: Some(window::project("networks/marschner_lobb.json")),
        ..Options::default()
    });
    let session = &mut window.state_mut().session;
    session.set("traversal", "sampling", Value::Text("filtered".into()));
    session.document.settle();
    settle(&mut window);
    window
}

/// An application of slices and a picture.
fn mri_viewer() -> Window {
    window::studio(Options {
        network: Some(window::project("networks/apps/mri_viewer.json")),
        mode: Some(Mode::Visualization),
        ..Options::default()
    })
}

fn settle(window: &mut Window) {
    window::wait_until(window, |studio| {
        let engine = &studio.session.engine;
        engine.results.canvases.contains_key("canvas") && !engine.is_busy() && studio.session.quality.divisor() == 1
    });
}

fn canvas(window: &Window) -> Pos2 {
    window.get_by_label("canvas canvas").rect().center()
}

fn button(window: &mut Window, pos: Pos2, button: PointerButton, pressed: bool) {
    window.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    window.step();
}

fn drag(window: &mut Window, from: Pos2, steps: &[Vec2]) {
    window.hover_at(from);
    window.step();
    button(window, from, PointerButton::Primary, true);
    for step in steps {
        window.hover_at(from + *step);
        window.step();
    }
}

fn camera(window: &Window) -> Camera {
    match window.state().session.network().value("view", "camera") {
        Some(Value::Camera(camera)) => camera,
        other => panic!("no camera but {other:?}"),
    }
}

fn forward(camera: &Camera) -> [f64; 3] {
    std::array::from_fn(|axis| (camera.focus[axis] - camera.position[axis]) / camera.distance())
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

fn key(window: &mut Window, key: Key, pressed: bool) {
    window.event(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE });
    window.step();
}

fn scroll(window: &mut Window, at: Pos2, points: f32) {
    window.hover_at(at);
    window.step();
    let (unit, delta, phase) = (egui::MouseWheelUnit::Point, Vec2::new(0.0, points), TouchPhase::Move);
    window.event(Event::MouseWheel { unit, delta, phase, modifiers: Modifiers::NONE });
    window.run_steps(20);
}

fn touch(window: &mut Window, phase: TouchPhase, at: [Pos2; 2]) {
    for (id, pos) in (1..).zip(at) {
        let (device_id, id) = (egui::TouchDeviceId(1), egui::TouchId::from(id as u64));
        window.event(Event::Touch { device_id, id, phase, pos, force: None });
    }
    window.step();
}

fn shown(window: &Window) -> std::sync::Arc<Image> {
    window.state().session.engine.results.canvases["canvas"].clone()
}

#[test]
fn a_drag_is_coarse_and_then_the_picture_is_what_the_command_line_renders() {
    let mut window = quick();
    let middle = canvas(&window);
    let full = shown(&window).size();
    drag(&mut window, middle, &[Vec2::new(20.0, 5.0), Vec2::new(40.0, 10.0)]);
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases["canvas"].size() != full);
    assert!(window.query_by_label_contains("resolution while something moves").is_some());
    let coarse = shown(&window).size();
    assert!(coarse[0] * 2 <= full[0] + 1 && coarse[1] * 2 <= full[1] + 1, "{coarse:?} of {full:?}");
    button(&mut window, middle, PointerButton::Primary, false);
    settle(&mut window);
    assert_eq!(shown(&window).size(), full);

    let session = &window.state().session;
    let mut runner = Runner::new(session.display.gpu().clone()).expect("a runner");
    let mut evaluator = Evaluator::new();
    let request = Request { size: Some(full), ..Request::default() };
    assert!(evaluator.evaluate(session.network(), &mut runner, &request).is_complete());
    let Some(Data::Image(rendered)) = evaluator.inputs(session.network(), "canvas", "image").next() else {
        panic!("no picture")
    };
    let rendered = rendered.read_back(&runner.context).expect("read");
    let refined = shown(&window).read_back(&runner.context).expect("read");
    assert!(rendered.pixels == refined.pixels, "the refined picture is another");
}

#[test]
fn a_drag_ends_a_picture_that_takes_long() {
    let mut window = quick();
    // Some thousand samples a ray: many seconds on a software device.
    window.state_mut().session.set("traversal", "sampling_rate", Value::Float(64.0));
    window::wait_until(&mut window, |studio| studio.session.engine.running.as_deref() == Some("traversal"));
    let long = window.state().session.engine.results.number + 1;
    let middle = canvas(&window);
    drag(&mut window, middle, &[Vec2::new(20.0, 5.0)]);
    let (mut told, begun) = (Vec::new(), std::time::Instant::now());
    while told.last().is_none_or(|number| *number <= long) {
        window.step();
        told.push(window.state().session.engine.results.number);
        std::thread::sleep(std::time::Duration::from_millis(5));
        assert!(begun.elapsed().as_secs() < 120, "no picture while it is dragged");
    }
    assert!(!told.contains(&long), "the long picture was finished");
    let coarse = shown(&window).size();
    assert!(coarse[0] < 500, "{coarse:?}");
}

#[test]
fn the_frame_budget_lists_what_ran_and_what_was_kept_and_nodes_tell_what_is_stale() {
    let mut window = quick();
    window.state_mut().session.to_open.push(Pane::Budget);
    window::wait_for(&mut window, "traversal: GPU");
    // A burst of runs for nothing but a colour.
    let color = Value::Color([0.1, 0.2, 0.3, 1.0]);
    window.state_mut().session.set("background", "first", color);
    window::wait_for(&mut window, "traversal: cached");
    window::wait_for(&mut window, "background: GPU");
    window::keep_picture(&mut window, "budget");
    window.get_by_label("traversal: cached").click();
    window.run_steps(2);
    assert!(window.state().session.selection.contains("traversal"));

    // Cut off from the canvas, a processor whose properties change is stale.
    let session = &mut window.state_mut().session;
    session.edit("cut", |network| {
        network.disconnect(("background", "image"), ("canvas", "image"));
        Ok::<(), std::convert::Infallible>(())
    });
    session.set("background", "first", Value::Color([0.5, 0.2, 0.3, 1.0]));
    window::wait_for(&mut window, "processor background (Background): stale");
    window::keep_picture(&mut window, "stale");
}

#[test]
fn the_wheel_zooms_to_the_pointer_and_two_fingers_zoom_and_roll() {
    let mut window = quick();
    let (middle, before) = (canvas(&window), camera(&window));
    scroll(&mut window, middle + Vec2::new(150.0, 0.0), 120.0);
    let zoomed = camera(&window);
    assert!(zoomed.distance() < 0.9 * before.distance(), "{zoomed:?}");
    assert!(near(forward(&zoomed), forward(&before)) && zoomed.up == before.up);
    assert!(!near(zoomed.focus, before.focus), "it went to the pointer, not to the focus");

    let apart = |half: Vec2| [middle - half, middle + half];
    touch(&mut window, TouchPhase::Start, apart(Vec2::new(30.0, 0.0)));
    touch(&mut window, TouchPhase::Move, apart(Vec2::new(31.0, 0.0)));
    let before = camera(&window);
    touch(&mut window, TouchPhase::Move, apart(Vec2::new(50.0, 30.0)));
    touch(&mut window, TouchPhase::Move, apart(Vec2::new(50.0, 30.0)));
    touch(&mut window, TouchPhase::End, apart(Vec2::new(50.0, 30.0)));
    let after = camera(&window);
    assert!(after.distance() < 0.8 * before.distance(), "{before:?} {after:?}");
    let turn = after.basis()[1].dot(before.basis()[1]).acos();
    assert!((0.3..0.7).contains(&turn), "rolled by {turn}");
}

#[test]
fn walking_goes_where_the_camera_looks_and_the_cube_looks_from_its_sides() {
    let mut window = quick();
    let (middle, before) = (canvas(&window), camera(&window));
    window.hover_at(middle);
    window.step();
    key(&mut window, Key::W, true);
    window.run_steps(20);
    key(&mut window, Key::W, false);
    let walked = camera(&window);
    let way: [f64; 3] = std::array::from_fn(|axis| walked.position[axis] - before.position[axis]);
    let along: f64 = way.iter().zip(forward(&before)).map(|(way, forward)| way * forward).sum();
    assert!(along > 1.0 && near(forward(&walked), forward(&before)), "{along} {walked:?}");
    window.hover_at(middle + Vec2::new(60.0, 0.0));
    window.run_steps(2);
    let looked = camera(&window);
    assert!(near(looked.position, walked.position) && !near(forward(&looked), forward(&walked)));
    window::keep_picture(&mut window, "walking");
    key(&mut window, Key::Escape, true);
    window.hover_at(middle);
    window.run_steps(2);
    assert_eq!(camera(&window), looked, "it walks no more");

    let [right, up, _] = looked.basis();
    let cube = window.get_by_label("orientation cube canvas").rect().center();
    let top = cube + 22.0 * Vec2::new(right.z as f32, -up.z as f32);
    window.hover_at(top);
    window.step();
    button(&mut window, top, PointerButton::Primary, true);
    button(&mut window, top, PointerButton::Primary, false);
    assert!(near(forward(&camera(&window)), [0.0, 0.0, -1.0]), "{:?}", camera(&window));
    window.hover_at(middle);
    window.step();
    key(&mut window, Key::V, true);
    window.step();
    assert!(window.query_by_label("orientation cube canvas").is_none());
}

#[test]
fn a_window_at_rest_asks_for_no_frame() {
    let mut window = quick();
    window.run_steps(30);
    let next = window.output().viewport_output.values().map(|viewport| viewport.repaint_delay).min();
    assert!(next > Some(Duration::from_secs(1)), "{next:?}");
}

#[test]
fn what_the_pointer_moved_before_the_button_was_pressed_does_not_turn() {
    let mut window = quick();
    let (middle, before) = (canvas(&window), camera(&window));
    window.hover_at(middle - Vec2::new(150.0, 90.0));
    window.step();
    // All in one slow frame.
    window.hover_at(middle);
    let pressed = |pressed| Event::PointerButton {
        pos: middle,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.event(pressed(true));
    window.hover_at(middle + Vec2::new(20.0, 0.0));
    window.step();
    window.hover_at(middle + Vec2::new(30.0, 0.0));
    window.step();
    let (turned, mut expected) = (camera(&window), before);
    let height = f64::from(window.get_by_label("canvas canvas").rect().height());
    expected.orbit(-30.0 / height * std::f64::consts::PI, 0.0);
    for axis in 0..3 {
        assert!((turned.position[axis] - expected.position[axis]).abs() < 1e-3, "{turned:?} {expected:?}");
    }
}

#[test]
fn a_turning_camera_goes_on_only_with_inertia() {
    let mut window = quick();
    let middle = canvas(&window);
    let moves: Vec<_> = (1..8).map(|step| Vec2::new(12.0 * step as f32, 0.0)).collect();
    for inertia in [false, true] {
        window.state_mut().session.navigation.inertia = inertia;
        drag(&mut window, middle, &moves);
        button(&mut window, middle + moves[6], PointerButton::Primary, false);
        let released = camera(&window);
        window.run_steps(30);
        assert_eq!(camera(&window) != released, inertia);
    }
    window.run_steps(300);
    let resting = camera(&window);
    window.run_steps(10);
    assert_eq!(camera(&window), resting, "it comes to rest");

    // A drag and what it set in motion are one step.
    assert!(window.state_mut().session.document.undo());
    let before = camera(&window);
    window.run_steps(10);
    assert_eq!(camera(&window), before, "it goes on after undoing");
    assert!(window.state_mut().session.document.undo());
    assert_ne!(camera(&window), before);
    assert_eq!(window.state().session.document.undo_label(), Some("set traversal.sampling"));
}

#[test]
fn what_does_not_move_keeps_its_resolution() {
    let mut window = mri_viewer();
    settle(&mut window);
    let sizes = |window: &Window| {
        let canvases = &window.state().session.engine.results.canvases;
        ["canvas", "canvas_axial", "canvas_coronal"].map(|canvas| canvases[canvas].size())
    };
    let full = sizes(&window);
    let middle = canvas(&window);
    drag(&mut window, middle, &[Vec2::new(20.0, 5.0), Vec2::new(40.0, 10.0)]);
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases["canvas"].size() != full[0]);
    assert_eq!(sizes(&window)[1..], full[1..], "slices do not show the camera");
    button(&mut window, middle, PointerButton::Primary, false);
    settle(&mut window);
    assert_eq!(sizes(&window), full);
}

#[test]
fn the_wheel_goes_through_slices_and_a_click_places_the_crosshair_of_all() {
    let mut window = mri_viewer();
    let axial = "canvas_axial";
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key(axial));
    let positions = |window: &Window| {
        ["sagittal", "coronal", "axial"].map(|slice| match window.state().session.network().value(slice, "position") {
            Some(Value::Float(position)) => position,
            other => panic!("no position but {other:?}"),
        })
    };
    let before = positions(&window);
    let middle = window.get_by_label("canvas canvas_axial").rect().center();
    scroll(&mut window, middle, 48.0);
    let scrolled = positions(&window);
    assert!(scrolled[2] > before[2] && scrolled[..2] == before[..2], "{before:?} {scrolled:?}");
    // To the right of the middle and above it.
    let at = middle + Vec2::new(40.0, -30.0);
    window.hover_at(at);
    window.step();
    button(&mut window, at, PointerButton::Primary, true);
    button(&mut window, at, PointerButton::Primary, false);
    let placed = positions(&window);
    assert_eq!(placed[2], scrolled[2]);
    assert!(placed[0] > 0.5 && placed[1] > 0.5 && placed[0] < 1.0 && placed[1] < 1.0, "{placed:?}");
    window::keep_picture(&mut window, "crosshair");

    // The voxel under the pointer, where the crosshair is now, is marked in the transfer functions of the volume.
    let session = &window.state().session;
    let Some(Data::Volume(data)) = session.engine.results.outputs.get(&Address::new("source", "volume")) else {
        panic!("no volume")
    };
    let voxel = [0, 1, 2].map(|axis| (placed[axis] * f64::from(data.volume.dims[axis])) as u32);
    let value = data.volume.value(voxel, 0);
    assert_ne!(value, data.volume.value([0; 3], 0), "the test looks at nothing");
    assert_eq!(session.probe.marker("traversal").map(|mark| mark.value), Some(value));
    window.hover_at(Pos2::ZERO);
    window.run_steps(3);
    assert_eq!(window.state().session.probe.marker("traversal"), None);
}

fn notch(window: &mut Window, at: Pos2, notches: f32) {
    window.hover_at(at);
    window.step();
    let (unit, delta, phase) = (egui::MouseWheelUnit::Line, Vec2::new(0.0, notches), TouchPhase::Move);
    window.event(Event::MouseWheel { unit, delta, phase, modifiers: Modifiers::NONE });
    window.run_steps(20);
}

#[test]
fn a_notch_of_the_wheel_is_one_slice_and_a_quick_click_counts() {
    let mut window = mri_viewer();
    let axial = "canvas_axial";
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key(axial));
    let voxels = match window.state().session.engine.results.outputs.get(&Address::new("source", "volume")) {
        Some(Data::Volume(data)) => data.volume.dims[2],
        _ => panic!("no volume"),
    };
    let position = |window: &Window, slice: &str| match window.state().session.network().value(slice, "position") {
        Some(Value::Float(position)) => position,
        other => panic!("no position but {other:?}"),
    };
    let slice = |window: &Window| (position(window, "axial") * f64::from(voxels)) as u32;
    let middle = window.get_by_label("canvas canvas_axial").rect().center();
    let first = slice(&window);
    for (count, notches) in [(1, 1.0), (2, 1.0), (3, 1.0), (2, -1.0), (6, 4.0)] {
        notch(&mut window, middle, notches);
        assert_eq!(slice(&window), first + count);
    }
    // Pressed and released within one frame.
    let at = middle + Vec2::new(40.0, 0.0);
    window.hover_at(at);
    window.step();
    let before = position(&window, "sagittal");
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(2);
    assert_ne!(position(&window, "sagittal"), before, "the click was lost");

    // Who only looks around changes nothing that would have to be saved.
    assert!(!window.state().session.document.is_modified());
    window.state_mut().session.mode = Mode::Development;
    window.state_mut().session.set("axial", "position", Value::Float(0.25));
    assert!(window.state().session.document.is_modified(), "the author's own position");
}

#[test]
fn a_canvas_says_in_both_modes_that_its_picture_is_an_older_one() {
    for mode in [Mode::Development, Mode::Visualization] {
        let mut window = quick();
        window.state_mut().session.mode = mode;
        settle(&mut window);
        window.state_mut().session.set("traversal", "shading.text", Value::Text("//! slot: shading\nno".into()));
        window::wait_for(&mut window, "traversal failed: this picture is an older one");
        window::keep_picture(&mut window, &format!("old_{mode:?}"));
        assert!(window.state_mut().session.document.undo());
        window::wait_while(&mut window, "this picture is an older one");
    }
}

#[test]
fn the_first_picture_is_coarse_and_a_long_one_tells_how_far_it_is() {
    let mut window = window::studio(Options {
        network: Some(window::project("networks/marschner_lobb.json")),
        ..Options::default()
    });
    window::wait_until(&mut window, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    let (first, full) = (shown(&window).size(), window.state().session.shown["canvas"]);
    assert!(first[0] <= full[0].div_ceil(4), "{first:?} of {full:?}");
    settle(&mut window);
    assert_eq!(shown(&window).size(), full);
    window.state_mut().session.set("traversal", "sampling_rate", Value::Float(64.0));
    window::wait_for(&mut window, "Computing traversal");
    window::keep_picture(&mut window, "computing");
}
