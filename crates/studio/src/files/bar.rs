//! A calm bar across the window: something to decide that can wait.

use egui::{Align, Button, Frame, Layout, Margin, Panel, RichText, Ui};

/// Shows a sentence and what can be done about it; which of the actions was chosen. The first is the obvious one.
pub fn show(ui: &mut Ui, id: &str, text: &str, actions: &[&str]) -> Option<usize> {
    let mut chosen = None;
    let fill = ui.visuals().selection.bg_fill.gamma_multiply(0.45);
    let frame = Frame::new().fill(fill).inner_margin(Margin::symmetric(12, 6));
    Panel::top(id.to_owned()).frame(frame).show(ui, |ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            for (index, action) in actions.iter().enumerate().rev() {
                let label = if index == 0 { RichText::new(*action).strong() } else { RichText::new(*action) };
                if ui.add(Button::new(label).min_size(egui::vec2(76.0, 24.0))).clicked() {
                    chosen = Some(index);
                }
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(egui::Label::new(text).truncate());
            });
        });
    });
    chosen
}
