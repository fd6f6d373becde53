//! Reading a network file.

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use super::VERSION;
use super::paths::resolve;
use crate::connect::{can_keep, first_in_cycle};
use crate::edit::EditError;
use crate::frame::Frame;
use crate::json::{Node, Strict, ValueError};
use crate::link::Link;
use crate::names::{Address, hint, is_valid_id};
use crate::network::{Connection, Network, Processor, Setting};
use crate::property::{PropertyDecl, PropertyKind};
use crate::registry::Registry;
use crate::value::Value;

/// The longest network file that is read, bytes: a hundred thousand processors, and no device that never ends.
const LONGEST: u64 = 64 << 20;

/// A network file that could not be loaded.
#[derive(Debug, Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("{}: the network cannot be read: {source}.", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The text is not JSON.
    #[error("{}:{line}:{column}: this is not JSON: {message}.", file.display())]
    Syntax {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// The file was written by a newer Rayloom.
    #[error(
        "{}: the network is in format version {found}, but this Rayloom reads versions up to {VERSION}; open it with a newer one.",
        file.display()
    )]
    Newer {
        /// The file.
        file: PathBuf,
        /// Its version.
        found: i64,
    },
    /// The JSON does not describe a network.
    #[error("{}: {error}", file.display())]
    Content {
        /// The file.
        file: PathBuf,
        /// Where, what was found, what was expected.
        error: ValueError,
    },
}

/// A network from a file, with what is odd about it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The network.
    pub network: Network,
    /// Things that do no harm but should be shown.
    pub warnings: Vec<Warning>,
}

/// Something odd in a network file that does not keep it from loading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// JSON path.
    pub path: String,
    /// What is odd and what becomes of it.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

impl Network {
    /// Reads a network file. Paths in it that are relative are relative to its folder. Processors of unknown types are kept as
    /// placeholders and unknown properties as they are, both with a warning.
    ///
    /// # Errors
    /// Says the file and the line and column (what is not JSON) or the JSON path, what was found and what was expected.
    pub fn load(file: &Path, registry: &Arc<Registry>) -> Result<Loaded, LoadError> {
        let text = rayloom_files::read_text(file, LONGEST)
            .map_err(|source| LoadError::Read { file: file.to_owned(), source })?;
        Self::from_text(&text, file, registry)
    }

    /// As [`Network::load`], from the text of a file. With an empty `file`, relative paths stay as they are.
    ///
    /// # Errors
    /// As [`Network::load`].
    pub fn from_text(text: &str, file: &Path, registry: &Arc<Registry>) -> Result<Loaded, LoadError> {
        let Strict(json) =
            serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|e| syntax_error(&e, file))?;
        let root = Node::root(&json);
        let content = |error| LoadError::Content { file: file.to_owned(), error };
        let version = version(&root).map_err(content)?;
        if version > VERSION {
            return Err(LoadError::Newer { file: file.to_owned(), found: version });
        }
        let folder = std::path::absolute(file).ok().and_then(|file| file.parent().map(Path::to_owned));
        let mut loader = Loader { network: Network::new(registry.clone()), warnings: Vec::new(), folder };
        loader.document(&root).map_err(content)?;
        Ok(Loaded { network: loader.network, warnings: loader.warnings })
    }
}

fn syntax_error(error: &serde_json::Error, file: &Path) -> LoadError {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let message = message.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&message).to_owned();
    LoadError::Syntax { file: file.to_owned(), line, column, message }
}

fn version(root: &Node<'_>) -> Result<i64, ValueError> {
    let expected = format!("the format version, which is {VERSION} now");
    let node = root.required("rayloom", &expected)?;
    match node.i64()? {
        version if version >= 1 => Ok(version),
        version => Err(node.error(version.to_string(), expected)),
    }
}

/// What is expected in place of a connection that is refused.
const FITTING: &str = "a connection that fits";

struct Loader {
    network: Network,
    warnings: Vec<Warning>,
    folder: Option<PathBuf>,
}

