//! The document and its file: new, open, save, quit. Nothing here waits for a disk or a dialog; what would lose changes
//! that are not saved asks first.

mod bar;
mod folders;
mod keeper;
mod question;
mod recent;
mod recovery;
mod reload;
mod rescue;
mod settings;
mod watch;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::task::Poll;

use egui::{Context, ViewportCommand};
use rayloom_network::{LoadError, Network, Registry, SaveError, Warning};

use crate::dialogs::Question;
use crate::document::Document;
use crate::later::Later;
use crate::session::{Mode, Session, Severity};
use crate::visualization::Application;
use question::Decision;
use recent::RecentFiles;
use reload::Reload;
use rescue::Rescue;

pub use folders::Folders;
pub use recent::Recent;
pub use recovery::{Abandoned, Recovery};
pub use settings::{Preferences, Settings};

/// What a network file is called until its author names it.
const UNNAMED: &str = "network.json";

/// Something that puts an end to the document as it is shown.
enum Next {
    /// An empty network.
    New,
    /// A network file that the user chooses.
    Choose,
    /// This network file.
    Open(PathBuf),
    /// What a program that ended without saving left behind.
    Recover,
    /// The end of the program.
    Quit,
}

type Opened = Result<(Document, Vec<Warning>), LoadError>;
type Saved = Result<(PathBuf, Network), SaveError>;

/// What goes on away from the window's thread; one thing at a time.
enum Work {
    Opening(Later<Option<Opened>>),
    Saving(Later<Option<Saved>>),
}

/// What goes on with the document's file.
pub struct Files {
    work: Option<Work>,
    /// Waits for the user to say what becomes of the changes.
    question: Option<Next>,
    /// Waits for the changes to be saved.
    after_saving: Option<Next>,
    /// Whether the window may close now.
    may_close: bool,
    rescue: Rescue,
    recent: RecentFiles,
    reload: Reload,
}

impl Files {
    /// Keeps what belongs to the user in these folders; with none, nothing is kept.
    pub fn new(folders: Option<&Folders>, session: &mut Session, context: &Context) -> Self {
        let rescue = folders.map(|folders| Rescue::start(&folders.state.join("recovery"), context));
        let rescue = rescue.transpose().unwrap_or_else(|problem| {
            session.tell(Severity::Error, problem);
            None
        });
        let mut recent = RecentFiles::new(folders.map(|folders| folders.state.as_path()));
        session.document.path().into_iter().for_each(|path| recent.add(path));
        Self {
            work: None,
            question: None,
            after_saving: None,
            may_close: false,
            rescue: rescue.unwrap_or_default(),
            recent,
            reload: Reload::new(session, context),
        }
    }

    /// The files opened lately, newest first.
    pub fn recent(&mut self, context: &Context) -> &[Recent] {
        self.recent.list(context)
    }

    /// Whether the user has to decide something before anything else.
    pub fn is_asking(&self) -> bool {
        self.question.is_some()
    }

    /// Begins an empty network.
    pub fn new_network(&mut self, session: &mut Session, context: &Context) {
        self.leave(Next::New, session, context);
    }

    /// Asks for a network file and opens it.
    pub fn choose(&mut self, session: &mut Session, context: &Context) {
        self.leave(Next::Choose, session, context);
    }

    /// Opens a network file; an application is shown as such.
    pub fn open(&mut self, path: &Path, session: &mut Session, context: &Context) {
        self.leave(Next::Open(path.to_owned()), session, context);
    }

    /// Closes the window.
    pub fn quit(&mut self, session: &mut Session, context: &Context) {
        self.leave(Next::Quit, session, context);
    }

    /// Saves the document to its file, or to one that the user chooses.
    pub fn save(&mut self, session: &mut Session, context: &Context) {
        match session.document.path().map(Path::to_owned) {
            Some(path) => self.start_saving(session, |session| {
                let network = session.network().clone();
                Later::start(context, move || Some(write(path, network)))
            }),
            None => self.save_as(session, context),
        }
    }

    /// Saves the document to a file that the user chooses.
    pub fn save_as(&mut self, session: &mut Session, context: &Context) {
        self.start_saving(session, |session| {
            let path = session.document.path();
            let name = path.and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
            let extensions = ["json".to_owned()];
            let question = Question {
                name: "Rayloom network",
                extensions: &extensions,
                folder: path.and_then(Path::parent),
                save_as: Some(name.as_deref().unwrap_or(UNNAMED)),
            };
            let network = session.network().clone();
            session.chooser.ask(context, &question, move |path| write(path, network))
        });
    }

