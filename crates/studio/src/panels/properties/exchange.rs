//! Values from and to JSON files and the clipboard.

use std::path::{Path, PathBuf};

use egui::Ui;
use rayloom_network::{PropertyDecl, Value};

use super::action::Action;
use super::editor::Surroundings;
use crate::dialogs::Question;
use crate::session::Severity;

/// Files larger than this are no transfer functions.
const LARGEST: u64 = 16 << 20;

/// What came of a chosen file.
pub(super) enum Exchanged {
    /// It was read.
    Read(Result<Value, String>),
    /// It was written, or not, and what to tell about that.
    Written(Severity, String),
}

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
    let dialogs = &mut surroundings.tools.exchanges;
    ui.menu_button("File", |ui| {
        if ui.button("Import JSON...").clicked() {
            let decl = decl.clone();
            let work = move |path: PathBuf| Exchanged::Read(read(&path, &decl).map_err(|error| problem(&path, &error)));
            dialogs.ask(import, ui.ctx(), surroundings.chooser, &question(None), work);
            ui.close();
        }
        if ui.button("Export JSON...").clicked() {
            let json = json();
            dialogs
                .ask(export, ui.ctx(), surroundings.chooser, &question(Some(&name)), move |path| write(&path, &json));
            ui.close();
        }
        if ui.button("Copy as JSON").clicked() {
            ui.ctx().copy_text(json());
            ui.close();
        }
    });
    match dialogs.answer(export).or_else(|| dialogs.answer(import))? {
        Exchanged::Read(Ok(value)) => return Some(value),
        Exchanged::Read(Err(error)) => surroundings.actions.push(Action::Tell(Severity::Error, error)),
        Exchanged::Written(severity, text) => surroundings.actions.push(Action::Tell(severity, text)),
    }
    None
}

fn problem(path: &Path, error: &str) -> String {
    format!("{}: {error}", path.display())
}

fn write(path: &Path, json: &str) -> Exchanged {
    match rayloom_files::write(path, json.as_bytes()) {
        Ok(()) => Exchanged::Written(Severity::Note, format!("wrote {}", path.display())),
        Err(error) => Exchanged::Written(Severity::Error, format!("{} cannot be written: {error}.", path.display())),
    }
}

/// The value in a file.
fn read(path: &Path, decl: &PropertyDecl) -> Result<Value, String> {
    let text = rayloom_files::read_text(path, LARGEST).map_err(|error| format!("{error}."))?;
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
