//! The text of a slot: the chosen snippet's own, or the user's in its place, with what the compiler says about it.

use egui::{RichText, TextEdit, Ui};
use rayloom_network::{Address, PropertyDecl, PropertyKind, Value};
use rayloom_processors::snippet_library;
use rayloom_wgsl::Slot;

use super::action::Action;
use super::editor::Surroundings;
use crate::theme;

/// Rows of text shown at least and at most.
const ROWS: [usize; 2] = [6, 24];

/// A small button that opens and closes the text of a slot.
pub(super) fn toggle(ui: &mut Ui, decl: &PropertyDecl, width: f32, surroundings: &mut Surroundings<'_>) {
    let address = surroundings.address(decl);
    let edited = !applied(decl, surroundings).trim().is_empty();
    let open = surroundings.tools.opened.contains(&address);
    let color = match (edited, open) {
        (true, _) => theme::WARNING,
        (false, true) => ui.visuals().strong_text_color(),
        (false, false) => ui.visuals().weak_text_color(),
    };
    let button = egui::Button::new(RichText::new("{ }").monospace().size(10.5).color(color)).frame(false);
    let response = ui.add_sized([width, super::row::HEIGHT], button);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &decl.label));
    let help = if edited { "Your own text is used in place of the chosen snippet" } else { "Edit the snippet's text" };
    if response.on_hover_text(help).clicked() && !surroundings.tools.opened.remove(&address) {
        surroundings.tools.opened.insert(address);
    }
}

/// The text that is in use instead of the chosen snippet; empty when there is none.
fn applied<'a>(decl: &PropertyDecl, surroundings: &Surroundings<'a>) -> &'a str {
    surroundings.properties.text(&decl.id).unwrap_or_default()
}

/// Shows the text, if it is open.
pub(super) fn show(ui: &mut Ui, decl: &PropertyDecl, surroundings: &mut Surroundings<'_>) {
    let address = surroundings.address(decl);
    if !surroundings.tools.opened.contains(&address) {
        return;
    }
    let used = applied(decl, surroundings).to_owned();
    let source = if used.trim().is_empty() { snippet(decl, surroundings) } else { used.clone() };
    let mut text = surroundings.tools.drafts.get(&address).cloned().unwrap_or_else(|| source.clone());
    let problems = problems(&address, surroundings);
    egui::Frame::new().fill(ui.visuals().extreme_bg_color).corner_radius(3).inner_margin(4).show(ui, |ui| {
        code(ui, decl, &mut text, &problems);
        for (line, message) in &problems {
            ui.label(RichText::new(format!("line {line}: {message}")).size(11.5).color(theme::ERROR));
        }
        ui.horizontal(|ui| buttons(ui, &address, &used, &source, &mut text, surroundings));
    });
    match text == source {
        true => surroundings.tools.drafts.remove(&address),
        false => surroundings.tools.drafts.insert(address, text),
    };
}

fn buttons(
    ui: &mut Ui,
    address: &Address,
    used: &str,
    source: &str,
    text: &mut String,
    surroundings: &mut Surroundings<'_>,
) {
    let changed = *text != *source;
    let apply = ui.add_enabled(changed, egui::Button::new("Apply"));
    if apply.on_hover_text("Use this text in this processor; it is stored in the network").clicked() {
        surroundings.actions.push(Action::Set(address.clone(), Value::Text(text.clone())));
    }
    if ui.add_enabled(changed, egui::Button::new("Discard")).on_hover_text("Back to what is in use").clicked() {
        *text = source.to_owned();
    }
    let revert = ui.add_enabled(!used.is_empty(), egui::Button::new("Revert"));
    if revert.on_hover_text("Back to the chosen snippet").clicked() {
        surroundings.actions.push(Action::Set(address.clone(), Value::Text(String::new())));
        // What is shown next is the snippet.
        *text = source.to_owned();
    }
    if changed {
        ui.weak("not applied");
    }
}

/// The chosen snippet's text.
fn snippet(decl: &PropertyDecl, surroundings: &Surroundings<'_>) -> String {
    let (library, _) = snippet_library();
    let PropertyKind::ShaderText { slot } = &decl.kind else { return String::new() };
    let chosen = decl.id.split('.').next().and_then(|owner| surroundings.properties.text(owner).ok());
    let path = Slot::from_id(slot).zip(chosen).and_then(|(slot, id)| library.path(slot, id));
    path.and_then(|path| library.source(&path)).map(|source| source.text.to_string()).unwrap_or_default()
}

/// What the compiler says about this text: line and message.
fn problems(address: &Address, surroundings: &Surroundings<'_>) -> Vec<(u32, String)> {
    let owner = address.item.split('.').next().unwrap_or_default();
    let source = format!("edited/{owner}.wgsl");
    let marks = surroundings.failure.iter().flat_map(|failure| &failure.marks);
    marks.filter(|mark| mark.source == source).map(|mark| (mark.line, mark.message.clone())).collect()
}

/// The editor, with line numbers; lines with problems have theirs in red.
fn code(ui: &mut Ui, decl: &PropertyDecl, text: &mut String, problems: &[(u32, String)]) {
    let lines = text.lines().count().max(1);
    let rows = lines.clamp(ROWS[0], ROWS[1]);
    let font = egui::FontId::monospace(11.5);
    let row = ui.fonts_mut(|fonts| fonts.row_height(&font));
    let height = row * rows as f32 + 12.0;
    egui::ScrollArea::vertical().id_salt("code").max_height(height).show(ui, |ui| {
        ui.horizontal_top(|ui| {
            ui.label(line_numbers(ui, &font, lines as u32, problems));
            egui::ScrollArea::horizontal().id_salt("lines").show(ui, |ui| {
                let edit = TextEdit::multiline(text).desired_rows(rows).desired_width(f32::INFINITY);
                // Lines are not wrapped: their numbers stand beside them.
                let mut layouter = |ui: &Ui, text: &dyn egui::TextBuffer, _: f32| {
                    let (font, color) = (font.clone(), ui.visuals().text_color());
                    let job = egui::text::LayoutJob::simple(text.as_str().to_owned(), font, color, f32::INFINITY);
                    ui.fonts_mut(|fonts| fonts.layout_job(job))
                };
                let edit = edit.frame(egui::Frame::NONE).margin(egui::Margin::ZERO).lock_focus(true);
                let response = ui.add(edit.layouter(&mut layouter));
                ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(decl.label.as_str()));
            });
        });
    });
}

/// The numbers of lines; those with problems in red.
fn line_numbers(ui: &Ui, font: &egui::FontId, lines: u32, problems: &[(u32, String)]) -> egui::text::LayoutJob {
    let mut numbers = egui::text::LayoutJob::default();
    for line in 1..=lines {
        let bad = problems.iter().any(|(bad, _)| *bad == line);
        let color = if bad { theme::ERROR } else { ui.visuals().weak_text_color().gamma_multiply(0.6) };
        numbers.append(&format!("{line:>3}\n"), 0.0, egui::TextFormat::simple(font.clone(), color));
    }
    numbers
}
