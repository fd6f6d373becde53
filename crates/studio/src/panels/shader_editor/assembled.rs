//! The assembled shader, read-only: where every line comes from, by colour.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{Color32, FontId, RichText, ScrollArea, Sense, Ui, Vec2};
use rayloom_wgsl::Assembled;

use super::code::colored;

/// Size of the letters.
const SIZE: f32 = 11.0;
/// Width of the band that tells the origin.
const BAND: f32 = 5.0;

/// Shows the shader; the line that came from `line` of the file `path` is in sight and marked.
pub(super) fn show(ui: &mut Ui, assembled: &Assembled, path: &str, line: u32) {
    let colors = colors(assembled);
    legend(ui, &colors, path);
    let origins = assembled.map.lines();
    let marked = origins.iter().position(|origin| &*origin.file == path && origin.line == line);
    let lines: Vec<&str> = assembled.text.lines().collect();
    let font = FontId::monospace(SIZE);
    let height = ui.fonts_mut(|fonts| fonts.row_height(&font));
    let spacing = ui.spacing().item_spacing.y;
    let remembered = ui.id().with("shown line");
    let mut area = ScrollArea::both().id_salt("assembled").auto_shrink(false);
    // Follow the cursor, but leave the user alone who scrolls while it rests.
    let before: Option<usize> = ui.data(|data| data.get_temp(remembered));
    if let Some(marked) = marked.filter(|marked| before != Some(*marked)) {
        let middle = marked as f32 * (height + spacing) - 0.4 * ui.available_height();
        area = area.vertical_scroll_offset(middle.max(0.0));
        ui.data_mut(|data| data.insert_temp(remembered, marked));
    }
    area.show_rows(ui, height, lines.len(), |ui, rows| {
        for row in rows {
            let origin = &origins[row];
            let color = colors.get(&origin.file).copied().unwrap_or(Color32::GRAY);
            let job = colored(lines[row], &font, ui.visuals().dark_mode);
            let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
            let size = Vec2::new((galley.size().x + BAND + 8.0).max(ui.available_width()), height);
            let (area, response) = ui.allocate_exact_size(size, Sense::hover());
            let fill = if marked == Some(row) { 0.32 } else { 0.07 };
            ui.painter().rect_filled(area.expand2(Vec2::new(0.0, 0.5 * spacing)), 0.0, color.gamma_multiply(fill));
            let band = area.with_max_x(area.left() + BAND).expand2(Vec2::new(0.0, 0.5 * spacing));
            ui.painter().rect_filled(band, 0.0, color);
            ui.painter().galley(area.min + Vec2::new(BAND + 5.0, 0.0), galley, color);
            response.on_hover_text(format!("{}:{}", origin.file, origin.line));
        }
    });
}

/// A colour for every file, in the order of their lines.
fn colors(assembled: &Assembled) -> BTreeMap<Arc<str>, Color32> {
    let mut colors = BTreeMap::new();
    for origin in assembled.map.lines() {
        let next = colors.len();
        colors.entry(origin.file.clone()).or_insert_with(|| {
            // The golden angle keeps neighbours apart.
            let hue = (next as f32 * 0.618_034).fract();
            egui::ecolor::Hsva::new(hue, 0.5, 0.75, 1.0).into()
        });
    }
    colors
}

/// The files with their colours, when they are asked for: there are many.
fn legend(ui: &mut Ui, colors: &BTreeMap<Arc<str>, Color32>, path: &str) {
    let title = RichText::new(format!("{} files", colors.len())).size(11.0);
    egui::CollapsingHeader::new(title).id_salt("files").show(ui, |ui| files(ui, colors, path));
}

/// The one being edited first and strong.
fn files(ui: &mut Ui, colors: &BTreeMap<Arc<str>, Color32>, path: &str) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = Vec2::new(2.0, 1.0);
        ui.spacing_mut().interact_size.y = 0.0;
        let (own, others): (Vec<_>, Vec<_>) = colors.iter().partition(|(file, _)| &***file == path);
        for (file, color) in own.into_iter().chain(others) {
            let font = FontId::proportional(10.0);
            let is_own = &**file == path;
            let ink = if is_own { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
            let name = ui.painter().layout_no_wrap(file.to_string(), font, ink);
            // Mark and name in one piece, so that a line never ends between them.
            let (area, _) = ui.allocate_exact_size(name.size() + Vec2::new(18.0, 0.0), Sense::hover());
            let dot = egui::Rect::from_center_size(area.left_center() + Vec2::new(4.0, 0.0), Vec2::splat(7.0));
            ui.painter().rect_filled(dot, 1.0, *color);
            ui.painter().galley(area.min + Vec2::new(11.0, 0.0), name, ink);
        }
    });
}
