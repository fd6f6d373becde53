//! The text with colours and line numbers.

use egui::text::{CCursor, CCursorRange, CharIndex, LayoutJob, TextFormat};
use egui::{Color32, FontId, ScrollArea, Sense, TextEdit, Ui, Vec2};
use rayloom_wgsl::{Highlight, highlight};

use super::Problem;
use crate::theme;

/// Size of the letters.
const SIZE: f32 = 12.0;

/// Shows the text; whether the user changed it.
pub(in crate::panels) fn show(
    ui: &mut Ui,
    label: &str,
    text: &mut String,
    problems: &[&Problem],
    line: &mut u32,
    jump: Option<(u32, u32)>,
) -> bool {
    let font = FontId::monospace(SIZE);
    let mut changed = false;
    egui::Frame::new().fill(ui.visuals().extreme_bg_color).corner_radius(3).inner_margin(4).show(ui, |ui| {
        ScrollArea::both().id_salt(("code", label)).auto_shrink(false).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let gutter = numbers(ui, &font, text);
                // Lines are not wrapped: their numbers stand beside them.
                let mut layouter = |ui: &Ui, text: &dyn egui::TextBuffer, _: f32| {
                    let job = colored(text.as_str(), &font, ui.visuals().dark_mode);
                    ui.fonts_mut(|fonts| fonts.layout_job(job))
                };
                let edit = TextEdit::multiline(text)
                    .desired_width(f32::INFINITY)
                    // A click below the last line is meant for the text, too.
                    .min_size(ui.available_size())
                    .frame(egui::Frame::NONE)
                    .margin(egui::Margin::ZERO)
                    .lock_focus(true)
                    .layouter(&mut layouter);
                let output = edit.show(ui);
                let response = &output.response.response;
                ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(label));
                changed = response.changed();
                gutter.paint(ui, &font, problems);
                if let Some(cursor) = output.cursor_range {
                    *line = text.chars().take(cursor.primary.index.0).filter(|c| *c == '\n').count() as u32 + 1;
                }
                if let Some(place) = jump {
                    let mut state = output.state.clone();
                    let at = CCursor::new(CharIndex(character(text, place)));
                    state.cursor.set_char_range(Some(CCursorRange::one(at)));
                    state.store(ui.ctx(), response.id);
                    response.request_focus();
                    let top = output.galley_pos + Vec2::new(0.0, row_height(ui, &font) * (place.0 as f32 - 1.0));
                    ui.scroll_to_rect(egui::Rect::from_min_size(top, Vec2::splat(20.0)), Some(egui::Align::Center));
                }
            });
        });
    });
    changed
}

fn row_height(ui: &Ui, font: &FontId) -> f32 {
    ui.fonts_mut(|fonts| fonts.row_height(font))
}

/// The character at a line and column, both from 1.
fn character(text: &str, (line, column): (u32, u32)) -> usize {
    let before: usize = text.split('\n').take(line as usize - 1).map(|line| line.chars().count() + 1).sum();
    let length = text.split('\n').nth(line as usize - 1).map_or(0, |line| line.chars().count());
    (before + (column as usize - 1).min(length)).min(text.chars().count())
}

/// The column of line numbers: it has its place before the text, and stays in sight when that is scrolled sideways.
struct Gutter {
    area: egui::Rect,
    lines: u32,
}

/// Makes room for the numbers of lines.
fn numbers(ui: &mut Ui, font: &FontId, text: &str) -> Gutter {
    let lines = text.split('\n').count() as u32;
    let width = 5.0 * ui.fonts_mut(|fonts| fonts.glyph_width(font, '0'));
    let size = Vec2::new(width, row_height(ui, font) * lines as f32);
    Gutter { area: ui.allocate_exact_size(size, Sense::hover()).0, lines }
}

impl Gutter {
    /// Draws the numbers over the text; those of lines with problems marked, with the message on hover.
    fn paint(&self, ui: &Ui, font: &FontId, problems: &[&Problem]) {
        let row = row_height(ui, font);
        for problem in problems {
            let top = self.area.top() + row * (problem.line as f32 - 1.0);
            let band = egui::Rect::from_x_y_ranges(ui.clip_rect().x_range(), top..=top + row);
            ui.painter().rect_filled(band, 0.0, theme::ERROR.gamma_multiply(0.12));
        }
        let mut job = LayoutJob::default();
        for line in 1..=self.lines {
            let bad = problems.iter().any(|problem| problem.line == line);
            let color = if bad { theme::ERROR } else { ui.visuals().weak_text_color().gamma_multiply(0.6) };
            let mark = if bad { "●" } else { " " };
            job.append(&format!("{mark}{line:>3} \n"), 0.0, TextFormat::simple(font.clone(), color));
        }
        let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
        let left = self.area.left().max(ui.clip_rect().left());
        let area = egui::Rect::from_min_size(egui::pos2(left, self.area.top()), self.area.size());
        if left > self.area.left() {
            let behind = area.intersect(ui.clip_rect());
            ui.painter().rect_filled(behind, 0.0, ui.visuals().extreme_bg_color);
        }
        ui.painter().galley(area.min, galley, Color32::GRAY);
        let response = ui.interact(area, ui.id().with("line numbers"), Sense::hover());
        if let Some(pointer) = response.hover_pos() {
            let line = ((pointer.y - area.top()) / row) as u32 + 1;
            if let Some(problem) = problems.iter().find(|problem| problem.line == line) {
                response.on_hover_text(&problem.message);
            }
        }
    }
}

/// A text in the colours of its parts.
pub(super) fn colored(text: &str, font: &FontId, dark: bool) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    for (range, kind) in highlight(text) {
        job.append(&text[range], 0.0, TextFormat::simple(font.clone(), color(kind, dark)));
    }
    job
}

fn color(kind: Highlight, dark: bool) -> Color32 {
    let rgb = |dark_rgb: u32, light_rgb: u32| {
        let rgb = if dark { dark_rgb } else { light_rgb };
        Color32::from_rgb((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8)
    };
    match kind {
        Highlight::Comment => rgb(0x7b_828c, 0x80_8080),
        Highlight::Declaration => rgb(0x7f_a88a, 0x3f_7a50),
        Highlight::Directive => rgb(0xb0_8cc9, 0x7d_4ca3),
        Highlight::Keyword => rgb(0x6c_a6dc, 0x1f_62a8),
        Highlight::Type => rgb(0x5f_b3a8, 0x1d_7a70),
        Highlight::Function => rgb(0xd8_c08a, 0x85_6515),
        Highlight::Parameter => rgb(0xdd_9a6b, 0xa8_5a20),
        Highlight::Number => rgb(0xc3_a6d6, 0x7a_4ca0),
        Highlight::Plain => rgb(0xc8_ccd2, 0x30_3338),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_in_any_text() {
        let text = "é\n\nfn a\n";
        for (place, expected) in [((1, 1), 0), ((1, 9), 1), ((2, 1), 2), ((3, 4), 6), ((4, 1), 8), ((9, 9), 8)] {
            assert_eq!(character(text, place), expected, "{place:?}");
        }
    }
}
