//! Text, one line or several; it counts when the field is left.

use egui::{Key, TextEdit, Ui};
use rayloom_network::PropertyDecl;

use super::editor::Surroundings;

/// Shows a text; the new one if the user changed it and left the field.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    content: &str,
    multiline: bool,
    surroundings: &mut Surroundings<'_>,
) -> Option<String> {
    let address = surroundings.address(decl);
    let mut text = surroundings.tools.drafts.get(&address).cloned().unwrap_or_else(|| content.to_owned());
    let edit = if multiline { TextEdit::multiline(&mut text).desired_rows(3) } else { TextEdit::singleline(&mut text) };
    let response = ui.add(edit.desired_width(f32::INFINITY).margin(egui::Margin::symmetric(5, 1)));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(decl.label.as_str()));
    if response.has_focus() {
        surroundings.tools.drafts.insert(address, text);
        return None;
    }
    surroundings.tools.drafts.remove(&address);
    let left = response.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
    (left && text != content).then_some(text)
}
