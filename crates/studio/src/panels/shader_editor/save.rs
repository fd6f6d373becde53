//! Keeping a text as a snippet of one's own.

use egui::{Button, TextEdit, Ui};
use rayloom_network::{Address, EditError, Network};
use rayloom_processors::save_user_snippet;
use serde_json::json;

use super::Place;
use crate::session::{Session, Severity};
use crate::task::Task;

/// The name being entered, and the file being written.
#[derive(Default)]
pub(super) struct Saving {
    name: Option<String>,
    writing: Option<(String, Task<Result<std::path::PathBuf, String>>)>,
}

impl Saving {
    /// Opens and closes the row that asks for the name.
    pub(super) fn button(&mut self, ui: &mut Ui, place: &Place) {
        let help = "Keep this text as a snippet of your own, to be chosen in every network";
        if ui.add(Button::new("Save as...").selected(self.name.is_some())).on_hover_text(help).clicked() {
            let own = place.path.strip_prefix("user/").and_then(|file| file.strip_suffix(".wgsl"));
            self.name = match self.name {
                Some(_) => None,
                None => Some(own.map_or_else(|| format!("my_{}", place.chooser), str::to_owned)),
            };
        }
    }

    /// Asks for the name; once the file is written, the processor uses it.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &mut Session, address: &Address, place: &Place, text: &str) {
        if let Some(name) = &mut self.name {
            let mut chosen = false;
            let mut closed = false;
            ui.horizontal(|ui| {
                ui.label("Name");
                let field = ui.add(TextEdit::singleline(name).desired_width(160.0));
                ui.ctx().accesskit_node_builder(field.id, |node| node.set_label("Name of the snippet"));
                let entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
                chosen = ui.button("Save").clicked() || entered;
                closed = ui.button("Cancel").clicked();
            });
            if chosen {
                let (name, text, slot) = (name.clone(), text.to_owned(), place.slot);
                let file = name.clone();
                let write = move |_: &crate::task::Control| save_user_snippet(slot, &file, &text);
                self.writing = Some((name, Task::start(ui.ctx(), write)));
            }
            if chosen || closed {
                self.name = None;
            }
        }
        let Some((name, task)) = &mut self.writing else { return };
        match task.take() {
            Some(Ok(path)) => {
                session.tell(Severity::Note, format!("saved {}", path.display()));
                let choose = |network: &mut Network| -> Result<(), EditError> {
                    network.set_from_json(&address.processor, &address.item, &json!(""))?;
                    network.set_from_json(&address.processor, &place.chooser, &json!(name)).map(|_| ())
                };
                session.edit("use saved snippet", choose);
                self.writing = None;
            }
            Some(Err(message)) => {
                session.tell(Severity::Error, message);
                self.writing = None;
            }
            None if !task.is_running() => self.writing = None,
            None => {}
        }
    }
}