impl Loader {
    fn document(&mut self, root: &Node<'_>) -> Result<(), ValueError> {
        root.only(&[
            "rayloom",
            "name",
            "description",
            "processors",
            "connections",
            "links",
            "frames",
            "visualization",
        ])?;
        if let Some(name) = root.field("name")? {
            self.network.name = name.string()?.to_owned();
        }
        if let Some(description) = root.field("description")? {
            self.network.description = description.string()?.to_owned();
        }
        if let Some(visualization) = root.field("visualization")? {
            self.network.visualization = visualization.json.clone();
        }
        for node in root.required("processors", "an array of processors")?.array()? {
            self.processor(&node)?;
        }
        let connections = root.field("connections")?.map_or(Ok(Vec::new()), |node| node.array())?;
        connections.iter().try_for_each(|node| self.connection(node))?;
        if let Some((place, refusal)) = first_in_cycle(&self.network) {
            let node = &connections[place];
            return Err(misfit(node, node.string()?, &refusal, FITTING));
        }
        for node in root.field("links")?.map_or(Ok(Vec::new()), |node| node.array())? {
            self.link(&node)?;
        }
        for node in root.field("frames")?.map_or(Ok(Vec::new()), |node| node.array())? {
            self.frame(&node)?;
        }
        Ok(())
    }

    fn frame(&mut self, node: &Node<'_>) -> Result<(), ValueError> {
        const RECT: &str = "[left, top, width, height], the last two above 0";
        node.only(&["title", "text", "rect"])?;
        let text = |name: &str| node.field(name)?.map_or(Ok(String::new()), |text| text.string().map(str::to_owned));
        let rect = node.required("rect", RECT)?;
        let numbers = rect.numbers(4)?;
        if numbers[2] <= 0.0 || numbers[3] <= 0.0 {
            return Err(rect.error(rect.json.to_string(), RECT));
        }
        let rect = [numbers[0], numbers[1], numbers[2], numbers[3]];
        self.network.frames.push(Frame { title: text("title")?, text: text("text")?, rect });
        Ok(())
    }

    fn processor(&mut self, node: &Node<'_>) -> Result<(), ValueError> {
        const FIELDS: [&str; 5] = ["id", "type", "label", "properties", "position"];
        let type_id = node.required("type", "the id of a processor type")?.string()?;
        let processor_type = self.network.registry.get(type_id).cloned();
        let mut processor = Processor {
            id: self.new_id(node)?,
            type_id: type_id.to_owned(),
            processor_type,
            settings: BTreeMap::new(),
            position: [0.0; 2],
            label: node.field("label")?.map(|label| label.string().map(str::to_owned)).transpose()?,
            extra: serde_json::Map::new(),
        };
        if let Some(position) = node.field("position")? {
            let numbers = position.numbers(2)?;
            processor.position = [numbers[0], numbers[1]];
        }
        if processor.is_placeholder() {
            let extra = node.object()?.iter().filter(|(name, _)| !FIELDS.contains(&name.as_str()));
            processor.extra = extra.map(|(name, json)| (name.clone(), json.clone())).collect();
            let hint = hint(type_id, self.network.registry.ids());
            self.warn(
                node,
                format!(
                    "the processor type `{type_id}` is unknown; `{}` is kept as it is but cannot run.{hint}",
                    processor.id
                ),
            );
        } else {
            node.only(&FIELDS)?;
        }
        if let Some(properties) = node.field("properties")? {
            self.properties(&properties, &mut processor)?;
        }
        self.network.processors.push(processor);
        Ok(())
    }

    fn new_id(&self, node: &Node<'_>) -> Result<String, ValueError> {
        let node = node.required("id", "an id of letters, digits, `_` or `-`")?;
        let id = node.string()?;
        if !is_valid_id(id) {
            return Err(node.error(format!("{id:?}"), "1 to 64 letters, digits, `_` or `-`"));
        }
        match self.network.processor(id) {
            Some(_) => Err(node.error(format!("`{id}` a second time"), "an id that no other processor has")),
            None => Ok(id.to_owned()),
        }
    }

