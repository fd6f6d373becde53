//! What there is to see of an image.

use std::sync::Arc;

use egui::{Color32, Rect, Sense, Vec2};
use rayloom_gpu::GpuError;
use rayloom_network::{Address, ImageKind};
use rayloom_processors::Image;

use super::Statistics;
use super::text::{bytes, number};
use crate::display::{Layer, Look};
use crate::session::Session;
use crate::theme;

/// Largest sides of the picture, and of the small ones, points.
const LARGE: f32 = 224.0;
const SMALL: f32 = 108.0;

/// Side of a square of the checkerboard behind translucent colours, pixels.
pub(crate) const CHECKER: u32 = 8;

/// Names of the channels.
pub(crate) fn channel_names(kind: ImageKind) -> [&'static str; 4] {
    match kind {
        ImageKind::Color => ["red", "green", "blue", "alpha"],
        ImageKind::EntryPoints | ImageKind::ExitPoints => ["x", "y", "z", "hit"],
        ImageKind::Normals => ["x", "y", "z", "w"],
        _ => ["1", "2", "3", "4"],
    }
}

/// What a kind of image is called.
pub(crate) fn kind_name(kind: ImageKind) -> &'static str {
    match kind {
        ImageKind::Color => "colours",
        ImageKind::EntryPoints => "entry points",
        ImageKind::ExitPoints => "exit points",
        ImageKind::Depth => "depth",
        ImageKind::Normals => "normals",
        ImageKind::Data => "data",
    }
}

/// Pictures, facts and numbers, compact.
pub(super) fn show(ui: &mut egui::Ui, session: &mut Session, outport: &Address, image: &Arc<Image>) {
    let statistics = session.statistics(ui.ctx(), outport, image);
    let numbers = statistics.as_deref().and_then(|statistics| statistics.as_ref().ok());
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing = Vec2::splat(6.0);
        picture(ui, session, image, Look { checker: CHECKER, ..Look::default() }, Vec2::splat(LARGE));
        ui.vertical(|ui| {
            for (name, look) in small_looks(image, numbers) {
                picture(ui, session, image, look, Vec2::splat(SMALL));
                ui.small(name);
            }
        });
    });
    ui.add_space(2.0);
    facts(ui, image);
    match statistics.as_deref() {
        None => {
            ui.weak("counting...");
        }
        Some(Err(error)) => {
            theme::colored(ui, theme::ERROR, error.to_string());
        }
        Some(Ok(statistics)) => table(ui, image, statistics),
    }
}

/// What is shown beside the picture.
fn small_looks(image: &Image, statistics: Option<&Statistics>) -> Vec<(&'static str, Look)> {
    let mut looks = Vec::new();
    if image.kind == ImageKind::Color {
        looks.push(("alpha", Look { layer: Layer::Channel(3), ..Look::default() }));
    }
    if image.depth.is_some() {
        let look = Look { layer: Layer::Depth, range: depth_range(statistics), checker: CHECKER, ..Look::default() };
        looks.push(("depth, near is bright", look));
    }
    looks
}

/// The depths shown bright and dark: those that occur.
pub(crate) fn depth_range(statistics: Option<&Statistics>) -> Option<[f32; 2]> {
    // A little beyond the farthest, so that it still stands out from the background.
    statistics?.depth.map(|depth| [depth.min, depth.max + 0.1 * (depth.max - depth.min).max(1e-6)])
}

/// A picture of an image, fitted into a box; where it is.
pub(crate) fn picture(ui: &mut egui::Ui, session: &mut Session, image: &Arc<Image>, look: Look, room: Vec2) -> Rect {
    let [width, height] = image.size().map(|pixels| pixels as f32);
    let size = Vec2::new(width, height) * (room.x / width).min(room.y / height);
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    paint(ui, area, session.display.picture(image, look));
    area
}

/// Paints a picture, or why there is none.
pub(crate) fn paint(ui: &egui::Ui, area: Rect, picture: Result<egui::TextureId, GpuError>) {
    match picture {
        Ok(texture) => {
            let whole = Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
            ui.painter().image(texture, area, whole, Color32::WHITE);
        }
        Err(error) => {
            let font = egui::TextStyle::Small.resolve(ui.style());
            ui.painter().text(area.center(), egui::Align2::CENTER_CENTER, error.to_string(), font, theme::ERROR);
        }
    }
}

/// Size, kind, format, memory.
pub(crate) fn facts(ui: &mut egui::Ui, image: &Image) {
    let [width, height] = image.size();
    let memory = image.color.bytes() + image.depth.as_ref().map_or(0, |depth| depth.bytes());
    let format = |texture: &rayloom_gpu::Texture| format!("{:?}", texture.format).to_lowercase();
    let depth = image.depth.as_ref().map(|depth| format!(" + depth {}", format(depth))).unwrap_or_default();
    ui.weak(format!(
        "{width} x {height} · {} · {}{depth} · {}",
        kind_name(image.kind),
        format(&image.color),
        bytes(memory)
    ));
}

/// Numbers for each channel, and pixels that deserve a look.
pub(crate) fn table(ui: &mut egui::Ui, image: &Image, statistics: &Statistics) {
    let names = channel_names(image.kind);
    let rows = names.into_iter().zip(statistics.channels).chain([("depth", statistics.depth)]);
    egui::Grid::new("statistics").num_columns(4).spacing([14.0, 2.0]).show(ui, |ui| {
        for heading in ["", "min", "max", "mean"] {
            ui.weak(heading);
        }
        ui.end_row();
        for (name, channel) in rows.filter_map(|(name, channel)| Some((name, channel?))) {
            ui.label(name);
            for value in [f64::from(channel.min), f64::from(channel.max), channel.mean] {
                ui.monospace(number(value));
            }
            ui.end_row();
        }
    });
    if statistics.not_finite > 0 {
        theme::colored(ui, theme::ERROR, format!("{} pixels are NaN or infinite (magenta)", statistics.not_finite));
    }
    if statistics.out_of_range > 0 {
        theme::colored(ui, theme::WARNING, format!("{} pixels have values outside of 0 to 1", statistics.out_of_range));
    }
}
