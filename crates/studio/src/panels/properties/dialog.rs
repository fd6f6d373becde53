//! File dialogs that do not block the window.

use std::collections::HashMap;
use std::future::Future;
use std::path::{Path, PathBuf};
use std::pin::pin;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::task::{Context, Poll, Wake, Waker};
use std::thread::Thread;

use egui::Id;

/// What a dialog asks for.
pub(super) struct Question<'a> {
    /// What the files are.
    pub name: &'a str,
    /// Their extensions without the dot; empty for any.
    pub extensions: &'a [String],
    /// The folder to begin in.
    pub folder: Option<&'a Path>,
    /// A name to save as, for a file that is to be written.
    pub save_as: Option<&'a str>,
}

/// The open dialogs, by who asked.
#[derive(Default)]
pub(super) struct Dialogs(HashMap<Id, Receiver<Option<PathBuf>>>);

impl Dialogs {
    /// Opens a dialog, unless the one who asks has one open already.
    pub fn ask(&mut self, who: Id, context: &egui::Context, question: &Question<'_>) {
        if self.0.contains_key(&who) {
            return;
        }
        let mut dialog = rfd::AsyncFileDialog::new();
        if !question.extensions.is_empty() {
            dialog = dialog.add_filter(question.name, question.extensions);
        }
        if let Some(folder) = question.folder {
            dialog = dialog.set_directory(folder);
        }
        let (answer, answers) = channel();
        self.0.insert(who, answers);
        let context = context.clone();
        // The dialog belongs to this thread, as some systems demand; only the waiting is done elsewhere.
        match question.save_as {
            Some(name) => wait_for(dialog.set_file_name(name).save_file(), answer, context),
            None => wait_for(dialog.pick_file(), answer, context),
        }
    }

    /// The file chosen since the last call, if any.
    pub fn answer(&mut self, who: Id) -> Option<PathBuf> {
        match self.0.get(&who)?.try_recv() {
            Err(TryRecvError::Empty) => None,
            answer => {
                self.0.remove(&who);
                answer.ok().flatten()
            }
        }
    }

    /// Whether a dialog is open.
    pub fn is_open(&self, who: Id) -> bool {
        self.0.contains_key(&who)
    }
}

fn wait_for(
    choice: impl Future<Output = Option<rfd::FileHandle>> + Send + 'static,
    answer: std::sync::mpsc::Sender<Option<PathBuf>>,
    context: egui::Context,
) {
    std::thread::spawn(move || {
        let chosen = block_on(choice).map(|file| file.path().to_owned());
        // The panel may be gone; then nobody needs the answer.
        let _ = answer.send(chosen);
        context.request_repaint();
    });
}

struct Unpark(Thread);

impl Wake for Unpark {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }
}

fn block_on<T>(future: impl Future<Output = T>) -> T {
    let waker = Waker::from(Arc::new(Unpark(std::thread::current())));
    let mut future = pin!(future);
    loop {
        match future.as_mut().poll(&mut Context::from_waker(&waker)) {
            Poll::Ready(value) => return value,
            Poll::Pending => std::thread::park(),
        }
    }
}
