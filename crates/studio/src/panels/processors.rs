//! The list of processors: search, click to add, drag onto the canvas or a wire.

use egui::{RichText, ScrollArea, Sense, TextEdit, Ui};
use rayloom_network::Declaration;

use crate::catalog::{NewProcessor, search};
use crate::session::Session;
use crate::theme;

/// What the list remembers.
#[derive(Default)]
pub struct ProcessorsPanel {
    search: String,
}

impl ProcessorsPanel {
    /// Shows the list. Returns the id of the type that was clicked.
    pub fn show(&mut self, ui: &mut Ui, session: &Session) -> Option<String> {
        let mut clicked = None;
        egui::Frame::new().inner_margin(8.0).show(ui, |ui| {
            let field = TextEdit::singleline(&mut self.search).hint_text("Search").desired_width(f32::INFINITY);
            ui.add(field);
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                let groups = search(&session.registry, &self.search);
                if groups.is_empty() {
                    ui.weak("No processor matches.");
                }
                for (task, members) in groups {
                    ui.add_space(6.0);
                    ui.label(RichText::new(task).small().weak());
                    for declaration in members {
                        if entry(ui, declaration) {
                            clicked = Some(declaration.id.clone());
                        }
                    }
                }
            });
        });
        clicked
    }
}

/// One processor; whether it was clicked.
fn entry(ui: &mut Ui, declaration: &Declaration) -> bool {
    let button =
        egui::Button::new(&declaration.label).frame_when_inactive(false).min_size([ui.available_width(), 0.0].into());
    let response = ui.add(button.sense(Sense::click_and_drag()));
    response.dnd_set_drag_payload(NewProcessor(declaration.id.clone()));
    if response.dragged() {
        egui::Tooltip::always_open(
            ui.ctx().clone(),
            ui.layer_id(),
            response.id.with("load"),
            egui::PopupAnchor::Pointer,
        )
        .gap(12.0)
        .show(|ui| ui.label(&declaration.label));
    }
    let clicked = response.clicked();
    response.on_hover_ui(|ui| help(ui, declaration));
    clicked
}

fn help(ui: &mut Ui, declaration: &Declaration) {
    ui.set_max_width(320.0);
    ui.strong(&declaration.label);
    ui.label(&declaration.help);
    ui.separator();
    for port in &declaration.inports {
        let color = port.accepts.first().map_or(ui.visuals().text_color(), |t| theme::port_color(*t));
        ui.horizontal(|ui| {
            theme::colored(ui, color, "in");
            ui.label(&port.label);
        });
    }
    for port in &declaration.outports {
        ui.horizontal(|ui| {
            theme::colored(ui, theme::port_color(port.port_type), "out");
            ui.label(&port.label);
        });
    }
    ui.weak("Click to add, or drag onto the canvas or a wire.");
}
