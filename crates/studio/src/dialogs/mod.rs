//! Asking the user for a file: the dialog and what is done with the file stay away from the window's thread.

mod typed;

use std::collections::HashMap;
use std::future::Future;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::Arc;
use std::task::Poll;
use std::time::{Duration, Instant};

use egui::{Context, Id};

use crate::later::Later;
use typed::TypedPaths;

/// A dialog that was cancelled sooner than this was never there: no portal answers, no program that shows one is installed.
const NEVER_SHOWN: Duration = Duration::from_millis(500);

/// What a dialog asks for.
pub struct Question<'a> {
    /// What the files are.
    pub name: &'a str,
    /// Their extensions without the dot; empty for any.
    pub extensions: &'a [String],
    /// The folder to begin in.
    pub folder: Option<&'a Path>,
    /// A name to save as, for a file that is to be written.
    pub save_as: Option<&'a str>,
}

/// The file that the user is choosing; `None` in the end when the dialog was cancelled.
pub type Choice = Pin<Box<dyn Future<Output = Option<PathBuf>> + Send>>;

/// Whom to ask for files: the system's dialogs by default, anything else in tests.
#[derive(Clone)]
pub struct Chooser {
    ask: Arc<dyn Fn(&Question<'_>) -> Choice + Send + Sync>,
    typed: TypedPaths,
}

impl Default for Chooser {
    fn default() -> Self {
        Self::new(system_dialog)
    }
}

impl std::fmt::Debug for Chooser {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Chooser")
    }
}

impl Chooser {
    /// Asks this function, on the window's thread; it must return at once. Where it answers at once that nothing was chosen, the
    /// path is asked for in the window.
    pub fn new(ask: impl Fn(&Question<'_>) -> Choice + Send + Sync + 'static) -> Self {
        Self { ask: Arc::new(ask), typed: TypedPaths::default() }
    }

    /// Asks for a file and works with it. `None` in the end when the user cancelled.
    pub(crate) fn ask<T: Send + 'static>(
        &self,
        context: &Context,
        question: &Question<'_>,
        work: impl FnOnce(PathBuf) -> T + Send + 'static,
    ) -> Later<Option<T>> {
        // The dialog is made on the window's thread, as some systems demand; only the waiting is done elsewhere.
        let (asked, choice) = (Instant::now(), (self.ask)(question));
        let (typed, window) = (self.typed.clone(), context.clone());
        let verb = if question.save_as.is_some() { "Save" } else { "Open" };
        let heading = format!("{verb}: {}", question.name);
        let folder = question.folder.map(|folder| folder.join(question.save_as.unwrap_or_default()));
        let text = folder.map(|path| path.display().to_string()).or(question.save_as.map(str::to_owned));
        Later::start(context, move || {
            let chosen = pollster::block_on(choice);
            let never_shown = chosen.is_none() && asked.elapsed() < NEVER_SHOWN;
            let chosen = if never_shown { typed.ask(&window, heading, text.unwrap_or_default()) } else { chosen };
            chosen.map(work)
        })
    }

    /// Shows what the window itself asks for. To be called every frame.
    pub(crate) fn show(&self, context: &Context) {
        self.typed.show(context);
    }
}

fn system_dialog(question: &Question<'_>) -> Choice {
    let mut dialog = rfd::AsyncFileDialog::new();
    if !question.extensions.is_empty() {
        dialog = dialog.add_filter(question.name, question.extensions);
    }
    if let Some(folder) = question.folder {
        dialog = dialog.set_directory(folder);
    }
    let path = |file: Option<rfd::FileHandle>| file.map(|file| file.path().to_owned());
    match question.save_as {
        Some(name) => {
            let choice = dialog.set_file_name(name).save_file();
            Box::pin(async move { path(choice.await) })
        }
        None => {
            let choice = dialog.pick_file();
            Box::pin(async move { path(choice.await) })
        }
    }
}

/// The dialogs that are open, by who asked, and what comes of the chosen files.
pub(crate) struct Dialogs<T>(HashMap<Id, Later<Option<T>>>);

impl<T> Default for Dialogs<T> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<T: Send + 'static> Dialogs<T> {
    /// Opens a dialog, unless the one who asks has one open already.
    pub fn ask(
        &mut self,
        who: Id,
        context: &Context,
        chooser: &Chooser,
        question: &Question<'_>,
        work: impl FnOnce(PathBuf) -> T + Send + 'static,
    ) {
        self.0.entry(who).or_insert_with(|| chooser.ask(context, question, work));
    }

    /// What came of the file chosen since the last call, if any.
    pub fn answer(&mut self, who: Id) -> Option<T> {
        match self.0.get(&who)?.poll() {
            Poll::Pending => None,
            Poll::Ready(answer) => {
                self.0.remove(&who);
                answer.flatten()
            }
        }
    }

    /// Whether a dialog is open.
    pub fn is_open(&self, who: Id) -> bool {
        self.0.contains_key(&who)
    }
}
