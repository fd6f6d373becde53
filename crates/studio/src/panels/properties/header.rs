//! What a processor is and how it fares.

use egui::{Color32, RichText, TextEdit, Ui};

use super::action::Action;
use crate::session::Session;
use crate::theme;

/// Name, type, help and state of a processor.
pub(super) fn show(ui: &mut Ui, session: &Session, id: &str, actions: &mut Vec<Action>) {
    let Some(processor) = session.network().processor(id) else { return };
    name(ui, id, processor.label(), actions);
    ui.horizontal(|ui| {
        let declaration = processor.declaration();
        let kind = declaration.map_or(processor.type_id(), |declaration| &declaration.label);
        let response = ui.label(RichText::new(kind).weak());
        if let Some(declaration) = declaration {
            response.on_hover_text(&declaration.help);
            help_mark(ui, &declaration.help);
        }
        identity(ui, id, actions);
    });
    state(ui, session, id);
    if processor.is_placeholder() {
        ui.colored_label(
            theme::WARNING,
            "This type of processor is not known here. What the file says about it is kept.",
        );
    }
    ui.add_space(2.0);
}

/// The name, to be edited in place.
fn name(ui: &mut Ui, id: &str, label: Option<&str>, actions: &mut Vec<Action>) {
    let look = (egui::FontId::proportional(17.0), ui.visuals().strong_text_color());
    let named = in_place(ui, "name", "Click to rename", label.unwrap_or(id), look);
    actions.extend(named.map(|name| Action::Name(id.to_owned(), name)));
}

/// The id, to be edited in place.
fn identity(ui: &mut Ui, id: &str, actions: &mut Vec<Action>) {
    let look = (egui::FontId::monospace(11.0), ui.visuals().weak_text_color());
    let help = "Its id, as `--set` takes it and files store it; click to change it";
    let renamed = in_place(ui, "id", help, id, look);
    actions.extend(renamed.map(|new| Action::Rename(id.to_owned(), new.trim().to_owned())));
}

/// A text that looks like a label until it is clicked; the new text when it was changed and left, but not by Escape.
fn in_place(
    ui: &mut Ui,
    what: &str,
    help: &str,
    shown: &str,
    (font, color): (egui::FontId, Color32),
) -> Option<String> {
    let key = ui.make_persistent_id(what);
    let mut text = ui.data(|data| data.get_temp::<String>(key)).unwrap_or_else(|| shown.to_owned());
    let edit = TextEdit::singleline(&mut text).id(key.with("edit")).frame(egui::Frame::NONE).margin(egui::Margin::ZERO);
    let edit = edit.font(font).text_color(color).desired_width(f32::INFINITY);
    let response = ui.add(edit).on_hover_text(help);
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(format!("{what} of the processor")));
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(key, text));
        return None;
    }
    ui.data_mut(|data| data.remove::<String>(key));
    let left = response.lost_focus() && !ui.input(|input| input.key_pressed(egui::Key::Escape));
    (left && text != shown).then_some(text)
}

fn help_mark(ui: &mut Ui, help: &str) {
    if help.is_empty() {
        return;
    }
    ui.label(RichText::new("ℹ").weak()).on_hover_text(help);
}

/// One line: what happens, or what is wrong.
fn state(ui: &mut Ui, session: &Session, id: &str) {
    let results = &session.engine.results;
    if let Some(error) = results.report.failed.get(id) {
        line(ui, theme::ERROR, &error.to_string());
        return;
    }
    if let Some(reasons) = results.report.not_ready.get(id) {
        for reason in reasons {
            line(ui, theme::WARNING, reason);
        }
        return;
    }
    if let Some(progress) = session.engine.progress.get(id) {
        line(ui, theme::WARNING, &format!("running, {} %", 100 * progress.done / progress.total.max(1)));
        return;
    }
    match results.runs.get(id) {
        Some(run) => {
            let milliseconds = |time: std::time::Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
            let gpu = run.gpu.map(|time| format!(", {} on the GPU", milliseconds(time))).unwrap_or_default();
            let response = line(ui, theme::READY, &format!("ready, took {}{gpu}", milliseconds(run.cpu)));
            response.on_hover_text(format!("It last ran because: {}.", run.why()));
            for note in &run.notes {
                line(ui, theme::READY, note);
            }
        }
        None => {
            line(ui, ui.visuals().weak_text_color(), "has not run: nothing shows what it makes");
        }
    }
}

fn line(ui: &mut Ui, color: Color32, text: &str) -> egui::Response {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let (dot, _) = ui.allocate_exact_size(egui::vec2(8.0, 12.0), egui::Sense::hover());
        ui.painter().circle_filled(dot.center() + egui::vec2(0.0, 1.0), 3.5, color);
        ui.label(RichText::new(text).size(12.0))
    })
    .inner
}
