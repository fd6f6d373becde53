//! Why a command failed.

use std::error::Error;
use std::path::Path;

/// The one message that a failed command prints: what is wrong, where, and what to do. Any error becomes one by `?`;
/// like every such catch-all it is no `Error` itself.
#[derive(Debug)]
pub struct Failure(pub String);

impl Failure {
    /// A failure with this message.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

impl<E: Error> From<E> for Failure {
    fn from(error: E) -> Self {
        let mut message = error.to_string();
        let mut source = error.source();
        while let Some(cause) = source {
            let text = cause.to_string();
            // Most errors quote their source already.
            if !message.contains(&text) {
                message = format!("{message}: {text}");
            }
            source = cause.source();
        }
        Self(message)
    }
}

/// Looks before anything is computed whether a file will have a folder to be written to.
///
/// # Errors
/// There is no such folder.
pub fn check_folder(file: &Path) -> Result<(), Failure> {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            let (file, folder) = (file.display(), folder.display());
            Err(Failure::new(format!("{file} cannot be written: there is no folder {folder}; make it first")))
        }
        _ => Ok(()),
    }
}
