//! A snippet with all that an assembly needs to know about it.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use crate::declaration::{Declaration, parse_declaration, stem};
use crate::diagnostic::Diagnostic;
use crate::library::SourceKind;
use crate::limits;
use crate::slot::Slot;

/// A snippet: its text and what it declares. Cheap to clone; two are equal when path and text are.
#[derive(Clone)]
pub struct Snippet(Arc<Inner>);

struct Inner {
    path: Arc<str>,
    text: Arc<str>,
    kind: SourceKind,
    declaration: Declaration,
}

impl Snippet {
    /// Reads the declaration at the head of a text.
    ///
    /// # Errors
    /// A malformed declaration, or a user's text that is too long.
    pub(crate) fn parse(path: &str, text: &str, kind: SourceKind) -> Result<Self, Diagnostic> {
        if kind != SourceKind::BuiltIn {
            limits::check_length(path, text)?;
        }
        let declaration = parse_declaration(path, text)?;
        Ok(Self(Arc::new(Inner { path: path.into(), text: text.into(), kind, declaration })))
    }

    /// A text edited for one place of one processor; it stands in the shader as `edited/PLACE.wgsl`.
    ///
    /// # Errors
    /// A malformed declaration, or one of another slot than the text is to fill.
    pub fn edited(place: &str, slot: Slot, text: &str) -> Result<Self, Diagnostic> {
        let path = format!("edited/{place}.wgsl");
        let snippet = Self::parse(&path, text, SourceKind::Edited)?;
        let declared = snippet.declaration().slot;
        if declared != slot {
            let message = format!("the text declares slot `{declared}`, but it is used as `{slot}`");
            return Err(Diagnostic::new(&path, 1, 0, message).with_excerpt(text));
        }
        Ok(snippet)
    }

    /// Path inside the library, such as `gradient/central.wgsl` or `user/mine.wgsl`.
    pub fn path(&self) -> &Arc<str> {
        &self.0.path
    }

    /// The text.
    pub fn text(&self) -> &Arc<str> {
        &self.0.text
    }

    /// Where it came from.
    pub fn kind(&self) -> SourceKind {
        self.0.kind
    }

    /// Whether it is not built in, but a user's.
    pub fn is_own(&self) -> bool {
        self.0.kind != SourceKind::BuiltIn
    }

    /// What it says about itself.
    pub fn declaration(&self) -> &Declaration {
        &self.0.declaration
    }

    /// Its id: the file name without folder and extension.
    pub fn id(&self) -> &str {
        stem(&self.0.path)
    }

    /// Whether it reads `word`, one of [`crate::READS`].
    pub fn reads(&self, word: &str) -> bool {
        self.0.declaration.reads.contains(word)
    }

    fn key(&self) -> (&str, &str) {
        (&self.0.path, &self.0.text)
    }
}

impl fmt::Debug for Snippet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.path)
    }
}

impl PartialEq for Snippet {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.key() == other.key()
    }
}

impl Eq for Snippet {}

impl PartialOrd for Snippet {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Snippet {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl Hash for Snippet {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}
