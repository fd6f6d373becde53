//! The whole network, small, in a corner: click or drag to go somewhere.

use egui::{Align2, Area, Color32, Pos2, Rect, Sense, Stroke, StrokeKind, Ui, Vec2};

use super::frames;
use super::geometry::Geometry;
use crate::session::Session;

/// Largest width and height, points.
const SIZE: Vec2 = Vec2::new(170.0, 110.0);
/// Distance from the corner of the panel.
const GAP: f32 = 10.0;

/// Shows the map of nodes and frames. Returns the point to bring into the middle.
pub fn show(ui: &Ui, session: &Session, geometry: &Geometry) -> Option<Pos2> {
    let seen = Rect::from_min_max(
        geometry.to_window.inverse() * geometry.area.min,
        geometry.to_window.inverse() * geometry.area.max,
    );
    let nodes = || session.network().processors().filter_map(|p| Some((p.id(), *geometry.nodes.get(p.id())?)));
    let notes: Vec<Rect> = session.network().frames().iter().map(frames::rect).collect();
    let all = nodes().map(|(_, node)| node).chain(notes.iter().copied());
    let all = all.reduce(|all, next| all.union(next))?.expand(40.0);
    let scale = (SIZE / all.size()).min_elem();
    let place = geometry.area.left_bottom() + Vec2::new(GAP, -GAP);
    let map = Area::new(ui.id().with("minimap")).order(egui::Order::Middle).pivot(Align2::LEFT_BOTTOM).fixed_pos(place);
    let chosen = map.show(ui.ctx(), |ui| {
        let (area, response) = ui.allocate_exact_size(all.size() * scale, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "map of the network"));
        let to_map = |rect: Rect| {
            let at = |point: Pos2| area.min + (point - all.min) * scale;
            Rect::from_min_max(at(rect.min), at(rect.max))
        };
        let visuals = ui.visuals();
        ui.painter().rect_filled(area, 4.0, visuals.window_fill.gamma_multiply(0.92));
        let painter = ui.painter().with_clip_rect(area);
        let accent = visuals.selection.stroke.color;
        for note in &notes {
            painter.rect_filled(to_map(*note), 1.0, accent.gamma_multiply(0.16));
        }
        for (id, node) in nodes() {
            let color: Color32 = match session.selection.contains(id) {
                true => visuals.selection.stroke.color,
                false => visuals.weak_text_color(),
            };
            painter.rect_filled(to_map(node), 1.0, color);
        }
        let stroke = Stroke::new(1.0, visuals.selection.stroke.color);
        painter.rect_stroke(to_map(seen), 2.0, stroke, StrokeKind::Inside);
        ui.painter().rect_stroke(area, 4.0, visuals.widgets.noninteractive.bg_stroke, StrokeKind::Inside);
        let pointer = response.interact_pointer_pos().filter(|_| response.clicked() || response.dragged());
        pointer.map(|at| all.min + (at - area.min) / scale)
    });
    chosen.inner
}
