//! Any value as text, to be typed or pasted: a path or a text as it is, everything else as in the network file.

use egui::{Key, Modifiers, TextEdit, Ui};
use rayloom_network::{PropertyDecl, Value};

use super::editor::Surroundings;
use super::number::Entered;

/// Whether a value is a text already.
fn is_text(decl: &PropertyDecl) -> bool {
    matches!(decl.default, Value::Text(_))
}

/// The text of a value.
fn write(decl: &PropertyDecl, value: &Value) -> String {
    match value {
        Value::Text(text) if is_text(decl) => text.clone(),
        value => format!("{:#}", value.to_json()),
    }
}

/// The value that a text says.
fn read(decl: &PropertyDecl, text: &str) -> Result<Value, String> {
    let json = match is_text(decl) {
        true => text.trim().into(),
        false => serde_json::from_str(text).map_err(|error| format!("this is not JSON: {error}."))?,
    };
    decl.parse(&json).map_err(|error| error.to_string())
}

/// Opens the text of a property's value.
pub(super) fn open(decl: &PropertyDecl, surroundings: &mut Surroundings<'_>) {
    let value = surroundings.properties.get(&decl.id).unwrap_or(&decl.default);
    let (address, text) = (surroundings.address(decl), write(decl, value));
    surroundings.tools.texts.insert(address, text);
}

/// Shows the text while it is open; the value when the user set one.
pub(super) fn show(ui: &mut Ui, decl: &PropertyDecl, surroundings: &mut Surroundings<'_>) -> Option<Value> {
    let address = surroundings.address(decl);
    let mut text = surroundings.tools.texts.remove(&address)?;
    let field = match is_text(decl) {
        true => TextEdit::singleline(&mut text),
        false => TextEdit::multiline(&mut text).code_editor().desired_rows(3),
    };
    let enter = ui.input_mut(|input| input.consume_key(Modifiers::COMMAND, Key::Enter));
    let field = ui.add(field.desired_width(f32::INFINITY));
    ui.ctx().accesskit_node_builder(field.id, |node| node.set_label(format!("{} as text", decl.label)));
    let entered = is_text(decl) && field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let mut set = entered || (enter && field.has_focus());
    let mut closed = false;
    ui.horizontal(|ui| {
        set |= ui.button("Set").on_hover_text("Ctrl+Enter").clicked();
        closed = ui.button("Close").clicked();
    });
    let read = set.then(|| read(decl, &text));
    if !closed && !matches!(read, Some(Ok(_))) {
        surroundings.tools.texts.insert(address, text);
    }
    match read? {
        Ok(value) => {
            surroundings.number(decl, Entered::Value(0.0));
            Some(value)
        }
        Err(why) => {
            surroundings.number(decl, Entered::Bad(format!("Not set: {why}")));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use rayloom_network::Camera;
    use rayloom_volume::TransferFunction;

    use super::*;

    #[test]
    fn every_value_comes_back_from_its_text_and_mistakes_are_named() {
        let decls = [
            PropertyDecl::float("rate", "Rate", 1.5),
            PropertyDecl::file("file", "File", &["nrrd"]),
            PropertyDecl::camera("camera", "Camera", Camera::default()),
            PropertyDecl::transfer_function("tf", "Transfer function", TransferFunction::default()),
        ];
        for decl in &decls {
            assert_eq!(read(decl, &write(decl, &decl.default)).as_ref(), Ok(&decl.default), "{}", decl.id);
        }
        assert_eq!(read(&decls[1], " a b.nrrd\n"), Ok(Value::Text("a b.nrrd".into())));
        assert!(read(&decls[0], "1.5 mm").expect_err("no number").starts_with("this is not JSON"));
        assert!(read(&decls[2], "{\"position\": 3}").is_err());
    }
}
