//! Opening and reading ordinary files, and nothing else.

use std::fmt;
use std::fs::{self, File, FileType, Metadata};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// What a path stands for, links followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An ordinary file.
    File,
    /// A folder.
    Folder,
    /// A FIFO (named pipe).
    Fifo,
    /// A device.
    Device,
    /// A socket.
    Socket,
    /// Something that only this system knows.
    Other,
}

impl Kind {
    /// The kind of what a path stands for, links followed.
    ///
    /// # Errors
    /// There is nothing, or it cannot be looked at.
    pub fn of(path: &Path) -> io::Result<Self> {
        Ok(Self::from(metadata(path)?.file_type()))
    }
}

impl From<FileType> for Kind {
    fn from(found: FileType) -> Self {
        match found {
            found if found.is_file() => Self::File,
            found if found.is_dir() => Self::Folder,
            #[cfg(unix)]
            found => {
                use std::os::unix::fs::FileTypeExt;
                match found {
                    found if found.is_fifo() => Self::Fifo,
                    found if found.is_socket() => Self::Socket,
                    found if found.is_block_device() || found.is_char_device() => Self::Device,
                    _ => Self::Other,
                }
            }
            #[cfg(not(unix))]
            _ => Self::Other,
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::File => "a file",
            Self::Folder => "a folder",
            Self::Fifo => "a FIFO (named pipe)",
            Self::Device => "a device",
            Self::Socket => "a socket",
            Self::Other => "no ordinary file",
        })
    }
}

/// Opens an ordinary file for reading. Never waits: not even for someone to write into a FIFO.
///
/// # Errors
/// The system's, that a link leads nowhere, or that the path is a folder, FIFO, device or socket.
pub fn open(path: &Path) -> io::Result<File> {
    // Looked at before it is opened, because opening alone can make a device act; and again afterwards, because the path may
    // stand for something else by then.
    check(&metadata(path)?)?;
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK);
    let file = options.open(path)?;
    check(&file.metadata()?)?;
    Ok(file)
}

/// The bytes of an ordinary file.
///
/// # Errors
/// As [`open`], and that it is longer than `most` bytes, which is seen before anything is read.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    if length > most {
        return Err(too_long(length, most));
    }
    let mut bytes = Vec::with_capacity(length as usize);
    // It may grow while it is read.
    file.take(most + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 {
        found if found > most => Err(too_long(found, most)),
        _ => Ok(bytes),
    }
}

/// The text of an ordinary file.
///
/// # Errors
/// As [`read`], and that it is not UTF-8.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    String::from_utf8(read(path, most)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        io::Error::new(ErrorKind::InvalidData, format!("it is no UTF-8 text: byte {at} cannot be one of its letters"))
    })
}

fn metadata(path: &Path) -> io::Result<Metadata> {
    fs::metadata(path).map_err(|error| match fs::read_link(path) {
        Ok(target) if error.kind() == ErrorKind::NotFound => {
            io::Error::new(ErrorKind::NotFound, format!("it is a link to {}, which is not there", target.display()))
        }
        _ => error,
    })
}

fn check(metadata: &Metadata) -> io::Result<()> {
    match Kind::from(metadata.file_type()) {
        Kind::File => Ok(()),
        found => {
            let message = format!("it is {found}, and only ordinary files are read");
            Err(io::Error::new(ErrorKind::InvalidInput, message))
        }
    }
}

fn too_long(found: u64, most: u64) -> io::Error {
    let message = format!("it is {} long, and at most {} are read of such a file", Size(found), Size(most));
    io::Error::new(ErrorKind::FileTooLarge, message)
}

/// A number of bytes in the unit that suits it.
struct Size(u64);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            bytes if bytes < 10 << 10 => write!(f, "{bytes} bytes"),
            bytes if bytes < 10 << 20 => write!(f, "{} KiB", bytes >> 10),
            bytes => write!(f, "{} MiB", bytes >> 20),
        }
    }
}
