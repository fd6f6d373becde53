//! The menu bar.

use egui::{Button, Ui};

use super::{Command, MENUS};
use crate::app::Studio;

/// Shows the menu bar; the command that was chosen is to be run.
pub fn menu_bar(ui: &mut Ui, studio: &mut Studio) -> Option<&'static Command> {
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
                    if let Some(more) = menu.more.filter(|_| index == 0) {
                        more(ui, studio);
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
    let keys = command.keys_text(ui.ctx());
    let button = Button::new(text);
    // An empty text would make a space at the end of the name that is read out.
    let button = if keys.is_empty() { button } else { button.shortcut_text(keys) };
    let button = match command.ticked {
        Some(ticked) => button.selected(ticked(studio, ui.ctx())),
        None => button,
    };
    ui.add_enabled(command.is_enabled(studio), button).on_hover_text(command.help).clicked()
}

/// The files opened lately. Those that are gone are dimmed.
pub(super) fn recent_files(ui: &mut Ui, studio: &mut Studio) {
    let mut chosen = None;
    ui.menu_button("Open recent", |ui| {
        let recent = studio.files.recent(ui.ctx());
        if recent.is_empty() {
            ui.weak("none yet");
        }
        for file in recent {
            let name = file.path.file_name().unwrap_or_default().to_string_lossy();
            let folder = file.path.parent().unwrap_or(&file.path).display().to_string();
            let response = ui.add_enabled(file.exists, Button::new(name.as_ref()));
            let gone = format!("{folder}\nThe file is no longer there.");
            if response.on_hover_text(&folder).on_disabled_hover_text(gone).clicked() {
                chosen = Some(file.path.clone());
            }
        }
    });
    if let Some(path) = chosen {
        studio.files.open(&path, &mut studio.session, ui.ctx());
    }
}
