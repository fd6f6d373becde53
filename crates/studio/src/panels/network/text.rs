//! Text that stays sharp at every zoom.

use std::sync::Arc;

use egui::emath::TSTransform;
use egui::{Color32, FontId, Galley, Painter, Pos2, Shape, Vec2};

/// Steps of the size at which letters are drawn, points of the window: not every zoom needs letters of its own.
const STEP: f32 = 0.5;

/// One line, laid out for the size that it has in the window. (The canvas scales what is drawn on it, and letters that are
/// scaled are blurred or broken.)
pub struct Text {
    galley: Arc<Galley>,
    scale: f32,
    color: Color32,
}

impl Text {
    /// Lays a line out. `size` is the height of the font on the canvas; `zoom`, pixels of the window for a point of it.
    pub fn new(painter: &Painter, text: &str, size: f32, color: Color32, zoom: f32) -> Self {
        let drawn = ((size * zoom / STEP).round() * STEP).max(2.0);
        let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(drawn), color);
        Self { galley, scale: size / drawn, color }
    }

    /// Width and height on the canvas.
    pub fn size(&self) -> Vec2 {
        self.galley.size() * self.scale
    }

    /// Draws it with its left top corner at a place.
    pub fn paint(self, painter: &Painter, at: Pos2) {
        let mut shape = Shape::galley(Pos2::ZERO, self.galley, self.color);
        shape.transform(TSTransform::new(at.to_vec2(), self.scale));
        painter.add(shape);
    }
}
