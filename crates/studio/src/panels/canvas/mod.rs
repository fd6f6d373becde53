//! The picture of a canvas, and what the pointer and keys do in it.

mod camera;
mod cube;
mod slice;
mod status;
mod walk;

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Rect, Sense, Vec2};
use rayloom_network::{Network, PropertyKind, Value};
use rayloom_processors::Image;
use rayloom_processors::types::{CANVAS, SLICE_VIEW};

use super::probe;
use crate::display::Look;
use crate::inspect::image::paint;
use crate::session::Session;
use crate::wiring::feeds;
use camera::Held;

/// What keys and the pointer do, for the list of keys.
pub const GESTURES: &[(&str, &str)] = &[
    ("Drag", "turn; slices: place the crosshair"),
    ("Shift or middle drag", "move"),
    ("Right drag", "zoom"),
    ("Wheel, pinch", "zoom to the pointer"),
    ("Wheel on a slice", "to the next; with Ctrl: zoom to the pointer"),
    ("Two fingers", "move, zoom and roll"),
    ("Double click", "centre on the surface"),
    ("Right click", "these as a menu"),
    ("Ctrl and click", "ray probe: follow the ray of a pixel"),
    ("A, Home", "show everything"),
    ("O", "orthographic or perspective"),
    ("1, 3, 7", "from the front, the right, above"),
    ("Q, E", "roll"),
    ("Arrows", "turn by 15 degrees"),
    ("V, I", "orientation cube, inertia: on or off"),
    ("W", "walk; Esc ends"),
    ("Walking", "W A S D, Q down, E up, Shift runs"),
];

/// What the panel remembers.
#[derive(Default)]
pub struct CanvasPanel {
    /// Id of the canvas shown; the first one when there is no such.
    canvas: Option<String>,
    camera: Held,
}

/// What the user moves in a canvas.
enum Behind {
    /// A camera: processor, property.
    Camera(String, String),
    /// A slice view.
    Slice(String),
}

impl CanvasPanel {
    /// Shows the picture of the chosen canvas and lets the user move the camera behind it.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        let Some(canvas) = self.choose(ui, session) else {
            ui.centered_and_justified(|ui| ui.label("The network has no canvas."));
            return;
        };
        self.show_one(ui, session, &canvas);
    }

    /// Shows the picture of a canvas in all of the space.
    pub fn show_one(&mut self, ui: &mut egui::Ui, session: &mut Session, canvas: &str) {
        let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, format!("canvas {canvas}")));
        let scale = ui.ctx().pixels_per_point();
        let pixels = [area.width(), area.height()].map(|points| (points * scale).round().clamp(1.0, 8192.0) as u32);
        // A canvas in two places gets the picture of the larger one.
        let size = session.shown.entry(canvas.to_owned()).or_insert(pixels);
        *size = [size[0].max(pixels[0]), size[1].max(pixels[1])];
        ui.painter().rect_filled(area, 0.0, Color32::BLACK);
        let Some(image) = session.engine.results.canvases.get(canvas).cloned() else {
            absent(ui, area, session, canvas);
            return;
        };
        let behind = behind(session.network(), canvas);
        let shown = match behind {
            Some(Behind::Camera(..)) => of_height(area, &image),
            _ => fitted(area, &image),
        };
        // An older picture may be wider than the canvas is now.
        let around = ui.clip_rect();
        ui.set_clip_rect(area.intersect(around));
        paint(ui, shown, session.display.picture(&image, Look::default()));
        status::show(ui, area, session, canvas);
        let shown = shown.intersect(area);
        match behind {
            Some(Behind::Camera(processor, property)) => {
                self.camera.interact(ui, &response, shown, &image, session, [canvas, &processor, &property]);
            }
            Some(Behind::Slice(processor)) => slice::interact(ui, &response, shown, session, &processor),
            None => {}
        }
        if let Some((id, unfinished)) = session.engine.refining()
            && feeds(session.network(), id, canvas)
        {
            let at = shown.left_top() + Vec2::splat(8.0);
            let text = format!("refining, {:.0} %", (100.0 * unfinished.share).floor());
            let color = Color32::from_white_alpha(180);
            ui.painter().text(at, Align2::LEFT_TOP, text, FontId::proportional(12.0), color);
        }
        if let Some(hint) = self.camera.hint() {
            let at = shown.center_bottom() - Vec2::new(0.0, 16.0);
            let font = FontId::proportional(13.0);
            ui.painter().text(at, Align2::CENTER_BOTTOM, hint, font, Color32::from_white_alpha(220));
        }
        probe::pick(ui, &response, shown, session, canvas, canvas);
        ui.set_clip_rect(around);
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
                    let label = session.network().processor(id).and_then(|canvas| canvas.label());
                    ui.selectable_value(&mut self.canvas, Some((*id).to_owned()), label.unwrap_or(id));
                }
            });
        }
        self.canvas.clone()
    }
}

