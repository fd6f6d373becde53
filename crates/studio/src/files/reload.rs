//! Files that change on the disk are read again: data and snippets at once, the network's own file unless that would lose
//! changes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::task::Poll;

use egui::{Context, Ui};
use rayloom_network::{LoadError, Loaded, Network, PropertyKind, Value};
use rayloom_processors::{reload_snippets, snippet_library, snippet_revision, user_folder};
use rayloom_wgsl::Diagnostic;

use super::bar;
use super::watch::Watch;
use crate::later::Later;
use crate::session::{Session, Severity};

/// Watches the files of the document and the user's snippets.
pub(super) struct Reload {
    watch: Watch,
    /// The state of the document whose files are watched.
    watched: Option<(u64, Option<PathBuf>)>,
    reading: Option<Later<(PathBuf, Result<Loaded, LoadError>)>>,
    /// What another program wrote over the file of a document with changes.
    offer: Option<(PathBuf, Network)>,
    snippets: Option<PathBuf>,
    /// Whether snippets are other ones now, and what is wrong with them.
    reading_snippets: Option<Later<(bool, Arc<[Diagnostic]>)>>,
}

impl Reload {
    /// Watches nothing yet, and tells what is wrong with the user's snippets.
    pub fn new(session: &mut Session, context: &Context) -> Self {
        tell_problems(&snippet_library().1, session);
        Self {
            watch: Watch::start(context),
            watched: None,
            reading: None,
            offer: None,
            snippets: user_folder(),
            reading_snippets: None,
        }
    }

    /// To be called every frame.
    pub fn follow(&mut self, session: &mut Session, context: &Context) {
        self.watch_document(session);
        while let Some(path) = self.watch.changed() {
            if self.snippets.as_ref() == Some(&path) {
                self.reading_snippets = Some(Later::start(context, || {
                    let before = snippet_revision();
                    let problems = reload_snippets().1;
                    (snippet_revision() != before, problems)
                }));
            }
            if session.document.path() == Some(&path) {
                let (path, registry) = (path.clone(), session.registry.clone());
                self.reading = Some(Later::start(context, move || {
                    let loaded = Network::load(&path, &registry);
                    (path, loaded)
                }));
            }
            let readers: Vec<String> =
                files(session.network()).filter(|(_, file)| *file == path).map(|(id, _)| id.to_owned()).collect();
            if !readers.is_empty() {
                session.tell(Severity::Note, format!("{} changed and is read again", path.display()));
                session.engine.refresh(readers, &format!("{} changed", path.display()));
            }
        }
        if let Some(reading) = &self.reading
            && let Poll::Ready(read) = reading.poll()
        {
            self.reading = None;
            if let Some((path, loaded)) = read {
                self.take_in(path, loaded, session);
            }
        }
        if let Some(reading) = &self.reading_snippets
            && let Poll::Ready(read) = reading.poll()
        {
            self.reading_snippets = None;
            // What was saved here is in use already.
            if let Some((true, problems)) = read {
                session.tell(Severity::Note, "your snippets changed and were read again");
                tell_problems(&problems, session);
                session.engine.look_again();
            }
        }
    }

    /// Asks what becomes of the changes when the file has others.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let Some((path, _)) = &self.offer else { return };
        if session.document.path() != Some(path) {
            self.offer = None;
            return;
        }
        let text = format!("{} was changed by another program; so was the network here.", session.document.title());
        match (bar::show(ui, "changed on disk", &text, &["Keep mine", "Take the file's"]), self.offer.take()) {
            (Some(1), Some((path, network))) => replace(session, &path, network),
            (Some(_), _) => {}
            (None, offer) => self.offer = offer,
        }
    }

    fn watch_document(&mut self, session: &Session) {
        let path = session.document.path();
        let same = |(revision, file): &(u64, Option<PathBuf>)| {
            *revision == session.document.revision() && file.as_deref() == path
        };
        if self.watched.as_ref().is_some_and(same) {
            return;
        }
        self.watched = Some((session.document.revision(), path.map(Path::to_owned)));
        let data = files(session.network()).map(|(_, file)| file);
        let own = path.map(Path::to_owned).into_iter().chain(self.snippets.clone());
        self.watch.follow(data.chain(own).collect::<BTreeSet<_>>());
    }

    fn take_in(&mut self, path: PathBuf, loaded: Result<Loaded, LoadError>, session: &mut Session) {
        // Another document may be shown by now, or the change may be what was saved here.
        if session.document.path() != Some(&path) {
            return;
        }
        match loaded {
            Ok(loaded) if session.document.is_saved_as(&loaded.network) => {}
            Ok(loaded) if session.document.is_modified() => self.offer = Some((path, loaded.network)),
            Ok(loaded) => replace(session, &path, loaded.network),
            Err(error) => session.tell(Severity::Error, format!("the file changed, but not to a network: {error}")),
        }
    }
}

fn tell_problems(problems: &[Diagnostic], session: &mut Session) {
    for problem in problems {
        session.tell(Severity::Error, problem.to_string());
    }
}

/// Takes what the file has now; that can be undone.
fn replace(session: &mut Session, path: &Path, network: Network) {
    let taken = network.clone();
    session.edit("reload", |shown| {
        *shown = network;
        Ok::<(), std::convert::Infallible>(())
    });
    session.document.saved_as(path.to_owned(), &taken);
    session.tell(Severity::Note, format!("{} changed and was read again", path.display()));
}

/// The files that processors read, by processor.
fn files(network: &Network) -> impl Iterator<Item = (&str, PathBuf)> {
    network.processors().flat_map(|processor| {
        let decls = processor.declaration().map(|declaration| declaration.properties.as_slice()).unwrap_or_default();
        decls.iter().filter_map(|decl| match (&decl.kind, processor.value(&decl.id)) {
            (PropertyKind::File { save: false, .. }, Some(Value::Text(path))) if !path.is_empty() => {
                Some((processor.id(), PathBuf::from(path)))
            }
            _ => None,
        })
    })
}
