//! The orientation cube in the corner of a canvas: how the world lies, and a click on a side looks from there.

use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Stroke, Vec2, WidgetInfo, WidgetType};
use glam::DVec3;
use rayloom_network::Camera;

use crate::views::{VIEWS, View};

/// Half of an edge of the cube, points.
const HALF: f32 = 22.0;
/// From the corner of the picture to the middle of the cube.
const MARGIN: f32 = 48.0;
/// Pictures with shorter sides have no room for it.
const LEAST: f32 = 200.0;

/// Draws the cube and returns the camera that a click asks for.
pub(super) fn show(ui: &egui::Ui, area: Rect, canvas: &str, camera: &Camera) -> Option<Camera> {
    if area.size().min_elem() < LEAST {
        return None;
    }
    let middle = area.right_top() + Vec2::new(-MARGIN, MARGIN);
    let room = Rect::from_center_size(middle, Vec2::splat(3.4 * HALF));
    let response = ui.interact(room, ui.id().with(("orientation cube", canvas)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("orientation cube {canvas}")));
    let painter = ui.painter().with_clip_rect(area);
    let mut chosen = None;
    for view in &VIEWS {
        let Some(side) = Side::of(view, camera, middle) else { continue };
        let hovered = response.hover_pos().is_some_and(|pointer| side.contains(pointer));
        let fill = match hovered {
            true => Color32::from_rgba_unmultiplied(120, 170, 220, 210),
            false => Color32::from_rgba_unmultiplied(70, 76, 86, 120 + (90.0 * side.facing) as u8),
        };
        let edge = Stroke::new(1.0, Color32::from_white_alpha(110));
        painter.add(egui::Shape::convex_polygon(side.corners.to_vec(), fill, edge));
        if side.facing > 0.5 {
            let font = FontId::proportional(10.5);
            painter.text(side.middle, Align2::CENTER_CENTER, view.name, font, Color32::from_white_alpha(230));
        }
        if hovered && response.clicked() {
            chosen = Some(view.of(camera));
        }
    }
    response.on_hover_text("Look from a side (V hides this)");
    chosen
}

/// A side of the cube that faces the eye, on the screen.
struct Side {
    corners: [Pos2; 4],
    middle: Pos2,
    /// The cosine between its direction and that to the eye.
    facing: f32,
}

impl Side {
    fn of(view: &View, camera: &Camera, middle: Pos2) -> Option<Self> {
        let [right, up, forward] = camera.basis();
        let normal = DVec3::from(view.towards);
        let facing = -normal.dot(forward) as f32;
        if facing <= 0.02 {
            return None;
        }
        let at = |point: DVec3| middle + HALF * Vec2::new(point.dot(right) as f32, -point.dot(up) as f32);
        let first = DVec3::from(view.up);
        let second = normal.cross(first);
        let corners = [first + second, first - second, -first - second, -first + second];
        Some(Self { corners: corners.map(|corner| at(normal + corner)), middle: at(normal), facing })
    }

    /// Whether a point of the screen is on it: on one side of all edges.
    fn contains(&self, point: Pos2) -> bool {
        let turns = (0..4).map(|index| {
            let (from, to) = (self.corners[index], self.corners[(index + 1) % 4]);
            let (edge, way) = (to - from, point - from);
            edge.x * way.y - edge.y * way.x
        });
        let (left, right) = turns.partition::<Vec<_>, _>(|turn| *turn > 0.0);
        left.is_empty() || right.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_that_faces_the_eye_is_under_the_middle_and_the_far_ones_are_not_there() {
        let camera = Camera { position: [-260.0, 330.0, 250.0], ..Camera::default() };
        let middle = Pos2::new(100.0, 100.0);
        let sides: Vec<_> =
            VIEWS.iter().filter_map(|view| Some((view.name, Side::of(view, &camera, middle)?))).collect();
        assert_eq!(sides.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["Front", "Left", "Top"]);
        for (name, side) in &sides {
            assert!(side.contains(side.middle), "{name}");
            assert!(sides.iter().all(|(other, another)| other == name || !another.contains(side.middle)), "{name}");
        }
    }
}
