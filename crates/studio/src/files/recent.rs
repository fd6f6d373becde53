//! The network files opened lately, in all runs of the program.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::task::Poll;
use std::time::{Duration, Instant};

use egui::Context;

use crate::later::Later;

/// Files remembered at most.
const MOST: usize = 12;
/// The longest list, bytes.
const LONGEST: u64 = 1 << 20;
/// How old the knowledge may be which of them exist.
const FRESH: Duration = Duration::from_secs(5);

/// A file opened lately.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recent {
    /// The file.
    pub path: PathBuf,
    /// Whether it is still there.
    pub exists: bool,
}

/// The list, newest first.
pub struct RecentFiles {
    /// Where the list is kept.
    file: Option<PathBuf>,
    list: Vec<Recent>,
    reading: Option<Later<Result<Vec<Recent>, String>>>,
    /// Files to be put first when what is being read has come.
    new: Vec<PathBuf>,
    read: Option<Instant>,
}

impl RecentFiles {
    /// The list in this folder; without one, nothing is remembered.
    pub fn new(folder: Option<&Path>) -> Self {
        let file = folder.map(|folder| folder.join("recent.json"));
        Self { file, list: Vec::new(), reading: None, new: Vec::new(), read: None }
    }

    /// Puts a file first.
    pub fn add(&mut self, path: &Path) {
        self.new.extend(std::path::absolute(path).ok());
    }

    /// To be called every frame; what could not be read or written.
    pub fn follow(&mut self, context: &Context) -> Option<String> {
        let mut problem = None;
        if let Some(reading) = &self.reading
            && let Poll::Ready(read) = reading.poll()
        {
            self.reading = None;
            self.read = Some(Instant::now());
            match read {
                Some(Ok(list)) => self.list = list,
                Some(Err(error)) => problem = Some(error),
                None => {}
            }
        }
        if self.reading.is_none() && !self.new.is_empty() {
            self.refresh(context);
        }
        problem
    }

    /// The files as far as known now; asks the disk again when that was a while ago.
    pub fn list(&mut self, context: &Context) -> &[Recent] {
        if self.reading.is_none() && self.read.is_none_or(|read| read.elapsed() > FRESH) {
            self.refresh(context);
        }
        &self.list
    }

    fn refresh(&mut self, context: &Context) {
        let Some(file) = self.file.clone() else { return };
        let new = std::mem::take(&mut self.new);
        self.reading = Some(Later::start(context, move || update(&file, &new)));
    }
}

/// Reads the list, puts files first in it, and says which of all exist.
fn update(file: &Path, new: &[PathBuf]) -> Result<Vec<Recent>, String> {
    static TURN: Mutex<()> = Mutex::new(());
    let _turn = TURN.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let fail = |error: &dyn std::fmt::Display| format!("{}: the list of recent files: {error}", file.display());
    let known: Vec<PathBuf> = match rayloom_files::read_text(file, LONGEST) {
        // A list that cannot be read is begun anew.
        Ok(text) => serde_json::from_str(&text).unwrap_or_default(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(fail(&error)),
    };
    let mut paths: Vec<PathBuf> = Vec::new();
    for path in new.iter().rev().chain(&known) {
        if paths.len() < MOST && !paths.contains(path) {
            paths.push(path.clone());
        }
    }
    if paths != known {
        let text = serde_json::to_string_pretty(&paths).map_err(|error| fail(&error))?;
        let folder = file.parent().map_or(Ok(()), std::fs::create_dir_all);
        folder.and_then(|()| rayloom_files::write(file, text.as_bytes())).map_err(|error| fail(&error))?;
    }
    Ok(paths.into_iter().map(|path| Recent { exists: path.is_file(), path }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_come_first_once_and_missing_ones_are_known() {
        let folder = tempfile::tempdir().expect("a folder");
        let list = folder.path().join("deep").join("recent.json");
        let real = folder.path().join("real.json");
        std::fs::write(&real, "").expect("written");
        let gone = folder.path().join("gone.json");
        update(&list, &[real.clone(), gone.clone()]).expect("updated");
        let expected = vec![Recent { path: real.clone(), exists: true }, Recent { path: gone, exists: false }];
        assert_eq!(update(&list, std::slice::from_ref(&real)).expect("updated"), expected);
        assert_eq!(update(&list, &[]).expect("read"), expected);
        std::fs::write(&list, "{").expect("written");
        assert_eq!(update(&list, &[]).expect("read"), []);
        let many: Vec<PathBuf> = (0..40).map(|index| folder.path().join(index.to_string())).collect();
        let kept = update(&list, &many).expect("updated");
        assert_eq!((kept.len(), &kept[0].path), (MOST, &many[39]));
    }
}
