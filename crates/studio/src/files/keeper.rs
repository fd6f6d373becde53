//! One file that follows what changes often: written on a thread of its own, a quiet moment after the last change.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long nothing may have changed before the file is written.
const QUIET: Duration = Duration::from_secs(1);
/// How old a change may become while others follow it.
const PATIENCE: Duration = Duration::from_secs(5);

type Text = Box<dyn FnOnce() -> String + Send>;

enum Order {
    Write(Text),
    Remove,
}

/// Keeps a file up to date. Dropped, it writes what is due and ends.
pub(super) struct Keeper {
    orders: Option<Sender<Order>>,
    problems: Receiver<String>,
    thread: Option<JoinHandle<()>>,
}

impl Keeper {
    /// Starts the thread for a file, whose folder is made when it is first written.
    pub fn start(file: PathBuf) -> Self {
        let (orders, inbox) = channel();
        let (outbox, problems) = channel();
        let thread = std::thread::spawn(move || follow(&file, &inbox, &outbox));
        Self { orders: Some(orders), problems, thread: Some(thread) }
    }

    /// Has the file written with this text, unless another one comes first.
    pub fn write(&self, text: impl FnOnce() -> String + Send + 'static) {
        self.order(Order::Write(Box::new(text)));
    }

    /// Has the file removed.
    pub fn remove(&self) {
        self.order(Order::Remove);
    }

    /// Why the file could not be written; told once until it can be again.
    pub fn problem(&self) -> Option<String> {
        self.problems.try_recv().ok()
    }

    fn order(&self, order: Order) {
        if let Some(orders) = &self.orders {
            // The thread ends with this only, or by a panic, which was printed.
            let _ = orders.send(order);
        }
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            // A panic was printed when it happened.
            let _ = thread.join();
        }
    }
}

/// What is to be written, since when, and when at the latest.
struct Pending {
    text: Text,
    since: Instant,
    due: Instant,
}

fn follow(file: &Path, orders: &Receiver<Order>, problems: &Sender<String>) {
    let mut pending: Option<Pending> = None;
    let mut failing = false;
    loop {
        let order = match &pending {
            None => orders.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(pending) => orders.recv_timeout(pending.due.saturating_duration_since(Instant::now())),
        };
        let ends = matches!(order, Err(RecvTimeoutError::Disconnected));
        match order {
            Ok(Order::Write(text)) => {
                let now = Instant::now();
                let since = pending.map_or(now, |pending| pending.since);
                pending = Some(Pending { text, since, due: (now + QUIET).min(since + PATIENCE) });
                continue;
            }
            Ok(Order::Remove) => {
                pending = None;
                // It may never have been written.
                let _ = std::fs::remove_file(file);
            }
            Err(_) => {
                let written = pending.take().map(|pending| write(file, &(pending.text)()));
                if let Some(Err(error)) = &written
                    && !failing
                {
                    // The window may be gone; then nobody needs to know.
                    let _ = problems.send(format!("{} cannot be written: {error}", file.display()));
                }
                failing = written.is_some_and(|written| written.is_err());
            }
        }
        if ends {
            return;
        }
    }
}

fn write(file: &Path, text: &str) -> std::io::Result<()> {
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    rayloom_files::write(file, text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_text_is_written_and_an_unwritable_file_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("new").join("kept");
        let keeper = Keeper::start(file.clone());
        keeper.write(|| "first".into());
        keeper.write(|| "second".into());
        drop(keeper);
        assert_eq!(std::fs::read_to_string(&file).expect("written"), "second");
        let keeper = Keeper::start(file.clone());
        keeper.write(|| "third".into());
        keeper.remove();
        drop(keeper);
        assert!(!file.exists());
        std::fs::write(&file, "").expect("written");
        let keeper = Keeper::start(file.join("within a file"));
        keeper.write(String::new);
        let start = Instant::now();
        while keeper.problem().is_none() {
            assert!(start.elapsed() < 10 * QUIET, "nothing is told");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}
