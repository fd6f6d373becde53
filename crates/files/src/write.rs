//! Writing a file, all or nothing.
//!
//! The new contents go into a file of their own in the same folder, onto the disk, and then in the place of the old file by
//! one rename. Whoever reads finds the old file or the new one; a full disk, a kill or a loss of power in between leaves the
//! old one. What a killed program leaves behind is removed by the next one that writes into the folder: an unfinished file is
//! locked by its writer, and the system lets go of the lock however that ends.

use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::open::Kind;

/// Beginning and end of the names of unfinished files.
const PREFIX: &str = ".rayloom-";
const SUFFIX: &str = ".unfinished";

/// Links that may follow one another.
const MOST_LINKS: usize = 40;

/// Replaces a file, or makes it: a reader sees the old file or the new one, never a part. Through a symbolic link, the file
/// that it leads to is replaced and the link stays. Permissions stay, and so does the owner where the system lets them. A
/// device or FIFO, which has nothing to lose, is written into.
///
/// # Errors
/// The folder or file cannot be written, or the path is a folder; what was there before is untouched.
pub fn write(file: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = behind_links(file)?;
    let old = match fs::metadata(&target) {
        Ok(old) => Some(old),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    match old.as_ref().map(|old| Kind::from(old.file_type())) {
        None | Some(Kind::File) => replace(&target, old.as_ref(), bytes),
        Some(Kind::Folder) => Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder; name a file in it")),
        Some(_) => File::options().write(true).open(&target)?.write_all(bytes),
    }
}

/// What a chain of symbolic links leads to, which need not be there yet.
fn behind_links(file: &Path) -> io::Result<PathBuf> {
    let mut target = std::path::absolute(file)?;
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&target) else { return Ok(target) };
        // Links into /proc, such as /dev/stdout, lead to what has no path.
        if fs::metadata(&target).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            return Ok(target);
        }
        target = target.parent().map_or(next.clone(), |folder| folder.join(&next));
    }
    Err(io::Error::new(ErrorKind::InvalidInput, "its symbolic links lead in a circle"))
}

fn replace(target: &Path, old: Option<&Metadata>, bytes: &[u8]) -> io::Result<()> {
    let folder = target.parent().ok_or(ErrorKind::IsADirectory)?;
    if old.is_some() {
        // A rename asks only the folder; a file that its owner protects is not to be replaced either.
        File::options().write(true).open(target)?;
    }
    clear(folder);
    let mut file = unfinished(folder)?;
    if let Some(old) = old {
        keep_owner(file.as_file(), old);
        file.as_file().set_permissions(old.permissions())?;
    }
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(target).map_err(|error| error.error)?;
    // So that the rename itself outlives a loss of power. Not all systems and file systems can do that.
    #[cfg(unix)]
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

/// A new file in a folder, locked by this program.
fn unfinished(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // A new file gets what the user's umask leaves, as with any other program.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    loop {
        let file = builder.tempfile_in(folder)?;
        match file.as_file().try_lock() {
            // Whoever clears the folder may have come between making and locking.
            Ok(()) if !file.path().exists() => {}
            Err(TryLockError::WouldBlock) => {}
            // Some file systems know no locks; what is left behind then stays, see `clear`.
            Ok(()) | Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
}

/// Removes what programs that ended while they wrote left in a folder. What cannot be removed harms nobody.
fn clear(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(PREFIX)
            && name.ends_with(SUFFIX)
            && entry.file_type().is_ok_and(|found| found.is_file())
            && let Ok(file) = File::options().write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Only the superuser can give a file away; anybody else stays its new owner.
#[cfg(unix)]
fn keep_owner(file: &File, old: &Metadata) {
    use std::os::unix::fs::MetadataExt;
    let _ = std::os::unix::fs::fchown(file, Some(old.uid()), Some(old.gid()));
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) {}
