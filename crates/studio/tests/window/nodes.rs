//! The node canvas, as a hand uses it.

use egui::{Event, Key, Modifiers, Pos2, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_studio::Studio;

/// The whole window.
pub type Window = Harness<'static, Studio>;

/// The node canvas, without the border.
pub fn canvas(window: &Window) -> Rect {
    let tab = window.get_by_label("Network").rect();
    Rect::from_min_max(tab.left_bottom() + Vec2::splat(20.0), window.get_by_label("Show all").rect().right_bottom())
}

/// A place on the canvas, by its share of the width and height.
pub fn on_canvas(window: &Window, (x, y): (f32, f32)) -> Pos2 {
    let canvas = canvas(window);
    canvas.min + canvas.size() * Vec2::new(x, y)
}

/// Makes everything so small that a whole network is in view.
pub fn zoom_out(window: &mut Window) {
    window.hover_at(canvas(window).left_top());
    window.run_steps(2);
    window.event(Event::Zoom(0.6));
    window.run_steps(3);
}

pub fn key(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(4);
}

/// A point just outside of the node at a socket: pressed there, a wire begins; pressed on the node, the node moves.
pub fn socket(window: &Window, label: &str) -> Pos2 {
    let rect = window.get_by_label(label).rect();
    let outwards = if label.starts_with("input") { -0.35 } else { 0.35 };
    rect.center() + Vec2::new(outwards * rect.width(), 0.0)
}

/// Drags and leaves the button pressed.
pub fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.run_steps(2);
    window.drag_at(from);
    window.run_steps(2);
    for part in [0.3, 0.7, 1.0, 1.0] {
        window.hover_at(from.lerp(to, part));
        window.run_steps(2);
    }
}

pub fn drag_and_drop(window: &mut Window, from: Pos2, to: Pos2) {
    drag(window, from, to);
    window.drop_at(to);
    window.run_steps(4);
}

pub fn wire(window: &mut Window, wire: &str) {
    let (from, to) = wire.split_once(" -> ").expect("a wire");
    let (from, to) = (socket(window, &format!("output {from}")), socket(window, &format!("input {to}")));
    drag_and_drop(window, from, to);
}

/// Adds a processor with the palette, at a place.
pub fn add(window: &mut Window, search: &str, at: Pos2) {
    window.hover_at(at);
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Space);
    window.event(Event::Text(search.to_owned()));
    window.run_steps(3);
    key(window, Modifiers::NONE, Key::Enter);
}
