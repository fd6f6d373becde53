//! Which canvases are shown, in which order and how.

use egui::Ui;
use rayloom_network::Network;

use super::list::{self, List};
use super::{heading, mark};
use crate::theme;
use crate::visualization::{Application, Change, Layout, canvases};

/// Shows the canvases, those shown first.
pub fn show(ui: &mut Ui, network: &Network, application: &Application, changes: &mut Vec<Change>) {
    let all: Vec<&str> = canvases(network).collect();
    let listed = application.listed_canvases(network);
    heading(ui, "Canvases", |ui| {
        if all.len() < 2 {
            return;
        }
        for (layout, name, help) in [
            (Layout::FirstLarge, "First large", "The first canvas large, the others beside or below it"),
            (Layout::Grid, "Grid", "All canvases in cells of the same size"),
        ] {
            if ui.selectable_label(application.layout == layout, name).on_hover_text(help).clicked() {
                changes.push(Change::Arrange(layout));
            }
        }
    });
    if all.is_empty() {
        ui.weak("The network has no canvas.");
    }
    for (index, id) in listed.iter().enumerate() {
        let row = ui.horizontal(|ui| {
            if let Some(step) = list::handle(ui, List::Canvases, (0, index), id) {
                changes.extend(index.checked_add_signed(step).map(|to| Change::MoveCanvas(index, to)));
            }
            match all.contains(&id.as_str()) {
                true => tick(ui, network, id, true, changes),
                false => {
                    theme::colored(ui, theme::WARNING, format!("there is no canvas `{id}` any more"));
                    if mark(ui, "✖", &format!("Remove {id}")) {
                        changes.push(Change::ShowCanvas(id.clone(), false));
                    }
                }
            }
        });
        if let Some(((_, from), after)) =
            list::drop_at(ui, row.response.rect.with_max_x(ui.max_rect().right()), List::Canvases)
        {
            changes.push(Change::MoveCanvas(from, list::landing(from, index, after)));
        }
    }
    for id in all.iter().filter(|id| !listed.iter().any(|listed| listed == *id)) {
        tick(ui, network, id, false, changes);
    }
}

fn tick(ui: &mut Ui, network: &Network, id: &str, shown: bool, changes: &mut Vec<Change>) {
    let name = network.processor(id).and_then(|processor| processor.label());
    let text = name.map_or_else(|| id.to_owned(), |name| format!("{name}  ({id})"));
    let mut on = shown;
    if ui.checkbox(&mut on, text).changed() {
        changes.push(Change::ShowCanvas(id.to_owned(), on));
    }
}
