//! What every header comes down to: where the voxels are and how they are stored.

use std::path::{Path, PathBuf};

use glam::{DAffine3, DMat3, DVec3};

use super::error::{Blame, ReadError};
use crate::{ElementType, Volume};

/// The order of the bytes of one element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

impl Endian {
    pub const NATIVE: Self = if cfg!(target_endian = "big") { Self::Big } else { Self::Little };
}

/// How the bytes of the voxels are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Raw,
    Gzip,
    Zlib,
    /// Decimal numbers with white space between them.
    Ascii,
}

/// Where the packed voxels start in their file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// After this many bytes.
    At(u64),
    /// After this many lines.
    AfterLines(u64),
    /// So that they end with the file; only for raw encoding.
    EndOfFile,
}

/// Where the voxels of a volume are and how they are stored.
#[derive(Clone, Debug)]
pub(super) struct RawLayout {
    pub name: String,
    pub dims: [u32; 3],
    pub channels: u32,
    /// Whether all of one channel comes before all of the next, instead of channel by channel within a voxel.
    pub planar: bool,
    pub element: ElementType,
    pub endian: Endian,
    pub data_file: PathBuf,
    pub start: Start,
    /// Bytes to skip after unpacking.
    pub skip_unpacked: u64,
    pub encoding: Encoding,
    pub slope: f64,
    pub intercept: f64,
    pub index_to_world: DAffine3,
}

impl RawLayout {
    /// A layout of raw little-endian single-channel voxels at the start of `data_file`; readers change what differs.
    pub fn raw(header: &Path, data_file: PathBuf, dims: [u32; 3], element: ElementType) -> Self {
        Self {
            name: short_name(header),
            dims,
            channels: 1,
            planar: false,
            element,
            endian: Endian::Little,
            data_file,
            start: Start::At(0),
            skip_unpacked: 0,
            encoding: Encoding::Raw,
            slope: 1.0,
            intercept: 0.0,
            index_to_world: DAffine3::IDENTITY,
        }
    }

    /// How many bytes the unpacked voxels have; checked against overflow, not yet against any file.
    pub fn byte_count(&self, blame: Blame<'_>) -> Result<u64, ReadError> {
        let count = crate::volume::element_count(self.dims, self.channels).map_err(blame.volume())?;
        let bytes =
            (count as u64).checked_mul(self.element.size() as u64).filter(|&bytes| isize::try_from(bytes).is_ok());
        bytes.ok_or_else(|| blame.volume()(crate::VolumeError::TooLarge { dims: self.dims, channels: self.channels }))
    }

    /// Checks, before any voxel is read, that the numbers of the header make a volume.
    pub fn check(&self, blame: Blame<'_>) -> Result<(), ReadError> {
        let one = Volume::new("", [1; 3], 1, crate::Voxels::U8(vec![0]), self.index_to_world);
        one.and_then(|one| one.with_rescale(self.slope, self.intercept)).map(drop).map_err(blame.volume())
    }
}

/// The name of a volume: that of its file without folders and extensions.
fn short_name(header: &Path) -> String {
    let name = header.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let known = super::FORMATS.iter().flat_map(|format| format.extensions);
    let lower = name.to_lowercase();
    let longest = known.filter(|extension| lower.ends_with(&format!(".{extension}"))).map(|e| e.len() + 1).max();
    match longest {
        Some(length) if length < name.len() => name[..name.len() - length].to_owned(),
        _ => name,
    }
}

/// The file beside `header` that `named` means: relative to the header's folder unless absolute.
pub(super) fn beside(header: &Path, named: &str) -> PathBuf {
    // Headers written on another system may separate folders with backslashes.
    let named =
        if cfg!(windows) || Path::new(named).is_absolute() { named.to_owned() } else { named.replace('\\', "/") };
    header.parent().unwrap_or(Path::new("")).join(named)
}

/// Checks one dimension of a header.
pub(super) fn dimension(blame: Blame<'_>, field: &str, found: i128) -> Result<u32, ReadError> {
    u32::try_from(found)
        .ok()
        .filter(|&n| n > 0)
        .ok_or_else(|| blame.header(field, found, "a number of voxels from 1 to 4294967295"))
}

/// The transformation whose axes are the columns and whose first voxel's centre lies at `origin`.
pub(super) fn affine(axes: [DVec3; 3], origin: DVec3) -> DAffine3 {
    DAffine3::from_mat3_translation(DMat3::from_cols(axes[0], axes[1], axes[2]), origin)
}

/// The same transformation seen from world axes that point left and backwards instead of right and forwards (or the other
/// way round): DICOM and ITK speak of left-posterior-superior, this program of right-anterior-superior.
pub(super) fn flip_left_posterior(transform: DAffine3) -> DAffine3 {
    DAffine3::from_scale(DVec3::new(-1.0, -1.0, 1.0)) * transform
}

/// Axis-aligned voxels of this size around the world's origin, for formats that do not say where the volume lies.
pub(super) fn centred(dims: [u32; 3], spacing: DVec3) -> DAffine3 {
    let half = DVec3::from_array(dims.map(|n| (f64::from(n) - 1.0) / 2.0));
    DAffine3::from_translation(-half * spacing) * DAffine3::from_scale(spacing)
}
