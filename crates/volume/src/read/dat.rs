//! The text header beside a raw file that Voreen and Inviwo share, in both dialects.

use std::path::Path;

use glam::{DAffine3, DVec3};

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start, affine, beside, centred};
use super::text::{self, Fields};
use crate::ElementType;

/// Reads a `.dat` header.
pub(super) fn read_header(path: &Path) -> Result<RawLayout, ReadError> {
    let blame = Blame { file: path };
    let fields = read_fields(blame)?;
    let raw = fields.find(&["objectfilename", "rawfile"]).map_or("", |(_, name)| name);
    if raw.is_empty() {
        return Err(blame.header("`ObjectFileName`", "", "the name of the file with the voxels"));
    }
    let resolution =
        text::dimensions(blame, "Resolution", fields.require(blame, "resolution", "three numbers of voxels")?)?;
    let dims: [u32; 3] = match resolution.as_slice() {
        &[x, y, z] | &[x, y, z, 1] => [x, y, z],
        _ => {
            return Err(blame.header("`Resolution`", format!("{resolution:?}"), "three numbers of voxels"));
        }
    };
    let (element, format_channels) = element(blame, fields.require(blame, "format", "UCHAR, USHORT, FLOAT, ...")?)?;
    let mut layout = RawLayout::raw(path, beside(path, raw), dims, element);
    layout.channels = channels(blame, &fields, format_channels)?;
    if let Some((key, order)) = fields.find(&["endianness", "endianess", "byteorder"]) {
        layout.endian = match order.to_lowercase().as_str() {
            "little" | "littleendian" => Endian::Little,
            "big" | "bigendian" => Endian::Big,
            _ => return Err(blame.header(format!("`{key}`"), order, "little or big")),
        };
    }
    if let Some((key, offset)) = fields.find(&["byteoffset", "headerskip"]) {
        layout.start = Start::At(text::integer(blame, key, offset)?);
    }
    layout.encoding = match raw.to_lowercase().ends_with(".gz") {
        true => Encoding::Gzip,
        false => Encoding::Raw,
    };
    layout.index_to_world = transform(blame, &fields, dims)?;
    Ok(layout)
}

fn read_fields(blame: Blame<'_>) -> Result<Fields, ReadError> {
    let bytes = text::head(blame)?;
    let (mut fields, mut at) = (Fields::default(), 0);
    while let Some((line, next)) = text::line(&bytes, at) {
        at = next;
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let Some((key, value)) = line.split_once(':') else {
            let shown: String = line.chars().take(40).collect();
            return Err(blame.header("a line of the header", shown.escape_debug(), "`Field: value`"));
        };
        fields.push(key, value);
    }
    Ok(fields)
}

/// The element type and, where the name holds it, the number of channels: `USHORT`, `UINT16`, `Vec4UINT8`.
fn element(blame: Blame<'_>, found: &str) -> Result<(ElementType, u32), ReadError> {
    let upper = found.to_uppercase();
    let (channels, scalar) = match upper.strip_prefix("VEC").and_then(|rest| rest.split_at_checked(1)) {
        Some((digit, scalar)) => (text::integer(blame, "Format", digit)?, scalar),
        None => (1, upper.as_str()),
    };
    let element = match scalar {
        "UCHAR" | "UINT8" => ElementType::U8,
        "CHAR" | "INT8" => ElementType::I8,
        "USHORT" | "USHORT_12" | "UINT12" | "UINT16" => ElementType::U16,
        "SHORT" | "INT16" => ElementType::I16,
        "UINT" | "UINT32" => ElementType::U32,
        "INT" | "INT32" => ElementType::I32,
        "UINT64" => ElementType::U64,
        "INT64" => ElementType::I64,
        "FLOAT" | "FLOAT32" => ElementType::F32,
        "DOUBLE" | "FLOAT64" => ElementType::F64,
        _ => {
            return Err(blame.header(
                "`Format`",
                found,
                "one of UCHAR, CHAR, USHORT, SHORT, UINT, INT, FLOAT, DOUBLE, UINT8 ... FLOAT64",
            ));
        }
    };
    Ok((element, channels))
}

fn channels(blame: Blame<'_>, fields: &Fields, of_format: u32) -> Result<u32, ReadError> {
    match fields.get("objectmodel").map(str::to_uppercase).as_deref() {
        None | Some("I" | "") => Ok(of_format),
        Some("LA") => Ok(2),
        Some("RGB") => Ok(3),
        Some("RGBA") => Ok(4),
        Some(found) => Err(blame.header("`ObjectModel`", found, "I, LA, RGB or RGBA")),
    }
}

fn transform(blame: Blame<'_>, fields: &Fields, dims: [u32; 3]) -> Result<DAffine3, ReadError> {
    let read = |key: &str| fields.get(key).map(|found| text::vector(blame, key, found)).transpose();
    // Inviwo's basis spans the whole box and its offset is the corner of the box.
    if let (Some(x), Some(y), Some(z)) = (read("basisvector1")?, read("basisvector2")?, read("basisvector3")?) {
        let axes = [x / f64::from(dims[0]), y / f64::from(dims[1]), z / f64::from(dims[2])];
        let corner = read("offset")?.unwrap_or(-0.5 * (x + y + z));
        return Ok(affine(axes, corner + 0.5 * (axes[0] + axes[1] + axes[2])));
    }
    let thickness = fields.find(&["slicethickness", "spacing"]);
    let spacing = thickness.map_or(Ok(DVec3::ONE), |(key, found)| text::vector(blame, key, found))?;
    Ok(centred(dims, spacing))
}
