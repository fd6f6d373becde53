//! The file formats of volumes and pictures.

use rayloom_volume::formats;
use serde_json::{Value as Json, json};

use super::columns;

/// Pictures that `render` writes: extension and help.
const PICTURES: [(&str, &str); 3] = [
    (".png", "8 bits, straight alpha, as viewers expect it."),
    (".exr", "OpenEXR: 32-bit floats R, G, B, A, premultiplied, and depth Z where there is one."),
    (".npy", "NumPy array of float32, height x width x 4, premultiplied, row 0 at the top."),
];

/// Volumes, then pictures, for people.
pub fn text() -> String {
    let volumes: Vec<(String, &str)> =
        formats().iter().map(|format| (dotted(format.extensions), format.help)).collect();
    let volumes = columns(volumes.iter().map(|(extensions, help)| (extensions.as_str(), *help)));
    format!("Volumes that can be read\n{volumes}\nPictures that can be written\n{}", columns(PICTURES))
}

/// One object a format.
pub fn json() -> Vec<Json> {
    let volumes = formats().iter().map(|format| {
        let (id, label, help) = (format.id, format.label, format.help);
        json!({"kind": "volume", "id": id, "label": label, "extensions": format.extensions, "help": help})
    });
    let pictures = PICTURES.iter().map(|(extension, help)| {
        let id = &extension[1..];
        json!({"kind": "picture", "id": id, "label": id.to_uppercase(), "extensions": [id], "help": help})
    });
    volumes.chain(pictures).collect()
}

fn dotted(extensions: &[&str]) -> String {
    extensions.iter().map(|extension| format!(".{extension}")).collect::<Vec<_>>().join(" ")
}
