//! A file: its name, a dialog to choose another.

use std::path::Path;

use egui::{RichText, Ui};
use rayloom_network::{PropertyDecl, PropertyKind};

use super::editor::Surroundings;
use crate::dialogs::Question;

/// Shows a file; the new path if the user chose one.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    path: &str,
    surroundings: &mut Surroundings<'_>,
) -> Option<String> {
    let PropertyKind::File { extensions, save, required } = &decl.kind else { return None };
    let who = ui.make_persistent_id("dialog");
    let folder = Path::new(path).parent().filter(|folder| folder.is_dir()).or(surroundings.folder);
    let name = Path::new(path).file_name().map(|name| name.to_string_lossy().into_owned());
    let clearable = name.is_some() && !required;
    let mut changed = None;
    let width = ui.available_width() - if clearable { 22.0 } else { 0.0 };
    let text = match &name {
        Some(name) => RichText::new(name.as_str()),
        None if *save => RichText::new("Choose where to save...").weak(),
        None => RichText::new("Choose a file...").weak(),
    };
    let button = egui::Button::new(text).truncate().min_size(egui::vec2(width, super::row::HEIGHT));
    let response = ui.add_enabled(!surroundings.tools.dialogs.is_open(who), button);
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(decl.label.as_str()));
    let shown = if path.is_empty() { formats(extensions) } else { path.to_owned() };
    if response.on_hover_text(shown).clicked() {
        let save_as = save.then(|| name.as_deref().unwrap_or("picture.png"));
        let question = Question { name: &decl.label, extensions, folder, save_as };
        surroundings.tools.dialogs.ask(who, ui.ctx(), surroundings.chooser, &question, |path| path);
    }
    if clearable && ui.small_button("✖").on_hover_text("No file").clicked() {
        changed = Some(String::new());
    }
    let chosen = surroundings.tools.dialogs.answer(who).map(|path| path.to_string_lossy().into_owned());
    chosen.or(changed)
}

fn formats(extensions: &[String]) -> String {
    match extensions {
        [] => "Any file".into(),
        _ => format!("Files that end in {}", extensions.join(", ")),
    }
}
