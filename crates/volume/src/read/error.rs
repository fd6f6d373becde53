//! What can go wrong while reading, said so that the reader of the message can act.

use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::VolumeError;

/// Why a file could not be read as a volume. Every message names the file.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The operating system refused.
    #[error("{}: cannot {action}: {source}", file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// What was tried.
        action: &'static str,
        /// What the system said.
        source: std::io::Error,
    },
    /// A header says something impossible.
    #[error("{}: {field} is {found}, but {expected} was expected", file.display())]
    Header {
        /// The file with the header.
        file: PathBuf,
        /// The part of the header.
        field: String,
        /// What it says.
        found: String,
        /// What it should say.
        expected: String,
    },
    /// There are fewer voxels in the data than the header promises.
    #[error("{}: the header {} promises {expected} bytes of voxels, but only {found} are there; the file is truncated or its header is wrong", file.display(), header.display())]
    TooShort {
        /// The file with the voxels.
        file: PathBuf,
        /// The file with the header.
        header: PathBuf,
        /// Bytes that the header promises.
        expected: u64,
        /// Bytes that are there; for compressed data the most that they can hold.
        found: u64,
    },
    /// The file is fine but holds something that a volume is not.
    #[error("{}: {what}; {advice}", file.display())]
    Unsupported {
        /// The file.
        file: PathBuf,
        /// What is not supported.
        what: String,
        /// What to do instead.
        advice: String,
    },
    /// The voxels do not fit into memory.
    #[error("{}: its {bytes} bytes of voxels do not fit into memory; crop or resample the volume before reading it", file.display())]
    Memory {
        /// The file.
        file: PathBuf,
        /// Bytes needed.
        bytes: u64,
    },
    /// The header describes a volume that cannot be.
    #[error("{}: {source}", file.display())]
    Volume {
        /// The file with the header.
        file: PathBuf,
        /// What is wrong with the volume.
        source: Box<VolumeError>,
    },
}

/// Makes errors about one header.
#[derive(Clone, Copy)]
pub(super) struct Blame<'a> {
    pub file: &'a Path,
}

impl Blame<'_> {
    pub fn io(self, action: &'static str) -> impl Fn(std::io::Error) -> ReadError {
        let file = self.file.to_owned();
        move |source| ReadError::Io { file: file.clone(), action, source }
    }

    pub fn header(self, field: impl Into<String>, found: impl ToString, expected: impl Into<String>) -> ReadError {
        let found = match found.to_string() {
            text if text.is_empty() => "missing".to_owned(),
            text if text.chars().count() > 80 => text.chars().take(80).chain("...".chars()).collect(),
            text => text,
        };
        ReadError::Header { file: self.file.to_owned(), field: field.into(), found, expected: expected.into() }
    }

    pub fn unsupported(self, what: impl Into<String>, advice: impl Into<String>) -> ReadError {
        ReadError::Unsupported { file: self.file.to_owned(), what: what.into(), advice: advice.into() }
    }

    pub fn volume(self) -> impl Fn(VolumeError) -> ReadError {
        let file = self.file.to_owned();
        move |source| ReadError::Volume { file: file.clone(), source: Box::new(source) }
    }
}
