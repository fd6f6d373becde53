//! Copies of what is not saved yet, so that nothing is lost when the program ends without asking.
//!
//! Every running program has a copy of its own, `ID.json`, beside a file `ID.lock` that it holds locked as long as it runs;
//! the system lets go of the lock however the program ends. A copy whose lock can be taken is abandoned, and offered to the
//! user by the next program that starts.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use rayloom_network::{LoadError, Network, Registry};
use serde::{Deserialize, Serialize};

use super::keeper::Keeper;
use crate::document::Document;

/// The longest copy, bytes: as text within JSON, a network is at most twice as long as in its own file.
const LONGEST: u64 = 128 << 20;

/// What a copy holds.
#[derive(Serialize, Deserialize)]
struct Copy {
    /// The network's file, if it has one.
    original: Option<PathBuf>,
    /// When it was written, seconds since 1970.
    written: u64,
    /// The text of a network file, with whole paths.
    network: String,
}

/// A place for a copy, and the right to it.
struct Place {
    copy: PathBuf,
    lock: PathBuf,
    /// Locked until it is dropped.
    _right: File,
}

impl Place {
    /// The place with this id; `None` when another program has it.
    fn take(folder: &Path, id: &str) -> io::Result<Option<Self>> {
        let lock = folder.join(format!("{id}.lock"));
        let right = File::options().create(true).truncate(false).write(true).open(&lock)?;
        match right.try_lock() {
            // Whoever had it may have removed it just before it was locked here.
            Ok(()) if lock.exists() => Ok(Some(Self { copy: folder.join(format!("{id}.json")), lock, _right: right })),
            Ok(()) | Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(error),
        }
    }

    fn new(folder: &Path) -> io::Result<Self> {
        loop {
            let time = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_nanos();
            if let Some(place) = Self::take(folder, &format!("{}-{time}", std::process::id()))? {
                return Ok(place);
            }
        }
    }

    /// Removes the lock where there is no copy to guard.
    fn tidy(&self) {
        if !self.copy.exists() {
            // At worst an empty file stays, which the next program removes.
            let _ = std::fs::remove_file(&self.lock);
        }
    }
}

/// The copy of this program.
pub struct Recovery {
    /// Ends before the place is given up.
    keeper: Option<Keeper>,
    place: Place,
    /// The state of the document that the copy follows.
    followed: Option<(u64, bool)>,
}

impl Recovery {
    /// Takes a place in a folder, which is made.
    ///
    /// # Errors
    /// The folder cannot be made or written to.
    pub fn start(folder: &Path) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        Ok(Self::at(Place::new(folder)?))
    }

    fn at(place: Place) -> Self {
        Self { keeper: Some(Keeper::start(place.copy.clone())), place, followed: None }
    }

    /// Follows the document: there is a copy as long as it has changes that are not saved. Returns at once.
    pub fn follow(&mut self, document: &Document) {
        let state = (document.revision(), document.is_modified());
        if self.followed.replace(state) == Some(state) {
            return;
        }
        let Some(keeper) = &self.keeper else { return };
        if !document.is_modified() {
            return keeper.remove();
        }
        let (network, original) = (document.network().clone(), document.path().map(Path::to_owned));
        keeper.write(move || {
            let written = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs();
            let copy = Copy { original, written, network: network.to_text(None) };
            // Strings and numbers always make JSON.
            serde_json::to_string(&copy).unwrap_or_default()
        });
    }

    /// Removes the copy: the user does not want the changes.
    pub fn forget(&mut self) {
        if let Some(keeper) = &self.keeper {
            keeper.remove();
        }
    }

    /// Goes on in the place of a program that ended, so that its copy guards the changes until the next one is written.
    pub fn take_over(&mut self, abandoned: Abandoned) {
        self.forget();
        *self = Self::at(abandoned.place);
    }

    /// Why the copy could not be written.
    pub fn problem(&self) -> Option<String> {
        self.keeper.as_ref()?.problem()
    }
}

impl Drop for Recovery {
    fn drop(&mut self) {
        // Writes what is due.
        self.keeper = None;
        self.place.tidy();
    }
}

/// The copy of a program that ended without saving. It is nobody else's as long as this is held.
pub struct Abandoned {
    place: Place,
    copy: Copy,
}

impl Abandoned {
    /// All abandoned copies in a folder, newest first, and what is wrong with those that cannot be read. Waits for the disk.
    pub fn find(folder: &Path) -> (Vec<Self>, Vec<String>) {
        let (mut found, mut problems) = (Vec::new(), Vec::new());
        // No folder, no copies.
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let Some(id) = path.file_stem().map(|id| id.to_string_lossy().into_owned()) else { continue };
            if !path.extension().is_some_and(|extension| extension == "json" || extension == "lock") {
                continue;
            }
            match Place::take(folder, &id) {
                Ok(Some(place)) if place.copy.exists() => match read(&place.copy) {
                    Ok(copy) => found.push(Self { place, copy }),
                    Err(error) => problems.push(format!(
                        "{}: this copy of unsaved changes cannot be read: {error}. Remove it to be told no more.",
                        place.copy.display()
                    )),
                },
                Ok(Some(place)) => place.tidy(),
                Ok(None) => {}
                Err(error) => problems.push(format!("{}: {error}", path.display())),
            }
        }
        found.sort_by_key(|abandoned| std::cmp::Reverse(abandoned.copy.written));
        (found, problems)
    }

    /// The network's file, if it has one.
    pub fn original(&self) -> Option<&Path> {
        self.copy.original.as_deref()
    }

    /// How long ago the copy was written.
    pub fn age(&self) -> Duration {
        let written = UNIX_EPOCH + Duration::from_secs(self.copy.written);
        SystemTime::now().duration_since(written).unwrap_or_default()
    }

    /// The document as it was, not saved.
    ///
    /// # Errors
    /// The copy holds no network.
    pub fn document(&self, registry: &Arc<Registry>) -> Result<Document, LoadError> {
        let file = self.original().unwrap_or(Path::new(""));
        let loaded = Network::from_text(&self.copy.network, file, registry)?;
        Ok(Document::unsaved(loaded.network, self.copy.original.clone()))
    }

    /// Removes the copy for good.
    pub fn discard(self) {
        // Both may be gone already; whatever stays is offered again.
        let _ = std::fs::remove_file(&self.place.copy);
        self.place.tidy();
    }
}

fn read(file: &Path) -> Result<Copy, String> {
    let text = rayloom_files::read_text(file, LONGEST).map_err(|error| error.to_string())?;
    serde_json::from_str(&text).map_err(|error| error.to_string())
}