    /// The declared properties first, because their values decide which others there are.
    fn properties(&mut self, node: &Node<'_>, processor: &mut Processor) -> Result<(), ValueError> {
        let fields = node.object()?;
        let declared = processor.declaration().map(|declaration| declaration.properties.clone()).unwrap_or_default();
        for decl in &declared {
            if let Some(field) = node.field(&decl.id)? {
                let value = decl.parse(field.json).map_err(|error| error.within(&field.path))?;
                self.keep(processor, decl, value);
            }
        }
        let present = processor.property_decls();
        for (id, json) in fields.iter().filter(|(id, _)| !declared.iter().any(|decl| decl.id == **id)) {
            let field = Node { path: format!("{}.{id}", node.path), json };
            match present.iter().find(|decl| decl.id == *id).map(|decl| (decl, decl.parse(json))) {
                Some((decl, Ok(value))) => self.keep(processor, decl, value),
                Some((_, Err(error))) => {
                    // Snippets change without their networks: a parameter that no longer fits must not lock a network away.
                    self.warn(&field, format!("{error} It is kept, and the default is used."));
                    processor.settings.insert(id.clone(), Setting::Json(json.clone()));
                }
                None => {
                    if !processor.is_placeholder() {
                        let hint = hint(id, present.iter().map(|decl| decl.id.as_str()));
                        let Processor { id: name, type_id, .. } = &*processor;
                        self.warn(
                            &field,
                            format!(
                                "`{name}` (a {type_id}) has no property `{id}`; it is kept but does nothing.{hint}"
                            ),
                        );
                    }
                    processor.settings.insert(id.clone(), Setting::Json(json.clone()));
                }
            }
        }
        Ok(())
    }

    fn keep(&self, processor: &mut Processor, decl: &PropertyDecl, value: Value) {
        let value = match (&decl.kind, value) {
            (PropertyKind::File { .. }, Value::Text(path)) => Value::Text(resolve(&path, self.folder.as_deref())),
            (_, value) => value,
        };
        processor.settings.insert(decl.id.clone(), Setting::Value(value));
    }

    fn connection(&mut self, node: &Node<'_>) -> Result<(), ValueError> {
        let text = node.string()?;
        let ends = text.split_once("->").and_then(|(from, to)| Some((address(from)?, address(to)?)));
        let Some((from, to)) = ends else {
            return Err(node.error(format!("{text:?}"), "\"processor.outport -> processor.inport\""));
        };
        can_keep(&self.network, &from, &to).map_err(|refusal| misfit(node, text, &refusal, FITTING))?;
        self.network.connections.push(Connection { from, to });
        Ok(())
    }

    fn link(&mut self, node: &Node<'_>) -> Result<(), ValueError> {
        const EXPECTED: &str = "[\"processor.property\", \"processor.property\"]";
        let ends = node.array()?;
        let [a, b] = ends.as_slice() else {
            return Err(node.error(format!("an array of {}", ends.len()), EXPECTED));
        };
        let end = |node: &Node<'_>| {
            let text = node.string()?;
            let address = address(text).ok_or_else(|| node.error(format!("{text:?}"), "\"processor.property\""))?;
            match self.network.processor(&address.processor) {
                Some(_) => Ok(address),
                None => {
                    let hint = hint(&address.processor, self.network.ids());
                    Err(node.error(format!("{text:?}"), format!("a property of a processor of this network.{hint}")))
                }
            }
        };
        let (a, b) = (end(a)?, end(b)?);
        self.make_link(node, a, b)
    }

    fn make_link(&mut self, node: &Node<'_>, a: Address, b: Address) -> Result<(), ValueError> {
        let text = format!("{a} = {b}");
        let refused = |error: EditError| misfit(node, &text, &error, "a link that fits");
        let absent = [&a, &b].into_iter().find(|end| self.network.declared_if_present(end).is_none());
        if let Some(end) = absent {
            self.network.link_shape(&a, &b).map_err(|refusal| refused(refusal.into()))?;
            self.warn(node, format!("there is no {end} now; the link is kept but does nothing."));
            self.network.links.push(Link { a, b });
            return Ok(());
        }
        self.network.can_link(&a, &b).map_err(refused)?;
        let value = |address: &Address| self.network.value(&address.processor, &address.item);
        if value(&a) != value(&b) {
            self.warn(node, format!("the linked properties differ; {b} takes the value of {a}."));
        }
        self.network.link(a, b).map_err(refused)
    }

    fn warn(&mut self, node: &Node<'_>, message: String) {
        self.warnings.push(Warning { path: node.path.clone(), message });
    }
}

fn address(text: &str) -> Option<Address> {
    text.trim().parse().ok()
}

/// The error that something readable does not fit the network, with the reason.
fn misfit(node: &Node<'_>, text: &str, reason: &dyn fmt::Display, expected: &str) -> ValueError {
    let reason = reason.to_string();
    node.error(format!("{text:?} ({})", reason.trim_end_matches('.')), expected)
}
