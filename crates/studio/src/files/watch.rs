//! Notices when files and folders of snippets change on the disk, by looking now and then: that works on every file system and with every way to
//! write a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime};

use egui::Context;

/// Time between two looks. A file has changed when two looks find the same that an earlier one did not, so that a file is
/// left alone while it is being written.
const PAUSE: Duration = Duration::from_millis(500);

/// What tells states of a file, or of the snippets in a folder, apart; `None` when it is not there.
type Stamp = Option<BTreeMap<PathBuf, (u64, SystemTime)>>;

/// Watches files on a thread of its own.
pub(super) struct Watch {
    wanted: Sender<BTreeSet<PathBuf>>,
    changed: Receiver<PathBuf>,
}

/// What is known of a file or folder.
struct Known {
    told: Stamp,
    seen: Stamp,
}

impl Watch {
    /// Watches nothing yet; the window is woken by changes.
    pub fn start(context: &Context) -> Self {
        let (wanted, orders) = channel();
        let (outbox, changed) = channel();
        let context = context.clone();
        // Ends with its owner.
        std::thread::spawn(move || look(&orders, &outbox, &context));
        Self { wanted, changed }
    }

    /// Watches these files, and the snippets in these folders, from now on.
    pub fn follow(&self, files: BTreeSet<PathBuf>) {
        // The thread ends with this only, or by a panic, which was printed.
        let _ = self.wanted.send(files);
    }

    /// One of them that changed, or came, since the last call.
    pub fn changed(&self) -> Option<PathBuf> {
        self.changed.try_recv().ok()
    }
}

fn look(orders: &Receiver<BTreeSet<PathBuf>>, changed: &Sender<PathBuf>, context: &Context) {
    let mut known: BTreeMap<PathBuf, Known> = BTreeMap::new();
    loop {
        match orders.recv_timeout(PAUSE) {
            Ok(wanted) => {
                known.retain(|path, _| wanted.contains(path));
                for path in wanted {
                    known.entry(path).or_insert_with_key(|path| {
                        let now = stamp(path);
                        Known { told: now.clone(), seen: now }
                    });
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                for (path, known) in &mut known {
                    let now = stamp(path);
                    let settled = known.seen == now;
                    known.seen.clone_from(&now);
                    if settled && now != known.told {
                        known.told = now;
                        if known.told.is_some() && changed.send(path.clone()).is_err() {
                            return;
                        }
                        context.request_repaint();
                    }
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

fn stamp(path: &Path) -> Stamp {
    let facts = std::fs::metadata(path).ok()?;
    if !facts.is_dir() {
        return Some([(path.to_owned(), (facts.len(), facts.modified().ok()?))].into());
    }
    let files = std::fs::read_dir(path).ok()?.flatten().map(|entry| entry.path());
    let snippets = files.filter(|file| file.extension().is_some_and(|extension| extension == "wgsl"));
    Some(
        snippets
            .filter_map(|file| {
                let facts = std::fs::metadata(&file).ok()?;
                let state = (facts.len(), facts.modified().ok()?);
                Some((file, state))
            })
            .collect(),
    )
}
