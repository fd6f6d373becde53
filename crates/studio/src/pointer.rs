//! What the pointer did.

use egui::{Response, Vec2};

/// How far a drag went in this frame. The first frame counts from where the button was pressed: what the pointer moved before,
/// in the same slow frame, is no part of the drag.
pub fn dragged_by(response: &Response) -> Vec2 {
    match response.drag_started() {
        true => response.total_drag_delta().unwrap_or_default(),
        false => response.drag_delta(),
    }
}
