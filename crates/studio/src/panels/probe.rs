//! Picking the pixel whose ray is probed, in any picture.

use egui::{Color32, Painter, Pos2, Rect, Response, Stroke, Ui, Vec2};

use crate::session::{Mode, Session, Severity};

/// Ctrl and a click on a picture that `processor` shows or gives look at the ray of the pixel there, which is marked then.
/// `place` tells pictures apart.
pub(super) fn pick(ui: &Ui, response: &Response, picture: Rect, session: &mut Session, processor: &str, place: &str) {
    if session.mode != Mode::Development {
        return;
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(|pointer| picture.contains(*pointer))
        && response.clicked()
        && ui.input(|input| input.modifiers.command)
    {
        let at = (pointer - picture.center()) / picture.height();
        if !session.probe(processor, place, at.into()) {
            session.tell(Severity::Note, format!("no ray traversal draws what `{place}` shows, so there is no ray"));
        }
    }
    if let Some([x, y]) = session.probe.mark_in(place).filter(|_| session.engine.results.trace.is_some()) {
        crosshair(&ui.painter().with_clip_rect(picture), picture.center() + Vec2::new(x, y) * picture.height());
    }
}

/// A small cross with an open middle, to be seen on every colour.
fn crosshair(painter: &Painter, place: Pos2) {
    for (color, width) in [(Color32::from_black_alpha(160), 3.0), (Color32::WHITE, 1.0)] {
        for way in [Vec2::RIGHT, Vec2::LEFT, Vec2::UP, Vec2::DOWN] {
            painter.line_segment([place + 3.0 * way, place + 9.0 * way], Stroke::new(width, color));
        }
    }
}
