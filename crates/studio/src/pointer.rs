//! What the pointer did.

use egui::{Event, Id, MouseWheelUnit, Response, Ui, Vec2};

/// Scrolled points that count as one notch of a wheel, on devices without notches.
const NOTCH: f32 = 40.0;

/// How far a drag went in this frame. The first frame counts from where the button was pressed: what the pointer moved before,
/// in the same slow frame, is no part of the drag.
pub fn dragged_by(response: &Response) -> Vec2 {
    match response.drag_started() {
        true => response.total_drag_delta().unwrap_or_default(),
        false => response.drag_delta(),
    }
}

/// Whole notches that the wheel went up in this frame; what is less adds up. Unlike egui's own numbers they are not spread over
/// the next frames, so that one notch is one step. With Ctrl the wheel zooms, and none are counted.
pub fn notches(ui: &Ui, who: Id) -> i32 {
    let moved: f32 = ui.input(|input| {
        let notches = input.events.iter().map(|event| match event {
            Event::MouseWheel { unit, delta, modifiers, .. } if !modifiers.command && !modifiers.ctrl => match unit {
                MouseWheelUnit::Line => delta.y,
                MouseWheelUnit::Point => delta.y / NOTCH,
                MouseWheelUnit::Page => 10.0 * delta.y,
            },
            _ => 0.0,
        });
        notches.sum()
    });
    if moved == 0.0 {
        return 0;
    }
    let all = moved + ui.data(|data| data.get_temp::<f32>(who)).unwrap_or_default();
    ui.data_mut(|data| data.insert_temp(who, all.fract()));
    all.trunc() as i32
}
