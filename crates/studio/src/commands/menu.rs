//! The menu bar.

use egui::{Button, Ui};

use super::{Command, MENUS};
use crate::app::Studio;

/// Shows the menu bar; the command that was chosen is to be run.
pub fn menu_bar(ui: &mut Ui, studio: &Studio) -> Option<&'static Command> {
    let mut chosen = None;
    egui::MenuBar::new().ui(ui, |ui| {
        for menu in MENUS {
            ui.menu_button(menu.title, |ui| {
                for (index, group) in menu.groups.iter().enumerate() {
                    if index > 0 {
                        ui.separator();
                    }
                    for command in *group {
                        if item(ui, studio, command) {
                            chosen = Some(command);
                        }
                    }
                }
            });
        }
    });
    chosen
}

fn item(ui: &mut Ui, studio: &Studio, command: &Command) -> bool {
    let text = match command.detail.and_then(|detail| detail(studio)) {
        Some(detail) => format!("{} {detail}", command.label),
        None => command.label.to_owned(),
    };
    let button = Button::new(text).shortcut_text(command.keys_text(ui.ctx()));
    let button = match command.ticked {
        Some(ticked) => button.selected(ticked(studio, ui.ctx())),
        None => button,
    };
    ui.add_enabled(command.is_enabled(studio), button).on_hover_text(command.help).clicked()
}
