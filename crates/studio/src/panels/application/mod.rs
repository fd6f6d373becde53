//! The author's panel: which canvases and properties visualization mode shows, in which groups and order, under which labels
//! and ranges, and sets of values to choose from.

mod canvases;
mod groups;
mod list;
mod presets;

use egui::{Align, Key, Layout as Direction, RichText, ScrollArea, TextEdit, Ui};
use rayloom_network::{Address, Network};

use crate::session::{Mode, Session};
use crate::theme;
use crate::visualization::{Application, Change, refused};

/// What the panel remembers.
#[derive(Default)]
pub struct ApplicationPanel {
    revision: Option<u64>,
    application: Application,
    /// What in the file cannot be read.
    unreadable: Vec<String>,
    /// For each preset, the values that cannot be set, and why.
    refused: Vec<Vec<(Address, String)>>,
    /// The name of the next preset.
    name: String,
}

/// What the author did in this frame.
#[derive(Default)]
struct Done {
    changes: Vec<Change>,
    /// The preset to apply.
    chosen: Option<usize>,
    /// A new name and description of the network.
    described: Option<(String, String)>,
    preview: bool,
}

impl ApplicationPanel {
    /// Shows the application and lets its author change it.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        self.update(session);
        let mut done = Done::default();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin { left: 10, right: 12, top: 8, bottom: 12 }).show(ui, |ui| {
                ui.spacing_mut().item_spacing = egui::vec2(6.0, 4.0);
                self.contents(ui, session.network(), &mut done);
            });
        });
        self.carry_out(done, session);
    }

    /// Reads the application again when the network changed.
    fn update(&mut self, session: &Session) {
        let revision = session.document.revision();
        if self.revision != Some(revision) {
            self.revision = Some(revision);
            let network = session.network();
            (self.application, _) = Application::of(network);
            self.unreadable = Application::unreadable(network);
            self.refused = self.application.presets.iter().map(|preset| refused(preset, network)).collect();
        }
    }

    fn contents(&mut self, ui: &mut Ui, network: &Network, done: &mut Done) {
        let application = &self.application;
        ui.horizontal(|ui| {
            ui.weak("What users see in visualization mode");
            ui.with_layout(Direction::right_to_left(Align::Center), |ui| {
                let preview = ui.button("Preview").on_hover_text("Switches to visualization mode and back (F5)");
                done.preview |= preview.clicked();
            });
        });
        for problem in &self.unreadable {
            theme::colored(ui, theme::WARNING, problem).on_hover_text("The next change made here drops it.");
        }
        description(ui, network, done);
        canvases::show(ui, network, application, &mut done.changes);
        groups::show(ui, network, application, &mut done.changes);
        presets::show(ui, application, &self.refused, &mut self.name, done);
        lock(ui, application.locked, &mut done.changes);
    }

    fn carry_out(&mut self, done: Done, session: &mut Session) {
        done.changes.into_iter().for_each(|change| session.author(change));
        if let Some((name, description)) = done.described {
            let describe = |network: &mut Network| -> Result<(), std::convert::Infallible> {
                (network.name, network.description) = (name, description);
                Ok(())
            };
            let Ok(()) = session.document.edit_merged("describe the network", "description", describe);
        }
        if let Some(preset) = done.chosen.and_then(|index| self.application.presets.get(index)) {
            session.edit(&format!("preset {}", preset.name), |network| preset.apply(network));
        }
        if done.preview {
            session.mode = Mode::Visualization;
        }
    }
}

/// A heading with room for buttons at its right.
fn heading(ui: &mut Ui, text: &str, buttons: impl FnOnce(&mut Ui)) {
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new(text).size(11.5).weak());
        ui.with_layout(Direction::right_to_left(Align::Center), buttons);
    });
}

/// A line of text; the new text while it is typed.
fn line(ui: &mut Ui, label: &str, text: &str, hint: &str, width: f32) -> Option<String> {
    let mut typed = text.to_owned();
    let response = ui.add(TextEdit::singleline(&mut typed).hint_text(hint).desired_width(width));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(label));
    response.changed().then_some(typed)
}

/// A small button without a frame, with a name for those who do not see it.
fn mark(ui: &mut Ui, symbol: &str, label: &str) -> bool {
    let button = egui::Button::new(RichText::new(symbol).size(10.5)).frame_when_inactive(false);
    let response = ui.add(button);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, label));
    response.on_hover_text(label).clicked()
}

fn description(ui: &mut Ui, network: &Network, done: &mut Done) {
    heading(ui, "Title", |_| {});
    let name = line(ui, "Title of the application", &network.name, "Name of the network", f32::INFINITY);
    let mut text = network.description.clone();
    let edit = TextEdit::multiline(&mut text).hint_text("What it shows and what to do").desired_rows(2);
    let response = ui.add(edit.desired_width(f32::INFINITY));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label("Description of the application"));
    if name.is_some() || response.changed() {
        done.described = Some((name.unwrap_or_else(|| network.name.clone()), text));
    }
}

fn lock(ui: &mut Ui, locked: bool, changes: &mut Vec<Change>) {
    heading(ui, "Lock", |_| {});
    let mut on = locked;
    if ui.checkbox(&mut on, "Keep users in visualization mode").changed() {
        changes.push(Change::Lock(on));
    }
    let (color, text) = match locked {
        false => (ui.visuals().weak_text_color(), "F5 switches to the network and back."),
        true => (
            theme::WARNING,
            "Locked: once in visualization mode, F5 does not lead back to the network. To edit it again, open the file in \
             development mode: `rayloom open FILE --mode development`. The file itself is not protected.",
        ),
    };
    ui.colored_label(color, text);
}

/// Whether Enter was pressed in a text field that it left.
fn entered(ui: &Ui, response: &egui::Response) -> bool {
    response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter))
}
