//! The shader sources: built-in files, a user's folder, and texts edited for one processor.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::declaration::{Declaration, stem};
use crate::diagnostic::Diagnostic;
use crate::lexer::line_and_column;
use crate::limits;
use crate::slot::Slot;
use crate::snippet::Snippet;

/// The files under `shaders/`, embedded at build time: (path with forward slashes, text).
const BUILT_IN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Where a source came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceKind {
    /// Shipped with the program.
    BuiltIn,
    /// Read from the user's snippet folder.
    User,
    /// Edited for one processor and stored in its network.
    Edited,
}

/// One shader file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path inside the library, such as `gradient/central.wgsl` or `user/mine.wgsl`.
    pub path: Arc<str>,
    /// The text.
    pub text: Arc<str>,
    /// Where it came from.
    pub kind: SourceKind,
}

/// The shader files that an assembly can draw from. Cloning is cheap: texts are shared.
#[derive(Clone, Debug, PartialEq)]
pub struct Library {
    sources: BTreeMap<Arc<str>, Source>,
    snippets: BTreeMap<Arc<str>, Snippet>,
}

impl Library {
    /// The built-in files.
    ///
    /// # Errors
    /// A built-in snippet whose declaration is malformed; a test makes sure that there is none.
    pub fn built_in() -> Result<Self, Diagnostic> {
        let mut library = Self { sources: BTreeMap::new(), snippets: BTreeMap::new() };
        for (path, text) in BUILT_IN {
            library.insert_built_in(path, text)?;
        }
        Ok(library)
    }

    /// Adds every `.wgsl` file of a folder (not of its sub-folders) as `user/NAME.wgsl`.
    /// Files that cannot be read or declared are left out; their messages are returned.
    pub fn add_folder(&mut self, folder: &Path) -> Vec<Diagnostic> {
        let name = folder.display().to_string();
        let entries = match std::fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) => {
                return vec![Diagnostic::new(&name, 0, 0, format!("the snippet folder cannot be read: {error}"))];
            }
        };
        let mut paths: Vec<_> = entries
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|e| e == "wgsl"))
            .collect();
        paths.sort();
        let mut problems = Vec::new();
        for path in paths {
            let file = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let added = read(&path).and_then(|text| self.add_user(&file, &text));
            problems.extend(added.err());
        }
        problems
    }

    /// Adds one user snippet as `user/FILE`; its id is the file name without extension.
    ///
    /// # Errors
    /// A malformed declaration, or an id that another snippet of the slot has already.
    pub fn add_user(&mut self, file: &str, text: &str) -> Result<(), Diagnostic> {
        let path = format!("user/{file}");
        let snippet = Snippet::parse(&path, text, SourceKind::User)?;
        let slot = snippet.declaration().slot;
        if let Some(known) = self.path(slot, stem(file)).filter(|known| **known != *path) {
            let message =
                format!("`{known}` is already the {slot} snippet `{}`; give this file another name", stem(file));
            return Err(Diagnostic::new(&path, 1, 0, message));
        }
        self.add(snippet);
        Ok(())
    }

    fn insert_built_in(&mut self, path: &str, text: &str) -> Result<(), Diagnostic> {
        if text.starts_with("//! slot: ") {
            self.add(Snippet::parse(path, text, SourceKind::BuiltIn)?);
        } else {
            let path: Arc<str> = path.into();
            self.sources.insert(path.clone(), Source { path, text: text.into(), kind: SourceKind::BuiltIn });
        }
        Ok(())
    }

    fn add(&mut self, snippet: Snippet) {
        let (path, text, kind) = (snippet.path().clone(), snippet.text().clone(), snippet.kind());
        self.sources.insert(path.clone(), Source { path: path.clone(), text, kind });
        self.snippets.insert(path, snippet);
    }

    /// The file with this path.
    pub fn source(&self, path: &str) -> Option<&Source> {
        self.sources.get(path)
    }

    /// The declaration of the snippet with this path.
    pub fn declaration(&self, path: &str) -> Option<&Declaration> {
        self.snippets.get(path).map(Snippet::declaration)
    }

    /// The snippet of a slot by id (the file name without extension).
    pub fn snippet(&self, slot: Slot, id: &str) -> Option<&Snippet> {
        self.snippets.values().find(|snippet| snippet.declaration().slot == slot && snippet.id() == id)
    }

    /// Path of the snippet of a slot by id.
    pub fn path(&self, slot: Slot, id: &str) -> Option<Arc<str>> {
        self.snippet(slot, id).map(|snippet| snippet.path().clone())
    }

    /// Built-in and user snippets of a slot with their paths, sorted.
    pub fn snippets(&self, slot: Slot) -> impl Iterator<Item = (&Arc<str>, &Declaration)> {
        self.all(slot).map(|snippet| (snippet.path(), snippet.declaration()))
    }

    /// The same as values.
    pub fn all(&self, slot: Slot) -> impl Iterator<Item = &Snippet> {
        self.snippets.values().filter(move |snippet| snippet.declaration().slot == slot)
    }

    /// Id of a snippet: its file name without folder and extension.
    pub fn id(path: &str) -> &str {
        stem(path)
    }
}

/// The text of a snippet file.
fn read(path: &Path) -> Result<String, Diagnostic> {
    let file = path.display().to_string();
    let bytes = rayloom_files::read(path, limits::LONGEST as u64)
        .map_err(|error| Diagnostic::new(&file, 0, 0, format!("the snippet cannot be read: {error}")))?;
    String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..good]);
        let (line, column) = line_and_column(&before, good);
        Diagnostic::new(&file, line, column, "the snippet is no UTF-8 text from here on; save it in that encoding")
    })
}
