//! What the user was told, newest first, and what is wrong now.

use crate::session::{Session, Severity};
use crate::theme;

/// Shows the messages.
pub fn show(ui: &mut egui::Ui, session: &mut Session) {
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(4.0);
        let report = &session.engine.results.report;
        for (id, error) in &report.failed {
            ui.colored_label(theme::ERROR, format!("{id}: {error}"));
        }
        for reason in report.not_ready.values().flatten() {
            ui.colored_label(theme::WARNING, reason);
        }
        for (id, run) in &session.engine.results.runs {
            for note in &run.notes {
                ui.label(format!("{id}: {note}"));
            }
        }
        for message in session.messages.iter().rev() {
            match message.severity {
                Severity::Error => ui.colored_label(theme::ERROR, &message.text),
                Severity::Note => ui.label(&message.text),
            };
        }
    });
}
