//! What there is to see of a volume.

use std::sync::Arc;

use egui::{Color32, Pos2, Rect, Sense, TextureHandle, TextureOptions, Vec2};
use rayloom_processors::VolumeData;
use rayloom_volume::{Histogram, VolumeRole};

use super::digest::{Digest, Thumbnail};
use super::text::{bytes, number};
use crate::session::Session;
use crate::theme;

/// Shortest and longest side of the square for a thumbnail, points.
const SIDE: (f32, f32) = (72.0, 92.0);
/// Space between thumbnails, points.
const GAP: f32 = 6.0;
/// Height of the line below a thumbnail, points.
const NAME: f32 = 15.0;
/// Largest size of the histogram, points.
const HISTOGRAM: Vec2 = Vec2::new(386.0, 64.0);

/// Thumbnails, facts and a histogram, compact.
pub(super) fn show(ui: &mut egui::Ui, session: &mut Session, data: &Arc<VolumeData>) {
    let digest = session.digest(ui.ctx(), data);
    facts(ui, data);
    let Some(digest) = digest else {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.weak("looking at the voxels...");
        });
        return;
    };
    device_facts(ui, data, &digest);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = Vec2::splat(GAP);
        let textures = textures(ui, &digest);
        let side = (0.25 * (ui.available_width() - 3.0 * GAP)).floor().clamp(SIDE.0, SIDE.1);

        for (thumbnail, texture) in digest.thumbnails.iter().zip(textures) {
            // In one piece, so that those without room go to the next line.
            let (place, _) = ui.allocate_exact_size(Vec2::new(side, side + NAME), Sense::hover());
            let area = place.with_max_y(place.bottom() - NAME);
            let size = texture.size_vec2() * (side / texture.size_vec2().max_elem());
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            ui.painter().image(texture.id(), Rect::from_center_size(area.center(), size), whole, Color32::WHITE);
            let font = egui::TextStyle::Small.resolve(ui.style());
            let color = ui.visuals().text_color();
            ui.painter().text(place.center_bottom(), egui::Align2::CENTER_BOTTOM, thumbnail.name, font, color);
        }
    });
    histogram(ui, &digest.histogram);
}

/// The thumbnails as textures.
fn textures<'a>(ui: &egui::Ui, digest: &'a Digest) -> &'a [TextureHandle] {
    let load = |thumbnail: &Thumbnail| {
        ui.ctx().load_texture(thumbnail.name, thumbnail.picture.clone(), TextureOptions::LINEAR)
    };
    digest.textures.get_or_init(|| digest.thumbnails.iter().map(load).collect())
}

/// What is known without looking at the voxels.
fn facts(ui: &mut egui::Ui, data: &VolumeData) {
    let volume = &data.volume;
    let [x, y, z] = volume.dims;
    let channels = match (volume.role, volume.channels) {
        (VolumeRole::GradientAndValue, _) => " · gradients and values".to_owned(),
        (_, 1) => String::new(),
        (_, count) => format!(" · {count} channels"),
    };
    let spacing = volume.spacing().to_array().map(number).join(" x ");
    let memory = volume.voxels.len() as u64 * volume.voxels.element_type().size() as u64;
    ui.label(&volume.name);
    let kind = volume.voxels.element_type().id();
    ui.weak(format!("{x} x {y} x {z} · {kind}{channels} · spacing {spacing} · {}", bytes(memory)));
}

/// Range, and how the volume is held on the device.
fn device_facts(ui: &mut egui::Ui, data: &VolumeData, digest: &Digest) {
    let range = digest.ranges[digest.channel as usize];
    ui.weak(format!("values {} to {} · on the device: {}{}", number(range.min), number(range.max), digest.format, {
        if data.is_on_gpu() { "" } else { " (not there yet)" }
    }));
    if let Some(loss) = &digest.loss {
        theme::colored(ui, theme::WARNING, loss);
    }
    if digest.non_finite > 0 {
        theme::colored(ui, theme::ERROR, format!("{} voxels are NaN or infinite", digest.non_finite));
    }
}

/// Bars, logarithmic in the counts, and the ends of the range.
fn histogram(ui: &mut egui::Ui, histogram: &Histogram) {
    let size = HISTOGRAM.min(Vec2::new(ui.available_width(), HISTOGRAM.y));
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(area, 3.0, ui.visuals().extreme_bg_color);
    let height = |count: u64| (count as f64).ln_1p() as f32;
    let highest = histogram.counts.iter().map(|&count| height(count)).fold(f32::MIN_POSITIVE, f32::max);
    let width = area.width() / histogram.counts.len() as f32;
    let color = ui.visuals().weak_text_color();
    for (bin, &count) in histogram.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = area.left() + bin as f32 * width;
        let top = area.bottom() - height(count) / highest * (area.height() - 4.0);
        painter.rect_filled(
            Rect::from_min_max(Pos2::new(left, top), Pos2::new(left + width, area.bottom())),
            0.0,
            color,
        );
    }
    ui.horizontal(|ui| {
        ui.set_width(size.x);
        ui.small(number(histogram.range.min));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.small(format!("{} (counts logarithmic)", number(histogram.range.max)));
        });
    });
}
