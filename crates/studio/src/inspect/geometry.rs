//! What there is to see of a mesh: its wire frame.

use std::collections::BTreeMap;

use egui::{Color32, Pos2, Rect, Sense, Stroke, Vec2};
use glam::DVec3;
use rayloom_network::{Address, PortType};
use rayloom_processors::Mesh;

use super::text::number;
use crate::theme;

/// Size of the drawing, points.
const SIZE: Vec2 = Vec2::new(260.0, 220.0);
/// Edges drawn at most.
const EDGES: usize = 4000;
/// Where the wire frame is seen from: in front, to the right and above.
const FROM: DVec3 = DVec3::new(0.45, -0.8, 0.4);

/// An edge between two points of the drawing, and whether one of its triangles faces the viewer.
struct Edge {
    ends: [Vec2; 2],
    faces: bool,
}

/// Facts and the wire frame.
pub(super) fn show(ui: &mut egui::Ui, outport: &Address, mesh: &Mesh) {
    let closed = if mesh.closed { "closed" } else { "open" };
    ui.weak(format!("{} triangles · {} corners · {closed}", mesh.indices.len(), mesh.positions.len()));
    let (area, response) = ui.allocate_exact_size(SIZE, Sense::hover());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, format!("wire frame of {outport}")));
    ui.painter().rect_filled(area, 3.0, ui.visuals().extreme_bg_color);
    let edges = edges(mesh);
    let front = theme::port_color(PortType::Geometry);
    let back = Color32::from_gray(96).gamma_multiply(0.6);
    for faces in [false, true] {
        let stroke = Stroke::new(1.2, if faces { front } else { back });
        for edge in edges.iter().filter(|edge| edge.faces == faces) {
            ui.painter().line_segment(edge.ends.map(|end| place(area, end)), stroke);
        }
    }
    let extent = extent(mesh).map_or_else(
        || "nothing is left of it".into(),
        |size| format!("{} world units", size.to_array().map(number).join(" x ")),
    );
    ui.small(extent);
}

fn place(area: Rect, point: Vec2) -> Pos2 {
    area.center() + point * area.shrink(12.0).size().min_elem() * 0.5
}

/// World coordinates of the corners.
fn world(mesh: &Mesh) -> Vec<DVec3> {
    let to_world = mesh.volume.volume.texture_to_world();
    mesh.positions.iter().map(|&p| to_world.transform_point3(DVec3::from_array(p.map(f64::from)))).collect()
}

fn extent(mesh: &Mesh) -> Option<DVec3> {
    let points = world(mesh);
    let low = points.iter().copied().reduce(DVec3::min)?;
    Some(points.into_iter().reduce(DVec3::max)? - low)
}

/// The edges in a drawing that fills -1 to 1, x right and y down.
fn edges(mesh: &Mesh) -> Vec<Edge> {
    let points = world(mesh);
    let (Some(low), Some(high)) =
        (points.iter().copied().reduce(DVec3::min), points.iter().copied().reduce(DVec3::max))
    else {
        return Vec::new();
    };
    let toward = FROM.normalize();
    let right = DVec3::Z.cross(toward).normalize();
    let up = toward.cross(right);
    let scale = 2.0 / (high - low).length().max(f64::MIN_POSITIVE);
    let project = |point: DVec3| {
        let offset = (point - 0.5 * (low + high)) * scale;
        Vec2::new(offset.dot(right) as f32, -offset.dot(up) as f32)
    };
    let drawn: Vec<Vec2> = points.iter().map(|&point| project(point)).collect();
    // Volumes may be mirrored in the world: then the other side is the outside.
    let outward = mesh.volume.volume.texture_to_world().matrix3.determinant().signum();
    let mut faces: BTreeMap<[u32; 2], bool> = BTreeMap::new();
    for &[a, b, c] in mesh.indices.iter().take(EDGES) {
        let [p, q, r] = [a, b, c].map(|corner| points[corner as usize]);
        let facing = (q - p).cross(r - p).dot(toward) * outward > 0.0;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *faces.entry([from.min(to), from.max(to)]).or_default() |= facing;
        }
    }
    let edge = |(ends, faces): ([u32; 2], bool)| Edge { ends: ends.map(|end| drawn[end as usize]), faces };
    faces.into_iter().take(EDGES).map(edge).collect()
}
