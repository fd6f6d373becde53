//! The button beside a slot that opens its text, and the text where it is a property of its own in visualization mode.

use egui::{RichText, Ui};
use rayloom_network::{PropertyDecl, PropertyKind};
use rayloom_wgsl::Slot;

use super::action::Action;
use super::editor::Surroundings;
use crate::pane::Pane;
use crate::panels::shader_editor::{code, in_use, problems};
use crate::theme;

/// A small button that opens the text of a slot in a pane.
pub(super) fn toggle(ui: &mut Ui, decl: &PropertyDecl, width: f32, surroundings: &mut Surroundings<'_>) {
    let own = surroundings.properties.text(&decl.id).is_ok_and(|text| !text.trim().is_empty());
    let color = if own { theme::ink(ui.visuals(), theme::WARNING) } else { ui.visuals().weak_text_color() };
    let button = egui::Button::new(RichText::new("{ }").monospace().size(10.5).color(color)).frame(false);
    let response = ui.add_sized([width, super::row::HEIGHT], button);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &decl.label));
    let help = if own { "Your own text is used in place of the chosen snippet" } else { "Edit the snippet's text" };
    if response.on_hover_text(help).clicked() {
        surroundings.actions.push(Action::Open(Pane::Shader(surroundings.address(decl))));
    }
}

/// Height of the text where it is shown among properties, points.
const HEIGHT: f32 = 260.0;

/// The text among other properties; the new one when it was applied.
pub(super) fn show(ui: &mut Ui, decl: &PropertyDecl, own: &str, surroundings: &mut Surroundings<'_>) -> Option<String> {
    let PropertyKind::ShaderText { slot } = &decl.kind else { return None };
    let address = surroundings.address(decl);
    let (path, used) = in_use(Slot::from_id(slot)?, &decl.id, own, surroundings.properties);
    let mut text = surroundings.tools.drafts.get(&address).cloned().unwrap_or_else(|| used.clone());
    let problems = problems(surroundings.failure);
    let marked: Vec<_> = problems.iter().filter(|problem| problem.source == path).collect();
    let size = egui::Vec2::new(ui.available_width(), HEIGHT);
    ui.allocate_ui(size, |ui| code::show(ui, &decl.label, &mut text, &marked, &mut 1, None));
    for problem in &problems {
        ui.label(RichText::new(problem.to_string()).size(11.5).color(theme::ink(ui.visuals(), theme::ERROR)));
    }
    let mut applied = None;
    ui.horizontal(|ui| {
        if ui.add_enabled(text != used, egui::Button::new("Apply")).clicked() {
            applied = Some(text.clone());
        }
        if ui.add_enabled(!own.is_empty(), egui::Button::new("Revert")).clicked() {
            applied = Some(String::new());
        }
    });
    match text == used || applied.is_some() {
        true => surroundings.tools.drafts.remove(&address),
        false => surroundings.tools.drafts.insert(address, text),
    };
    applied
}
