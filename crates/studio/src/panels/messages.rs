//! What the user was told, newest first, and what is wrong now.

use crate::session::{Session, Severity};
use crate::theme;

/// Shows the messages.
pub fn show(ui: &mut egui::Ui, session: &mut Session) {
    let margin = egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4));
    let shown = |ui: &mut egui::Ui| {
        let report = &session.engine.results.report;
        for (id, error) in &report.failed {
            theme::report(ui, theme::ERROR, &format!("{id}: {error}"));
        }
        for reason in crate::panels::causes(report) {
            theme::colored(ui, theme::WARNING, reason);
        }
        for (id, run) in &session.engine.results.runs {
            for note in &run.notes {
                ui.label(format!("{id}: {note}"));
            }
        }
        for message in session.messages.iter().rev() {
            match message.severity {
                Severity::Error => theme::report(ui, theme::ERROR, &message.text),
                Severity::Note => ui.label(&message.text),
            };
        }
    };
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| margin.show(ui, shown));
}
