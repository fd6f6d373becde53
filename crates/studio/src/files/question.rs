//! The question what becomes of changes that are not saved.

use egui::{Align, Button, Context, Frame, Id, Key, Layout, Modal, RichText};

/// What the user decided.
pub enum Decision {
    /// Save, then go on.
    Save,
    /// Go on without the changes.
    Discard,
    /// Stay.
    Cancel,
}

/// Asks about the changes of a document before going on; the answer once there is one. Enter saves only where the document is
/// being made: users of an application did not come to write over it.
pub fn show(context: &Context, document: &str, before: &str, enter_saves: bool) -> Option<Decision> {
    let mut decision = None;
    let frame = Frame::popup(&context.global_style()).inner_margin(20.0);
    let modal = Modal::new(Id::new("unsaved changes")).frame(frame).show(context, |ui| {
        ui.set_width(400.0);
        ui.label(RichText::new(format!("Save the changes of {document}?")).heading());
        ui.add_space(4.0);
        ui.weak(format!("They would be lost by {before}."));
        ui.add_space(18.0);
        let size = egui::vec2(88.0, 28.0);
        ui.horizontal(|ui| {
            if ui.add(Button::new("Discard").min_size(size)).clicked() {
                decision = Some(Decision::Discard);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let fill = ui.visuals().selection.bg_fill;
                let save = ui.add(Button::new(RichText::new("Save").strong()).min_size(size).fill(fill));
                if save.clicked() || (enter_saves && ui.input(|input| input.key_pressed(Key::Enter))) {
                    decision = Some(Decision::Save);
                }
                if ui.add(Button::new("Cancel").min_size(size)).clicked() {
                    decision = Some(Decision::Cancel);
                }
            });
        });
    });
    decision.or_else(|| modal.should_close().then_some(Decision::Cancel))
}
