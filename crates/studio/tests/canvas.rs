//! Pictures in canvases: coarse while something moves and then exact; what they cost; how cameras and slices are moved.

mod window;

use egui::{Event, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::{Evaluator, Request, Value};
use rayloom_processors::{Data, Image, Runner};
use rayloom_studio::{Options, Pane, Studio};

type Window = Harness<'static, Studio>;

/// A network whose data are computed in a moment.
fn quick() -> Window {
    let mut window = window::studio(Options {
        network: Some(window::project("networks/marschner_lobb.json")),
        ..Options::default()
    });
    settle(&mut window);
    window
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
