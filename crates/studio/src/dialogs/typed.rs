//! Asking for the path of a file in the window itself, where the system has no dialog.

use std::path::PathBuf;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use egui::{Align, Button, Context, Frame, Id, Key, Layout, Modal, RichText, TextEdit};

/// A path that is being typed.
struct Asked {
    heading: String,
    text: String,
    answer: Sender<Option<PathBuf>>,
}

/// The paths that are asked for, one after the other.
#[derive(Clone, Default)]
pub(crate) struct TypedPaths(Arc<Mutex<Vec<Asked>>>);

impl TypedPaths {
    /// Asks for a path, beginning with a text, and waits for it: not to be called on the window's thread.
    pub fn ask(&self, context: &Context, heading: String, text: String) -> Option<PathBuf> {
        let (answer, typed) = channel();
        self.asked().push(Asked { heading, text, answer });
        context.request_repaint();
        // A window that is closed answers nothing.
        typed.recv().ok().flatten()
    }

    /// Shows what is asked for, if anything.
    pub fn show(&self, context: &Context) {
        let mut all = self.asked();
        let Some(asked) = all.first_mut() else { return };
        let Some(answer) = show(context, asked) else { return };
        // Whoever asked may be gone.
        let _ = asked.answer.send(answer);
        all.remove(0);
    }

    fn asked(&self) -> MutexGuard<'_, Vec<Asked>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The path, or that there is none, once the user has decided.
fn show(context: &Context, asked: &mut Asked) -> Option<Option<PathBuf>> {
    let mut decided = None;
    let frame = Frame::popup(&context.global_style()).inner_margin(20.0);
    let modal = Modal::new(Id::new("path of a file")).frame(frame).show(context, |ui| {
        ui.set_width(520.0);
        ui.label(RichText::new(&asked.heading).heading());
        ui.add_space(4.0);
        ui.weak("This system has no dialog for files (neither a desktop portal nor zenity): type the path.");
        ui.add_space(10.0);
        let path = ui.add(TextEdit::singleline(&mut asked.text).desired_width(f32::INFINITY));
        ui.ctx().accesskit_node_builder(path.id, |node| node.set_label("Path of the file"));
        if !path.has_focus() && !path.lost_focus() {
            path.request_focus();
        }
        ui.add_space(14.0);
        let known = !asked.text.trim().is_empty();
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let size = egui::vec2(88.0, 28.0);
            let fill = ui.visuals().selection.bg_fill;
            let good = ui.add_enabled(known, Button::new(RichText::new("OK").strong()).min_size(size).fill(fill));
            if good.clicked() || (known && ui.input(|input| input.key_pressed(Key::Enter))) {
                decided = Some(Some(PathBuf::from(asked.text.trim())));
            }
            if ui.add(Button::new("Cancel").min_size(size)).clicked() {
                decided = Some(None);
            }
        });
    });
    decided.or_else(|| modal.should_close().then_some(None))
}
