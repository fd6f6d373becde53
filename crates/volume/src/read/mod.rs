//! Readers. Every format turns its header into one layout of the voxels; one loader reads them.
//!
//! Nothing a file says is believed: sizes are checked against the length of the file before memory is taken, compressed data
//! is unpacked piece by piece, and every error names the file, the field, what was found and what was expected.

mod ascii;
mod dat;
mod described;
mod error;
mod layout;
mod loader;
mod metaimage;
mod nifti;
mod nrrd;
mod text;

use std::path::Path;

pub use error::ReadError;

use crate::Volume;
use error::Blame;
use layout::RawLayout;

/// How far reading has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Bytes of voxels read so far, after unpacking.
    pub done: u64,
    /// Bytes of voxels that the header promises.
    pub total: u64,
}

/// A file format that can be read.
#[derive(Debug)]
pub struct Format {
    /// A short stable name.
    pub id: &'static str,
    /// What people call the format.
    pub label: &'static str,
    /// Extensions in lower case, without the dot; some have two parts.
    pub extensions: &'static [&'static str],
    /// One sentence about what is read and what is not.
    pub help: &'static str,
    read_header: fn(&Path) -> Result<RawLayout, ReadError>,
}

static FORMATS: [Format; 5] = [
    Format {
        id: "nifti",
        label: "NIfTI",
        extensions: &["nii", "nii.gz", "hdr", "img", "hdr.gz", "img.gz"],
        help: "NIfTI-1, NIfTI-2 and Analyze volumes, compressed or not, of scalars, vectors and RGB(A); the sform is preferred to the qform.",
        read_header: nifti::read_header,
    },
    Format {
        id: "nrrd",
        label: "NRRD",
        extensions: &["nrrd", "nhdr"],
        help: "NRRD with attached or detached data, raw, gzip or ascii, all scalar types; a first axis of 1 to 4 components becomes channels.",
        read_header: nrrd::read_header,
    },
    Format {
        id: "metaimage",
        label: "MetaImage",
        extensions: &["mhd", "mha"],
        help: "MetaImage with local or separate data, raw, zlib-compressed or ascii, with 1 to 4 channels.",
        read_header: metaimage::read_header,
    },
    Format {
        id: "dat",
        label: "Voreen and Inviwo dat",
        extensions: &["dat"],
        help: "A text header beside a raw file, as Voreen and Inviwo write it; the volume is centred unless the header says where it lies.",
        read_header: dat::read_header,
    },
    Format {
        id: "described",
        label: "Described raw data",
        extensions: &["volume.json"],
        help: "A JSON description of any raw file: {\"raw\": \"head.raw\", \"dims\": [256, 256, 128], \"type\": \"u8\"}, optionally with endian, \
               offset, channels, encoding, spacing, origin, directions, slope, intercept and name.",
        read_header: described::read_header,
    },
];

/// The formats that can be read.
pub fn formats() -> &'static [Format] {
    &FORMATS
}

/// The format that the name of a file stands for, whatever its case.
pub fn format_of(path: &Path) -> Option<&'static Format> {
    let name = path.file_name()?.to_string_lossy().to_lowercase();
    let has = |extension: &&str| name.strip_suffix(extension).is_some_and(|stem| stem.ends_with('.'));
    FORMATS.iter().find(|format| format.extensions.iter().any(has))
}

/// Reads the volume in a file; `progress` is called a few times a second of work, with the whole at the end.
///
/// # Errors
/// When the file is in no known format, cannot be read, is truncated, or its header makes no sense or asks for something that
/// is not supported. Every message names the file.
pub fn read(path: &Path, progress: &mut dyn FnMut(Progress)) -> Result<Volume, ReadError> {
    let blame = Blame { file: path };
    let Some(format) = format_of(path) else {
        let known: Vec<_> = FORMATS.iter().flat_map(|format| format.extensions).map(|e| format!(".{e}")).collect();
        let advice = format!(
            "the known ones are {}; raw voxels of any layout are read through a description beside them, such as \
             {{\"raw\": \"head.raw\", \"dims\": [256, 256, 128], \"type\": \"u8\", \"offset\": 0}} in head.volume.json",
            known.join(", ")
        );
        return Err(blame.unsupported("its extension stands for no known volume format", advice));
    };
    let layout = (format.read_header)(path)?;
    loader::load(layout, blame, progress)
}