    /// Whether a file is being opened or saved, and which.
    pub fn working(&self) -> Option<&'static str> {
        self.work.as_ref().map(|work| match work {
            Work::Opening(_) => "opening",
            Work::Saving(_) => "saving",
        })
    }

    /// To be called at the beginning of a frame: takes in what was opened and saved meanwhile, and keeps the window open
    /// while there is something to decide.
    pub fn begin_frame(&mut self, session: &mut Session, context: &Context) {
        if context.input(|input| input.viewport().close_requested()) && !self.may_close {
            context.send_viewport_cmd(ViewportCommand::CancelClose);
            self.quit(session, context);
        }
        if let Some(path) = dropped_network(context) {
            self.open(&path, session, context);
        }
        self.reload.follow(session, context);
        if let Some(problem) = self.recent.follow(context) {
            session.tell(Severity::Error, problem);
        }
        match self.work.take() {
            None => {}
            Some(Work::Opening(task)) => match task.poll() {
                Poll::Pending => self.work = Some(Work::Opening(task)),
                Poll::Ready(opened) => self.take_in_opened(opened.flatten(), session),
            },
            Some(Work::Saving(task)) => match task.poll() {
                Poll::Pending => self.work = Some(Work::Saving(task)),
                Poll::Ready(saved) => self.take_in_saved(saved.flatten(), session, context),
            },
        }
    }

    /// Shows what there is to decide that can wait.
    pub fn bars(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.reload.show(ui, session);
        if self.rescue.show(ui) {
            self.leave(Next::Recover, session, ui.ctx());
        }
    }

    /// To be called at the end of a frame, after every edit: keeps unsaved changes safe.
    pub fn end_frame(&mut self, session: &mut Session) {
        if !self.may_close {
            self.rescue.follow(session);
        }
    }

    /// Shows the question what becomes of the changes, if there is one.
    pub fn show(&mut self, session: &mut Session, context: &Context) {
        let Some(next) = &self.question else { return };
        let name = session.document.path().map_or("this network".into(), |_| session.document.title());
        let verb = match next {
            Next::Quit => "quitting",
            Next::New | Next::Choose | Next::Open(_) | Next::Recover => "leaving it",
        };
        let Some(decision) = question::show(context, &name, verb, session.mode == Mode::Development) else { return };
        let Some(next) = self.question.take() else { return };
        match decision {
            Decision::Save => {
                self.after_saving = Some(next);
                self.save(session, context);
            }
            Decision::Discard => self.go(next, session, context),
            Decision::Cancel => {}
        }
    }

    /// Goes on to something else, after asking about changes that would be lost.
    fn leave(&mut self, next: Next, session: &mut Session, context: &Context) {
        if matches!(self.work, Some(Work::Saving(_))) {
            self.after_saving = Some(next);
        } else if session.document.is_modified() {
            self.question = Some(next);
        } else {
            self.go(next, session, context);
        }
    }

    fn go(&mut self, next: Next, session: &mut Session, context: &Context) {
        let registry = session.registry.clone();
        match next {
            Next::New => session.show(Document::new(registry), &[]),
            Next::Choose => {
                let extensions = ["json".to_owned()];
                let folder = session.document.path().and_then(Path::parent);
                let question = Question { name: "Rayloom network", extensions: &extensions, folder, save_as: None };
                let task = session.chooser.ask(context, &question, move |path| Document::load(&path, &registry));
                self.work = Some(Work::Opening(task));
            }
            Next::Open(path) => {
                let task = Later::start(context, move || Some(Document::load(&path, &registry)));
                self.work = Some(Work::Opening(task));
            }
            Next::Recover => self.rescue.recover(session),
            Next::Quit => {
                self.rescue.forget();
                self.may_close = true;
                context.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    fn start_saving(&mut self, session: &mut Session, start: impl FnOnce(&Session) -> Later<Option<Saved>>) {
        if let Some(Work::Saving(_)) = &self.work {
            session.tell(Severity::Note, "the network is being saved already; save again when that is done");
            return;
        }
        self.work = Some(Work::Saving(start(session)));
    }

    fn take_in_opened(&mut self, opened: Option<Opened>, session: &mut Session) {
        match opened {
            None => {}
            Some(Ok((document, warnings))) => {
                document.path().into_iter().for_each(|path| self.recent.add(path));
                session.show(document, &warnings);
                session.mode = Application::mode_of(session.network());
                if session.mode == Mode::Visualization {
                    session.tell(Severity::Note, "F5 shows the network behind the application, and goes back");
                }
            }
            Some(Err(error)) => session.tell(Severity::Error, error.to_string()),
        }
    }

    fn take_in_saved(&mut self, saved: Option<Saved>, session: &mut Session, context: &Context) {
        let next = self.after_saving.take();
        match saved {
            None => {}
            Some(Err(error)) => session.tell(Severity::Error, error.to_string()),
            Some(Ok((path, network))) => {
                session.tell(Severity::Note, format!("saved {}", path.display()));
                self.recent.add(&path);
                session.document.saved_as(path, &network);
                if let Some(next) = next {
                    self.leave(next, session, context);
                }
            }
        }
    }
}

/// A network file dropped onto the window. Other files are for the network panel, which makes sources of them.
fn dropped_network(context: &Context) -> Option<PathBuf> {
    let is_network = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        name.ends_with(".json") && !name.ends_with(".volume.json")
    };
    context.input_mut(|input| {
        let (networks, others): (Vec<_>, Vec<_>) =
            std::mem::take(&mut input.raw.dropped_files).into_iter().partition(|file| is_network(file.path()));
        input.raw.dropped_files = others;
        networks.first().map(|file| file.path().to_owned())
    })
}

fn write(path: PathBuf, network: Network) -> Saved {
    network.save(&path).map(|()| (path, network))
}

/// The document that the program starts with, and what to tell about it; before there is a window that could wait.
pub fn first_document(path: Option<&Path>, registry: &Arc<Registry>) -> (Document, Vec<Warning>, Option<LoadError>) {
    match path.map(|path| Document::load(path, registry)) {
        None => (Document::new(registry.clone()), Vec::new(), None),
        Some(Ok((document, warnings))) => (document, warnings, None),
        Some(Err(error)) => (Document::new(registry.clone()), Vec::new(), Some(error)),
    }
}
