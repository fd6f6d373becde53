//! MetaImage (<https://itk.org/Wiki/ITK/MetaIO/Documentation>). World coordinates in the file are left-posterior-superior.

use std::path::Path;

use glam::{DAffine3, DVec3};

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start, affine, beside, flip_left_posterior};
use super::text::{self, Fields};
use crate::ElementType;

/// Reads the header of a `.mhd` or `.mha`.
pub(super) fn read_header(path: &Path) -> Result<RawLayout, ReadError> {
    let blame = Blame { file: path };
    let (fields, data_at) = read_fields(blame)?;
    let element = element(blame, &fields)?;
    let dims = dims(blame, &fields)?;
    let data = fields.require(blame, "elementdatafile", "LOCAL or the name of a file")?;
    let local = matches!(data, "LOCAL" | "Local" | "local");
    if data.starts_with("LIST") || data.contains('%') || data.is_empty() {
        return Err(blame.unsupported(
            format!("its `ElementDataFile` is {data}, a list of files"),
            "join the slices into one file first",
        ));
    }
    let data_file = if local { path.to_owned() } else { beside(path, data) };
    let mut layout = RawLayout::raw(path, data_file, dims, element);
    layout.channels =
        fields.get("elementnumberofchannels").map_or(Ok(1), |n| text::integer(blame, "ElementNumberOfChannels", n))?;
    layout.encoding = encoding(blame, &fields)?;
    if let Some((key, big)) = fields.find(&["binarydatabyteordermsb", "elementbyteordermsb"]) {
        layout.endian = if text::truth(blame, key, big)? { Endian::Big } else { Endian::Little };
    }
    layout.start = start(blame, &fields, if local { data_at } else { 0 }, layout.encoding)?;
    if let Some(slope) = fields.get("elementtointensityfunctionslope") {
        layout.slope = text::number(blame, "ElementToIntensityFunctionSlope", slope)?;
    }
    if let Some(offset) = fields.get("elementtointensityfunctionoffset") {
        layout.intercept = text::number(blame, "ElementToIntensityFunctionOffset", offset)?;
    }
    layout.index_to_world = transform(blame, &fields)?;
    Ok(layout)
}

/// The fields up to `ElementDataFile`, which ends the header, and where it ends.
fn read_fields(blame: Blame<'_>) -> Result<(Fields, u64), ReadError> {
    let bytes = text::head(blame)?;
    let (mut fields, mut at) = (Fields::default(), 0);
    while let Some((line, next)) = text::line(&bytes, at) {
        at = next;
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let Some((key, value)) = line.split_once('=') else {
            let shown: String = line.chars().take(40).collect();
            return Err(blame.header("a line of the header", shown.escape_debug(), "`Field = value`"));
        };
        fields.push(key, value);
        if key.trim().eq_ignore_ascii_case("ElementDataFile") {
            break;
        }
    }
    Ok((fields, at as u64))
}

fn element(blame: Blame<'_>, fields: &Fields) -> Result<ElementType, ReadError> {
    let expected = "one of MET_CHAR, MET_UCHAR, MET_SHORT, MET_USHORT, MET_INT, MET_UINT, MET_LONG_LONG, MET_ULONG_LONG, MET_FLOAT, MET_DOUBLE";
    let found = fields.require(blame, "elementtype", expected)?;
    Ok(match found.trim_end_matches("_ARRAY") {
        "MET_CHAR" | "MET_ASCII_CHAR" => ElementType::I8,
        "MET_UCHAR" => ElementType::U8,
        "MET_SHORT" => ElementType::I16,
        "MET_USHORT" => ElementType::U16,
        // ITK fixes `long` in files at 32 bits.
        "MET_INT" | "MET_LONG" => ElementType::I32,
        "MET_UINT" | "MET_ULONG" => ElementType::U32,
        "MET_LONG_LONG" => ElementType::I64,
        "MET_ULONG_LONG" => ElementType::U64,
        "MET_FLOAT" => ElementType::F32,
        "MET_DOUBLE" => ElementType::F64,
        _ => return Err(blame.header("`ElementType`", found, expected)),
    })
}

fn rank(blame: Blame<'_>, fields: &Fields) -> Result<usize, ReadError> {
    let found = fields.require(blame, "ndims", "2 or 3")?;
    match text::integer::<usize>(blame, "NDims", found)? {
        rank @ (2 | 3) => Ok(rank),
        _ => Err(blame.header("`NDims`", found, "2 or 3; extract one volume of a series")),
    }
}

fn dims(blame: Blame<'_>, fields: &Fields) -> Result<[u32; 3], ReadError> {
    let rank = rank(blame, fields)?;
    let found = text::dimensions(
        blame,
        "DimSize",
        fields.require(blame, "dimsize", "a number of voxels for every dimension")?,
    )?;
    match (rank, found.as_slice()) {
        (3, &[x, y, z]) => Ok([x, y, z]),
        (2, &[x, y]) => Ok([x, y, 1]),
        _ => Err(blame.header(
            "`DimSize`",
            format!("{} numbers", found.len()),
            format!("{rank}, one for every dimension"),
        )),
    }
}

fn encoding(blame: Blame<'_>, fields: &Fields) -> Result<Encoding, ReadError> {
    let flag =
        |key: &str, otherwise: bool| fields.get(key).map_or(Ok(otherwise), |found| text::truth(blame, key, found));
    Ok(match (flag("binarydata", true)?, flag("compresseddata", false)?) {
        (false, _) => Encoding::Ascii,
        (true, true) => Encoding::Zlib,
        (true, false) => Encoding::Raw,
    })
}

fn start(blame: Blame<'_>, fields: &Fields, local_at: u64, encoding: Encoding) -> Result<Start, ReadError> {
    let skip: i64 = fields.get("headersize").map_or(Ok(0), |found| text::integer(blame, "HeaderSize", found))?;
    match (skip, encoding) {
        (-1, Encoding::Raw) => Ok(Start::EndOfFile),
        (0.., _) => Ok(Start::At(local_at.saturating_add(skip.unsigned_abs()))),
        _ => Err(blame.header("`HeaderSize`", skip, "0 or more, or -1 for raw data")),
    }
}

fn transform(blame: Blame<'_>, fields: &Fields) -> Result<DAffine3, ReadError> {
    let rank = rank(blame, fields)?;
    let numbers = |keys: &[&'static str], count: usize| -> Result<Option<Vec<f64>>, ReadError> {
        let Some((key, found)) = fields.find(keys) else {
            return Ok(None);
        };
        let numbers = text::numbers(blame, key, found)?;
        match numbers.len() {
            n if n == count => Ok(Some(numbers)),
            n => {
                Err(blame.header(format!("`{key}`"), format!("{n} numbers"), format!("{count} for {rank} dimensions")))
            }
        }
    };
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    if let Some(matrix) = numbers(&["transformmatrix", "rotation", "orientation"], rank * rank)? {
        // A row of the file is the direction of one index axis.
        for (axis, row) in axes.iter_mut().zip(matrix.chunks(rank)) {
            *axis = vector(row);
        }
    }
    if let Some(spacing) = numbers(&["elementspacing", "elementsize"], rank)? {
        axes.iter_mut().zip(spacing).for_each(|(axis, size)| *axis *= size);
    }
    let origin = numbers(&["offset", "origin", "position"], rank)?.map_or(DVec3::ZERO, |found| vector(&found));
    Ok(flip_left_posterior(affine(axes, origin)))
}

fn vector(numbers: &[f64]) -> DVec3 {
    DVec3::new(numbers[0], numbers[1], numbers.get(2).copied().unwrap_or(0.0))
}
