//! The wheel and two fingers zoom the canvas to the pointer, whatever lies under it.

use egui::{Pos2, Rect, Ui, Vec2};

use super::NetworkPanel;

/// Smallest and largest zoom.
pub(super) const RANGE: std::ops::RangeInclusive<f32> = 0.1..=3.0;
/// Exponent of the zoom per scrolled point.
const SPEED: f32 = 0.003;

impl NetworkPanel {
    /// Zooms by what was scrolled in this frame. To be called before the graph is shown: its library would move by the wheel,
    /// and not at all over a node.
    pub(super) fn zoom(&mut self, ui: &Ui, area: Rect) {
        let pointer = ui.input(|input| input.pointer.latest_pos()).filter(|at| area.contains(*at) && is_bare(ui, *at));
        let Some(pointer) = pointer else { return };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let to_canvas = self.geometry.to_window.inverse();
        // Beside the nodes the library takes pinches itself.
        let over_node = self.geometry.node_at(to_canvas * pointer).is_some();
        let factor = (scroll.y * SPEED).exp() * if over_node { pinch } else { 1.0 };
        if factor == 1.0 && scroll.x == 0.0 {
            return;
        }
        ui.input_mut(|input| input.smooth_scroll_delta = Vec2::ZERO);
        let zoom = (self.geometry.to_window.scaling * factor).clamp(*RANGE.start(), *RANGE.end());
        let corner = to_canvas * pointer - (pointer - area.min + Vec2::new(scroll.x, 0.0)) / zoom;
        self.view.scene_rect = Rect::from_min_size(corner, area.size() / zoom);
    }
}

/// Whether nothing lies over the panel at a point: no menu, no window.
fn is_bare(ui: &Ui, at: Pos2) -> bool {
    ui.ctx().layer_id_at(at).is_none_or(|layer| layer.order == ui.layer_id().order)
}
