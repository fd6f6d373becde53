//! Sets of values for users to choose from.

use egui::{TextEdit, Ui};
use rayloom_network::Address;

use super::list::{self, List};
use super::{Done, entered, heading, line, mark};
use crate::theme;
use crate::visualization::{Application, Change};

/// Shows the presets; `name` is that of the next one.
pub fn show(
    ui: &mut Ui,
    application: &Application,
    refused: &[Vec<(Address, String)>],
    name: &mut String,
    done: &mut Done,
) {
    heading(ui, "Presets", |_| {});
    for (index, preset) in application.presets.iter().enumerate() {
        let row = ui.push_id(("preset", index), |ui| {
            ui.horizontal(|ui| {
                let label = format!("preset {}", index + 1);
                if let Some(step) = list::handle(ui, List::Presets, (0, index), &label) {
                    done.changes.extend(index.checked_add_signed(step).map(|to| Change::MovePreset(index, to)));
                }
                let width = ui.available_width() - 134.0;
                let typed = line(ui, &format!("Name of {label}"), &preset.name, "Name", width);
                done.changes.extend(typed.map(|name| Change::RenamePreset(index, name)));
                if ui.button("Apply").on_hover_text("Sets these values now").clicked() {
                    done.chosen = Some(index);
                }
                let help = "Stores the values that the properties above have now in place of these";
                if ui.button("Update").on_hover_text(help).clicked() {
                    done.changes.push(Change::StorePreset(preset.name.clone()));
                }
                if mark(ui, "✖", &format!("Remove {label}")) {
                    done.changes.push(Change::RemovePreset(index));
                }
            })
        });
        for (address, problem) in refused.get(index).into_iter().flatten() {
            ui.horizontal_wrapped(|ui| {
                theme::colored(ui, theme::WARNING, problem);
                if mark(ui, "✖", &format!("Take {address} out of {}", preset.name)) {
                    done.changes.push(Change::Forget(index, address.clone()));
                }
            });
        }
        if let Some(((_, from), after)) = list::drop_at(ui, row.response.rect, List::Presets) {
            done.changes.push(Change::MovePreset(from, list::landing(from, index, after)));
        }
    }
    store(ui, application, name, &mut done.changes);
}

fn store(ui: &mut Ui, application: &Application, name: &mut String, changes: &mut Vec<Change>) {
    let exposed = application.groups.iter().any(|group| !group.properties.is_empty());
    if !exposed {
        ui.weak("Show some properties first: a preset stores their values.");
        return;
    }
    ui.horizontal(|ui| {
        let width = ui.available_width() - 60.0;
        let field = ui.add(TextEdit::singleline(name).hint_text("Name of a new preset").desired_width(width));
        ui.ctx().accesskit_node_builder(field.id, |node| node.set_label("Name of a new preset"));
        let named = !name.trim().is_empty();
        let button = ui.add_enabled(named, egui::Button::new("Store"));
        let help = "Stores the values that the properties above have now, except files";
        if named && (button.on_hover_text(help).clicked() || entered(ui, &field)) {
            changes.push(Change::StorePreset(name.trim().to_owned()));
            name.clear();
        }
    });
}
