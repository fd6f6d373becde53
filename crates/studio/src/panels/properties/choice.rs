//! A list of possibilities, each with its help.

use egui::{ComboBox, RichText, Ui};
use rayloom_network::{Choice, PropertyDecl};
use rayloom_processors::snippet_library;
use rayloom_wgsl::{Library, Slot};

/// Shows a choice; the id of the new one if the user chose one.
pub(super) fn show(ui: &mut Ui, decl: &PropertyDecl, choices: &[Choice], id: &str) -> Option<String> {
    let current = choices.iter().find(|choice| choice.id == id);
    let shown = current.map_or(id, |choice| choice.label.as_str());
    let mut chosen = None;
    let width = ui.available_width();
    let list = ComboBox::from_id_salt(&decl.id).width(width).height(420.0).truncate().selected_text(shown);
    let opened = list.show_ui(ui, |ui| {
        ui.set_min_width(260.0);
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
        let help = RichText::new(&choice.help).size(11.0);
        job.append(&format!("\n{}", help.text()), 0.0, format(11.0, ui.visuals().weak_text_color()));
    }
    job.wrap.max_width = 300.0;
    let response = ui.selectable_label(selected, job);
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::SelectableLabel, true, selected, &choice.label));
    response.clicked()
}

/// The snippets for a slot.
pub(super) fn snippets(slot: &str) -> Vec<Choice> {
    let (library, _) = snippet_library();
    let Some(slot) = Slot::from_id(slot) else { return Vec::new() };
    let automatic = (slot == Slot::Skipping)
        .then(|| Choice::new("auto", "Automatic", "Chosen by the share of bricks in which anything is visible."));
    let snippets = library.snippets(slot).map(|(path, declaration)| {
        Choice::new(Library::id(path), declaration.label.clone(), declaration.help.clone())
    });
    automatic.into_iter().chain(snippets).collect()
}
