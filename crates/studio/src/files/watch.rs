//! Notices when files change on the disk, by looking now and then: that works on every file system and with every way to
//! write a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime};

use egui::Context;

/// Time between two looks. A file has changed when two looks find the same that an earlier one did not, so that a file is
/// left alone while it is being written.
const PAUSE: Duration = Duration::from_millis(500);

/// What tells states of a file apart; `None` when it is not there.
type Stamp = Option<(u64, SystemTime)>;

/// Watches files on a thread of its own.
pub(super) struct Watch {
    wanted: Sender<BTreeSet<PathBuf>>,
    changed: Receiver<PathBuf>,
}

/// What is known of a file.
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

    /// Watches these files from now on.
    pub fn follow(&self, files: BTreeSet<PathBuf>) {
        // The thread ends with this only, or by a panic, which was printed.
        let _ = self.wanted.send(files);
    }

    /// A file that changed, or came, since the last call.
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
                    let now = stamp(&path);
                    known.entry(path).or_insert(Known { told: now, seen: now });
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                for (path, known) in &mut known {
                    let now = stamp(path);
                    let settled = known.seen == now;
                    known.seen = now;
                    if settled && now != known.told {
                        known.told = now;
                        if now.is_some() && changed.send(path.clone()).is_err() {
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
    Some((facts.len(), facts.modified().ok()?))
}
