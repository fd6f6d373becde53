//! The snippets that a traversal can choose from.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use rayloom_network::{ProcessError, Properties};
use rayloom_wgsl::{Diagnostic, Library, Slot};

/// The folder of the user's own snippets: `$RAYLOOM_SNIPPETS`, or `rayloom/snippets` in the configuration folder.
pub fn user_folder() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("RAYLOOM_SNIPPETS") {
        return Some(folder.into());
    }
    let config = std::env::var_os("XDG_CONFIG_HOME").map(PathBuf::from);
    let config = config.or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".config")))?;
    Some(config.join("rayloom").join("snippets")).filter(|folder| folder.is_dir())
}

/// The built-in snippets and those of the user's folder, with what is wrong with the latter. Read once a program run.
pub fn snippet_library() -> (Arc<Library>, &'static [Diagnostic]) {
    static LIBRARY: OnceLock<(Arc<Library>, Vec<Diagnostic>)> = OnceLock::new();
    let (library, problems) = LIBRARY.get_or_init(|| {
        // Embedded at build time; every one is assembled and validated by the tests.
        let mut library = Library::built_in().expect("the built-in snippets declare themselves well");
        let problems = user_folder().map(|folder| library.add_folder(&folder)).unwrap_or_default();
        (Arc::new(library), problems)
    });
    (library.clone(), problems)
}

/// A slot of a traversal as the user sees it: once for every output in the case of compositing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    /// Id of the property that holds the snippet's id, and first part of its parameters' ids.
    pub id: &'static str,
    /// Id of the property that holds an edited text.
    pub text: &'static str,
    /// The slot.
    pub slot: Slot,
    /// The output, for compositing.
    pub output: Option<usize>,
    /// Name of the place in the assembled shader's parameters.
    pub prefix: &'static str,
}

const fn place(id: &'static str, text: &'static str, slot: Slot, output: Option<usize>, prefix: &'static str) -> Place {
    Place { id, text, slot, output, prefix }
}

/// All places, in the order of the property panel.
pub(super) const PLACES: [Place; 9] = [
    place("sampling", "sampling.text", Slot::Sampling, None, "sampling"),
    place("classification", "classification.text", Slot::Classification, None, "classification"),
    place("gradient", "gradient.text", Slot::Gradient, None, "gradient"),
    place("shading", "shading.text", Slot::Shading, None, "shading"),
    place("compositing", "compositing.text", Slot::Compositing, Some(0), "out1"),
    place("compositing2", "compositing2.text", Slot::Compositing, Some(1), "out2"),
    place("compositing3", "compositing3.text", Slot::Compositing, Some(2), "out3"),
    place("refinement", "refinement.text", Slot::Refinement, None, "refinement"),
    place("skipping", "skipping.text", Slot::Skipping, None, "skipping"),
];

impl Place {
    /// Library path of the snippet that the properties choose: the edited text if there is one, else the snippet by id.
    /// `None` where the choice is left to the program (`auto`).
    ///
    /// # Errors
    /// An unknown id, with the ids there are; a malformed edited text.
    pub fn path(&self, library: &mut Library, properties: &Properties) -> Result<Option<Arc<str>>, ProcessError> {
        let text = properties.text(self.text)?;
        if !text.trim().is_empty() {
            return Ok(Some(
                library.add_edited(self.id, self.slot, text).map_err(|problem| shader_error(vec![problem]))?,
            ));
        }
        let id = properties.text(self.id)?;
        if self.slot == Slot::Skipping && id == "auto" {
            return Ok(None);
        }
        self.find(library, id).map(Some)
    }

    fn find(&self, library: &Library, id: &str) -> Result<Arc<str>, ProcessError> {
        library.path(self.slot, id).ok_or_else(|| {
            let known: Vec<_> = library.snippets(self.slot).map(|(path, _)| Library::id(path)).collect();
            ProcessError::new(format!("there is no {} snippet `{id}`; there are {}", self.slot, known.join(", ")))
        })
    }
}

/// Shader diagnostics as a processor's error, each with its place in the source.
pub(super) fn shader_error(problems: Vec<Diagnostic>) -> ProcessError {
    let message = problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    let mark = |problem: &Diagnostic| rayloom_network::Mark {
        source: problem.file.clone(),
        line: problem.line,
        column: problem.column,
        message: problem.message.clone(),
    };
    // The message names the places already; marks are for editors, so only errors in source text carry them.
    ProcessError { message, marks: problems.iter().filter(|problem| problem.line > 0).map(mark).collect() }
}
