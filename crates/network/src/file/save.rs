//! Writing a network file.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value as Json};
use thiserror::Error;

use super::VERSION;
use super::layout::{Ordered, Piece, lay_out};
use super::paths::relate;
use crate::frame::Frame;
use crate::network::{Network, Processor};
use crate::property::PropertyKind;
use crate::value::Value;

/// A network file that could not be written; the file that was there before is untouched.
#[derive(Debug, Error)]
#[error("{}: the network cannot be saved here: {source}. Check that the folder exists and may be written to.", file.display())]
pub struct SaveError {
    /// The file.
    pub file: PathBuf,
    /// Why.
    pub source: io::Error,
}

impl Network {
    /// Writes the network to a file, all or nothing: a reader sees the old file or the new one, never a part.
    ///
    /// # Errors
    /// The folder or file cannot be written.
    pub fn save(&self, file: &Path) -> Result<(), SaveError> {
        let fail = |source| SaveError { file: file.to_owned(), source };
        // Through a symbolic link, the file behind it is replaced, so that paths are relative to the folder of that.
        let target = fs::canonicalize(file).or_else(|_| std::path::absolute(file)).map_err(fail)?;
        rayloom_files::write(file, self.to_text(target.parent()).as_bytes()).map_err(fail)
    }

    /// The text of the network's file. Paths of files are relative to `folder` if they can be.
    pub fn to_text(&self, folder: Option<&Path>) -> String {
        let mut document = Ordered::default();
        document.push_json("rayloom", VERSION);
        for (key, text) in [("name", &self.name), ("description", &self.description)] {
            if !text.is_empty() {
                document.push_json(key, text.as_str());
            }
        }
        let processors = self.processors().map(|processor| Piece::Object(write_processor(processor, folder)));
        document.push("processors", Piece::List(processors.collect()));
        let connections = self.connections().iter().map(|connection| Piece::Plain(connection.to_string().into()));
        document.push("connections", Piece::List(connections.collect()));
        if !self.links().is_empty() {
            let links =
                self.links().iter().map(|link| Piece::Plain(vec![link.a.to_string(), link.b.to_string()].into()));
            document.push("links", Piece::List(links.collect()));
        }
        if !self.frames.is_empty() {
            let frames = self.frames.iter().map(|frame| Piece::Object(write_frame(frame)));
            document.push("frames", Piece::List(frames.collect()));
        }
        if !self.visualization.is_null() {
            document.push_json("visualization", self.visualization.clone());
        }
        lay_out(document)
    }
}

fn write_processor(processor: &Processor, folder: Option<&Path>) -> Ordered {
    let mut fields = Ordered::default();
    fields.push_json("id", processor.id.as_str());
    fields.push_json("type", processor.type_id.as_str());
    if let Some(label) = &processor.label {
        fields.push_json("label", label.as_str());
    }
    let properties = write_properties(processor, folder);
    if !properties.is_empty() {
        fields.push_json("properties", properties);
    }
    if processor.position != [0.0; 2] {
        fields.push_json("position", processor.position.to_vec());
    }
    let mut extra: Vec<_> = processor.extra.iter().collect();
    extra.sort_by_key(|(name, _)| *name);
    for (name, json) in extra {
        fields.push_json(name, json.clone());
    }
    fields
}

fn write_frame(frame: &Frame) -> Ordered {
    let mut fields = Ordered::default();
    fields.push_json("title", frame.title.as_str());
    if !frame.text.is_empty() {
        fields.push_json("text", frame.text.as_str());
    }
    fields.push_json("rect", frame.rect.to_vec());
    fields
}

/// What was set and differs from the default; and what is no value of a property at the moment, as it is.
fn write_properties(processor: &Processor, folder: Option<&Path>) -> Map<String, Json> {
    let decls = processor.property_decls();
    let mut out = Map::new();
    for (id, setting) in &processor.settings {
        let decl = decls.iter().find(|decl| decl.id == *id);
        let json = match decl.and_then(|decl| Some((decl, setting.value(decl)?))) {
            Some((decl, value)) if value == decl.default => continue,
            Some((decl, Value::Text(path))) if matches!(decl.kind, PropertyKind::File { .. }) => {
                relate(&path, folder).into()
            }
            Some((_, value)) => value.to_json(),
            None => setting.to_json(),
        };
        out.insert(id.clone(), json);
    }
    out
}
