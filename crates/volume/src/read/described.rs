//! Raw voxels of any program, described by a small JSON file beside them.

use std::path::Path;

use glam::{DAffine3, DVec3};
use serde::Deserialize;

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start, affine, beside, dimension};
use super::text;
use crate::ElementType;

/// The description. Only the first three fields are required.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    /// The file with the voxels, relative to the description.
    raw: String,
    /// Voxels along x, y, z.
    dims: [i64; 3],
    /// `u8`, `i8`, `u16`, ... `f64`.
    r#type: String,
    /// `little` (the default) or `big`.
    endian: Option<String>,
    /// Bytes before the first voxel; after unpacking where the encoding is gzip.
    offset: Option<u64>,
    /// 1 to 4, interleaved.
    channels: Option<u32>,
    /// `raw` (the default), `gzip`, `zlib` or `ascii`.
    encoding: Option<String>,
    /// World units between voxels along each axis; negative mirrors.
    spacing: Option<[f64; 3]>,
    /// World position of the centre of the first voxel.
    origin: Option<[f64; 3]>,
    /// World directions of the three index axes, multiplied with the spacing.
    directions: Option<[[f64; 3]; 3]>,
    /// Value = stored * slope + intercept.
    slope: Option<f64>,
    /// Value = stored * slope + intercept.
    intercept: Option<f64>,
    /// What to call the volume.
    name: Option<String>,
}

/// Reads a `.volume.json`.
pub(super) fn read_header(path: &Path) -> Result<RawLayout, ReadError> {
    let blame = Blame { file: path };
    let bytes = text::head(blame)?;
    let description: Description = serde_json::from_slice(&bytes)
        .map_err(|error| blame.header("the description", error, "an object with raw, dims, type and so on"))?;
    let mut dims = [0; 3];
    for (axis, dim) in dims.iter_mut().enumerate() {
        *dim = dimension(blame, &format!("`dims[{axis}]`"), description.dims[axis].into())?;
    }
    let found = &description.r#type;
    let element = ElementType::from_id(found)
        .ok_or_else(|| blame.header("`type`", found, "one of u8, i8, u16, i16, u32, i32, u64, i64, f32, f64"))?;

    let mut layout = RawLayout::raw(path, beside(path, &description.raw), dims, element);
    layout.channels = description.channels.unwrap_or(1);
    layout.endian = endian(blame, description.endian.as_deref())?;
    layout.encoding = encoding(blame, description.encoding.as_deref())?;
    match layout.encoding {
        Encoding::Raw | Encoding::Ascii => layout.start = Start::At(description.offset.unwrap_or(0)),
        Encoding::Gzip | Encoding::Zlib => layout.skip_unpacked = description.offset.unwrap_or(0),
    }
    layout.slope = description.slope.unwrap_or(1.0);
    layout.intercept = description.intercept.unwrap_or(0.0);
    layout.index_to_world = transform(&description);
    if let Some(name) = description.name {
        layout.name = name;
    }
    Ok(layout)
}

fn endian(blame: Blame<'_>, found: Option<&str>) -> Result<Endian, ReadError> {
    match found {
        None | Some("little") => Ok(Endian::Little),
        Some("big") => Ok(Endian::Big),
        Some(found) => Err(blame.header("`endian`", found, "little or big")),
    }
}

fn encoding(blame: Blame<'_>, found: Option<&str>) -> Result<Encoding, ReadError> {
    match found {
        None | Some("raw") => Ok(Encoding::Raw),
        Some("gzip") => Ok(Encoding::Gzip),
        Some("zlib") => Ok(Encoding::Zlib),
        Some("ascii") => Ok(Encoding::Ascii),
        Some(found) => Err(blame.header("`encoding`", found, "raw, gzip, zlib or ascii")),
    }
}

fn transform(description: &Description) -> DAffine3 {
    let mut axes = description.directions.map_or([DVec3::X, DVec3::Y, DVec3::Z], |rows| rows.map(DVec3::from_array));
    let spacing = description.spacing.unwrap_or([1.0; 3]);
    axes.iter_mut().zip(spacing).for_each(|(axis, size)| *axis *= size);
    affine(axes, DVec3::from_array(description.origin.unwrap_or_default()))
}
