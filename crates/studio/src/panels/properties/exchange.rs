//! Values from and to JSON files and the clipboard.

use std::path::Path;

use egui::Ui;
use rayloom_network::{PropertyDecl, Value};

use super::action::Action;
use super::dialog::Question;
use super::editor::Surroundings;
use crate::session::Severity;

/// Files larger than this are no transfer functions.
const LARGEST: u64 = 16 << 20;

/// A menu that reads and writes a value; the value that was read.
pub(super) fn menu(
    ui: &mut Ui,
    decl: &PropertyDecl,
    value: &Value,
    surroundings: &mut Surroundings<'_>,
) -> Option<Value> {
    let (import, export) = (ui.make_persistent_id("import"), ui.make_persistent_id("export"));
    let json = || format!("{:#}\n", value.to_json());
    let extensions = ["json".to_owned()];
    let name = format!("{}.json", decl.id);
    let folder = surroundings.folder;
    let question = |save_as| Question { name: "JSON", extensions: &extensions, folder, save_as };
    ui.menu_button("File", |ui| {
        let dialogs = &mut surroundings.tools.dialogs;
        if ui.button("Import JSON...").clicked() {
            dialogs.ask(import, ui.ctx(), &question(None));
            ui.close();
        }
        if ui.button("Export JSON...").clicked() {
            dialogs.ask(export, ui.ctx(), &question(Some(&name)));
            ui.close();
        }
        if ui.button("Copy as JSON").clicked() {
            ui.ctx().copy_text(json());
            ui.close();
        }
    });
    if let Some(path) = surroundings.tools.dialogs.answer(export) {
        let (severity, text) = match std::fs::write(&path, json()) {
            Ok(()) => (Severity::Note, format!("wrote {}", path.display())),
            Err(error) => (Severity::Error, format!("{} cannot be written: {error}.", path.display())),
        };
        surroundings.actions.push(Action::Tell(severity, text));
    }
    let path = surroundings.tools.dialogs.answer(import)?;
    match read(&path, decl) {
        Ok(value) => Some(value),
        Err(error) => {
            surroundings.actions.push(Action::Tell(Severity::Error, format!("{}: {error}", path.display())));
            None
        }
    }
}

/// The value in a file.
fn read(path: &Path, decl: &PropertyDecl) -> Result<Value, String> {
    let size = std::fs::metadata(path).map_err(|error| error.to_string())?.len();
    if size > LARGEST {
        return Err(format!("the file has {size} bytes, far too many for this; choose one that was exported here."));
    }
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let json = serde_json::from_str(&text).map_err(|error| format!("this is no JSON: {error}."))?;
    decl.parse(&json).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use rayloom_volume::{TransferFunction, ValueRange};

    use super::*;

    #[test]
    fn what_was_exported_is_read_back_and_other_files_are_refused() {
        let function = TransferFunction::ramp(ValueRange::new(-10.0, 10.0), 0.3);
        let decl = PropertyDecl::transfer_function("tf", "Transfer function", TransferFunction::default());
        let path = std::env::temp_dir().join(format!("rayloom-exchange-{}.json", std::process::id()));
        let value = Value::TransferFunction(function);
        std::fs::write(&path, value.to_json().to_string()).expect("written");
        assert_eq!(read(&path, &decl), Ok(value));
        std::fs::write(&path, "{\"knots\": [{\"at\": 1}]}").expect("written");
        assert!(read(&path, &decl).is_err());
        std::fs::remove_file(&path).expect("removed");
        assert!(read(&path, &decl).is_err());
    }
}
