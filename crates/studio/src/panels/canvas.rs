//! The picture of a canvas, and the camera in the user's hand.

use egui::{Color32, PointerButton, Pos2, Rect, Sense, Vec2};
use rayloom_network::{Camera, Network, PropertyKind, Value};

use crate::display::Look;
use crate::session::Session;
use crate::theme;

/// Radians that the camera turns while the pointer crosses the picture.
const TURN: f32 = std::f32::consts::PI;

/// What the panel remembers.
#[derive(Default)]
pub struct CanvasPanel {
    /// Id of the canvas shown; the first one when there is no such.
    canvas: Option<String>,
}

impl CanvasPanel {
    /// Shows the picture and lets the user move the camera behind it.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        let Some(canvas) = self.choose(ui, session) else {
            ui.centered_and_justified(|ui| ui.label("The network has no canvas."));
            return;
        };
        let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let scale = ui.ctx().pixels_per_point();
        let pixels = [area.width(), area.height()].map(|points| (points * scale).round().clamp(1.0, 8192.0) as u32);
        session.canvas_size = Some(pixels);
        ui.painter().rect_filled(area, 0.0, Color32::BLACK);
        self.picture(ui, area, &canvas, session);
        if let Some((processor, property, camera)) = camera_behind(session.network(), &canvas) {
            let moved = moved(ui, &response, area, &camera);
            session.interacting |= response.dragged();
            if let Some(camera) = moved {
                session.set(&processor, &property, Value::Camera(camera));
            }
        }
    }

    /// The canvas to show; a choice where there are several.
    fn choose(&mut self, ui: &mut egui::Ui, session: &Session) -> Option<String> {
        let ids: Vec<_> = canvases(session.network()).collect();
        if self.canvas.as_deref().is_none_or(|chosen| !ids.contains(&chosen)) {
            self.canvas = ids.first().map(|id| (*id).to_owned());
        }
        if ids.len() > 1 {
            ui.horizontal(|ui| {
                for id in &ids {
                    ui.selectable_value(&mut self.canvas, Some((*id).to_owned()), *id);
                }
            });
        }
        self.canvas.clone()
    }

    fn picture(&self, ui: &mut egui::Ui, area: Rect, canvas: &str, session: &mut Session) {
        let Some(image) = session.engine.results.canvases.get(canvas).cloned() else {
            let report = &session.engine.results.report;
            let why = report.not_ready.get(canvas).and_then(|reasons| reasons.first()).cloned();
            let text = why.unwrap_or_else(|| if session.engine.is_busy() { "...".into() } else { "no picture".into() });
            ui.painter().text(area.center(), egui::Align2::CENTER_CENTER, text, egui::FontId::proportional(14.0), Color32::GRAY);
            return;
        };
        match session.display.picture(&image, Look::default()) {
            Ok(texture) => {
                let [width, height] = image.size().map(|pixels| pixels as f32);
                let fit = (area.width() / width).min(area.height() / height);
                let shown = Rect::from_center_size(area.center(), Vec2::new(width, height) * fit);
                let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                ui.painter().image(texture, shown, whole, Color32::WHITE);
            }
            Err(error) => {
                ui.painter().text(
                    area.center(),
                    egui::Align2::CENTER_CENTER,
                    error.to_string(),
                    egui::FontId::proportional(14.0),
                    theme::ERROR,
                );
            }
        }
    }
}

/// Ids of the sinks that show an image.
fn canvases(network: &Network) -> impl Iterator<Item = &str> {
    network.processors().filter(|processor| processor.type_id() == "canvas").map(|processor| processor.id())
}

/// The camera nearest upstream of a processor: processor, property, value.
pub fn camera_behind(network: &Network, canvas: &str) -> Option<(String, String, Camera)> {
    let mut queue = std::collections::VecDeque::from([canvas.to_owned()]);
    let mut seen = std::collections::BTreeSet::new();
    while let Some(id) = queue.pop_front() {
        if !seen.insert(id.clone()) {
            continue;
        }
        let processor = network.processor(&id)?;
        let camera = processor.property_decls().into_iter().find(|property| property.kind == PropertyKind::Camera);
        if let Some(property) = camera
            && let Some(Value::Camera(camera)) = processor.value(&property.id)
        {
            return Some((id, property.id, camera));
        }
        queue.extend(network.inputs(&id).map(|connection| connection.from.processor.clone()));
    }
    None
}

/// The camera after what the user did in this frame, if anything: the left button turns, the middle one or Shift pans,
/// the wheel and the right one zoom.
fn moved(ui: &egui::Ui, response: &egui::Response, area: Rect, camera: &Camera) -> Option<Camera> {
    let mut after = *camera;
    let drag = response.drag_delta() / area.height().max(1.0);
    let (shift, scroll) = ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta.y));
    let height = visible_height(camera);
    if response.dragged_by(PointerButton::Middle) || (response.dragged_by(PointerButton::Primary) && shift) {
        after.pan(f64::from(-drag.x) * height, f64::from(drag.y) * height);
    } else if response.dragged_by(PointerButton::Primary) {
        after.orbit(f64::from(-drag.x * TURN), f64::from(drag.y * TURN));
    } else if response.dragged_by(PointerButton::Secondary) {
        after.zoom(f64::from(2.0 * drag.y).exp());
    }
    if response.hovered() && scroll != 0.0 {
        after.zoom(f64::from(-scroll * 0.003).exp());
    }
    (after != *camera && after.validate().is_ok()).then_some(after)
}

/// World height of the picture at the focus.
fn visible_height(camera: &Camera) -> f64 {
    match camera.projection {
        rayloom_network::Projection::Perspective { fov_degrees } => {
            2.0 * camera.distance() * (0.5 * fov_degrees.to_radians()).tan()
        }
        rayloom_network::Projection::Orthographic { height } => height,
    }
}
