//! The snippets that a traversal can choose from.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use rayloom_network::{ProcessError, Properties};
use rayloom_wgsl::{At, Diagnostic, Library, Slot, Snippet, parse_declaration};

/// Names the folder of the user's own snippets.
const FOLDER: &str = "RAYLOOM_SNIPPETS";

/// Where the folder of the user's own snippets is or would be: `$RAYLOOM_SNIPPETS`, or `rayloom/snippets` in the configuration
/// folder.
pub fn user_folder() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os(FOLDER) {
        return Some(folder.into());
    }
    let config = std::env::var_os("XDG_CONFIG_HOME").map(PathBuf::from);
    let config = config.or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".config")))?;
    Some(config.join("rayloom").join("snippets"))
}

/// Snippets with what is wrong with the user's own.
type Loaded = (Arc<Library>, Arc<[Diagnostic]>);

static LIBRARY: RwLock<Option<Loaded>> = RwLock::new(None);
static REVISION: AtomicU64 = AtomicU64::new(0);

/// The built-in snippets and those of the user's folder, with what is wrong with the latter, as they were read last.
pub fn snippet_library() -> Loaded {
    let known = LIBRARY.read().unwrap_or_else(PoisonError::into_inner).clone();
    known.unwrap_or_else(reload_snippets)
}

/// Reads the user's folder anew. A folder that nobody named may be missing.
pub fn reload_snippets() -> Loaded {
    // Embedded at build time; every one is assembled and validated by the tests.
    let mut library = Library::built_in().expect("the built-in snippets declare themselves well");
    let folder = user_folder().filter(|folder| std::env::var_os(FOLDER).is_some() || folder.is_dir());
    let problems = folder.map(|folder| library.add_folder(&folder)).unwrap_or_default();
    let loaded: Loaded = (Arc::new(library), problems.into());
    let before = LIBRARY.write().unwrap_or_else(PoisonError::into_inner).replace(loaded.clone());
    if before.as_ref() != Some(&loaded) {
        REVISION.fetch_add(1, Ordering::Relaxed);
    }
    loaded
}

/// A number that grows whenever something else is found in the user's folder.
pub fn snippet_revision() -> u64 {
    REVISION.load(Ordering::Relaxed)
}

/// Writes a snippet into the user's folder and reads that anew; the name becomes the snippet's id. Returns the file.
///
/// # Errors
/// A name that cannot be an id, or is another snippet's; a text that declares no snippet of this slot; the file cannot be
/// written: as a sentence.
pub fn save_user_snippet(slot: Slot, name: &str, text: &str) -> Result<PathBuf, String> {
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Err(format!("`{name}` cannot be the name of a snippet; use letters, digits and underscores"));
    }
    let file = format!("{name}.wgsl");
    let declared = parse_declaration(&file, text).map_err(|problem| problem.to_string())?.slot;
    if declared != slot {
        return Err(format!(
            "the text declares slot `{declared}`, but it was edited as `{slot}`; change its first line"
        ));
    }
    let mut trial = (*snippet_library().0).clone();
    let taken = trial.declaration(&format!("user/{file}")).map(|known| known.slot).filter(|known| *known != slot);
    if let Some(other) = taken {
        return Err(format!("`{name}` is already a {other} snippet of yours; choose another name"));
    }
    trial.add_user(&file, text).map_err(|problem| problem.to_string())?;
    let folder =
        user_folder().ok_or("there is no place for snippets of your own; name a folder in RAYLOOM_SNIPPETS")?;
    let path = folder.join(&file);
    let written = std::fs::create_dir_all(&folder).and_then(|()| rayloom_files::write(&path, text.as_bytes()));
    written.map_err(|error| format!("{} cannot be written: {error}", path.display()))?;
    reload_snippets();
    Ok(path)
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
}

const fn place(id: &'static str, text: &'static str, slot: Slot, output: Option<usize>) -> Place {
    Place { id, text, slot, output }
}

/// All places, in the order of the property panel.
pub(super) const PLACES: [Place; 9] = [
    place("sampling", "sampling.text", Slot::Sampling, None),
    place("classification", "classification.text", Slot::Classification, None),
    place("gradient", "gradient.text", Slot::Gradient, None),
    place("shading", "shading.text", Slot::Shading, None),
    place("compositing", "compositing.text", Slot::Compositing, Some(0)),
    place("compositing2", "compositing2.text", Slot::Compositing, Some(1)),
    place("compositing3", "compositing3.text", Slot::Compositing, Some(2)),
    place("refinement", "refinement.text", Slot::Refinement, None),
    place("skipping", "skipping.text", Slot::Skipping, None),
];

impl Place {
    /// Whether it is where a snippet stands in a shader.
    pub fn is_at(&self, slot: Slot, at: At) -> bool {
        let output = match at {
            At::Output(output) => Some(output),
            At::Ray | At::Source(_) => None,
        };
        (self.slot, self.output) == (slot, output)
    }

    /// The snippet that the properties choose: the edited text if there is one, else the snippet by id.
    /// `None` where the choice is left to the program (`auto`).
    ///
    /// # Errors
    /// An unknown id, with the ids there are; a malformed edited text.
    pub fn snippet(&self, library: &Library, properties: &Properties) -> Result<Option<Snippet>, ProcessError> {
        let text = properties.text(self.text)?;
        if !text.trim().is_empty() {
            let edited = Snippet::edited(self.id, self.slot, text);
            return Ok(Some(edited.map_err(|problem| shader_error(vec![problem]))?));
        }
        let id = properties.text(self.id)?;
        if self.slot == Slot::Skipping && id == "auto" {
            return Ok(None);
        }
        self.find(library, id).map(Some)
    }

    fn find(&self, library: &Library, id: &str) -> Result<Snippet, ProcessError> {
        library.snippet(self.slot, id).cloned().ok_or_else(|| {
            let file = format!("user/{id}.wgsl");
            let own: Vec<_> = snippet_library().1.iter().filter(|problem| problem.file == file).cloned().collect();
            if !own.is_empty() {
                return shader_error(own);
            }
            let known: Vec<_> = library.all(self.slot).map(Snippet::id).collect();
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
