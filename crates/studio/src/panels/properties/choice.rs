//! A list of possibilities, each with its help.

use egui::{ComboBox, Ui};
use rayloom_network::{Choice, PropertyDecl};
use rayloom_processors::snippet_library;
use rayloom_wgsl::{Library, Slot};

/// Width of the open list, points.
const HELP_WIDTH: f32 = 310.0;

/// Shows a choice; the id of the new one if the user chose one.
pub(super) fn show(ui: &mut Ui, decl: &PropertyDecl, choices: &[Choice], id: &str) -> Option<String> {
    let current = choices.iter().find(|choice| choice.id == id);
    let shown = current.map_or(id, |choice| choice.label.as_str());
    let mut chosen = None;
    let width = ui.available_width();
    let list = ComboBox::from_id_salt(&decl.id).width(width).height(420.0).truncate().selected_text(shown);
    let opened = list.show_ui(ui, |ui| {
        ui.set_min_width(HELP_WIDTH);
        ui.set_max_width(HELP_WIDTH);
        ui.spacing_mut().item_spacing.y = 1.0;
        for choice in choices {
            if item(ui, choice, choice.id == id) {
                chosen = Some(choice.id.clone());
            }
        }
    });
    opened.response.ctx.accesskit_node_builder(opened.response.id, |node| node.set_label(decl.label.as_str()));
    if let Some(choice) = current.filter(|choice| !choice.help.is_empty()) {
        opened.response.on_hover_text(&choice.help);
    }
    chosen.filter(|chosen| chosen != id)
}

fn item(ui: &mut Ui, choice: &Choice, selected: bool) -> bool {
    let mut job = egui::text::LayoutJob::default();
    let format = |size: f32, color| egui::TextFormat::simple(egui::FontId::proportional(size), color);
    job.append(&choice.label, 0.0, format(13.0, ui.visuals().strong_text_color()));
    if !choice.help.is_empty() {
        let color = ui.visuals().text_color().gamma_multiply(0.75);
        job.append(&format!("\n{}", choice.help), 0.0, format(11.0, color));
    }
    let response = ui.add(egui::Button::selectable(selected, job).wrap().min_size(egui::vec2(HELP_WIDTH, 0.0)));
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::SelectableLabel, true, selected, &choice.label));
    response.clicked()
}

/// The snippets for a slot.
pub(super) fn snippets(slot: &str) -> Vec<Choice> {
    let (library, _) = snippet_library();
    let Some(slot) = Slot::from_id(slot) else { return Vec::new() };
    let automatic = (slot == Slot::Skipping)
        .then(|| Choice::new("auto", "Automatic", "Chosen by the share of bricks in which anything is visible."));
    let snippets = library
        .snippets(slot)
        .map(|(path, declaration)| Choice::new(Library::id(path), declaration.label.clone(), declaration.help.clone()));
    automatic.into_iter().chain(snippets).collect()
}