/// The largest place for an image.
fn fitted(area: Rect, image: &Arc<Image>) -> Rect {
    let size = Vec2::from(image.size().map(|pixels| pixels as f32));
    Rect::from_center_size(area.center(), size * (area.width() / size.x).min(area.height() / size.y))
}

/// The place for an image of a camera: as high as the canvas. A picture of other proportions, from before the canvas changed
/// its size, shows things where they will be in the next one.
fn of_height(area: Rect, image: &Arc<Image>) -> Rect {
    let [width, height] = image.size().map(|pixels| pixels as f32);
    let exact = area.height() * width / height;
    // What rounding to whole pixels and coarser pictures change is no other proportion.
    let same = (exact - area.width()).abs() <= area.height() / height * 1.5;
    Rect::from_center_size(area.center(), Vec2::new(if same { area.width() } else { exact }, area.height()))
}

/// Says why there is no picture.
fn absent(ui: &egui::Ui, area: Rect, session: &Session, canvas: &str) {
    let report = &session.engine.results.report;
    let text = match report.not_ready.get(canvas).and_then(|reasons| reasons.first()) {
        Some(reason) => reason.clone(),
        None if session.engine.is_busy() => "...".into(),
        None => "no picture".into(),
    };
    let galley = ui.painter().layout(text, FontId::proportional(14.0), Color32::GRAY, area.width() - 24.0);
    ui.painter().galley(area.center() - 0.5 * galley.size(), galley, Color32::GRAY);
    if session.engine.is_busy() {
        status::show(ui, area, session, canvas);
    }
}

/// Ids of the sinks that show an image.
fn canvases(network: &Network) -> impl Iterator<Item = &str> {
    network.processors().filter(|processor| processor.type_id() == CANVAS).map(|processor| processor.id())
}

/// The camera or slice nearest upstream of a canvas.
fn behind(network: &Network, canvas: &str) -> Option<Behind> {
    let mut queue = std::collections::VecDeque::from([canvas.to_owned()]);
    let mut seen = std::collections::BTreeSet::new();
    while let Some(id) = queue.pop_front() {
        if !seen.insert(id.clone()) {
            continue;
        }
        let processor = network.processor(&id)?;
        if processor.type_id() == SLICE_VIEW {
            return Some(Behind::Slice(id));
        }
        let declared = processor.declaration().into_iter().flat_map(|declaration| &declaration.properties);
        if let Some(property) = declared.into_iter().find(|property| property.kind == PropertyKind::Camera) {
            return Some(Behind::Camera(id, property.id.clone()));
        }
        queue.extend(network.inputs(&id).map(|connection| connection.from.processor.clone()));
    }
    None
}

/// A number that a processor has.
fn number(network: &Network, processor: &str, property: &str) -> Option<f64> {
    match network.value(processor, property)? {
        Value::Float(number) => Some(number),
        _ => None,
    }
}
