//! NRRD, nearly raw raster data (<https://teem.sourceforge.net/nrrd/format.html>).

use std::path::Path;

use glam::{DAffine3, DVec3};

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start, affine, beside, flip_left_posterior};
use super::text::{self, Fields};
use crate::ElementType;

/// Reads the header of a `.nrrd` or `.nhdr`.
pub(super) fn read_header(path: &Path) -> Result<RawLayout, ReadError> {
    let blame = Blame { file: path };
    let (fields, data_at) = read_fields(blame)?;
    let element = element(blame, &fields)?;
    let axes = Axes::read(blame, &fields)?;
    let mut layout = RawLayout::raw(path, path.to_owned(), axes.dims, element);
    layout.channels = axes.channels;
    layout.index_to_world = axes.transform(blame, &fields)?;
    layout.encoding = encoding(blame, &fields)?;
    layout.endian = endian(blame, &fields, &layout)?;

    let detached = fields.find(&["data file", "datafile"]);
    if let Some((key, name)) = detached {
        if name.starts_with("LIST") || name.contains('%') || name.is_empty() {
            return Err(blame.unsupported(
                format!("its `{key}` is {name}, a list of files"),
                "join the slices into one file first",
            ));
        }
        layout.data_file = beside(path, name);
    } else if data_at.is_none() {
        return Err(blame.header(
            "the end of the header",
            "",
            "an empty line and then the voxels, or a `data file` field",
        ));
    }
    let attached_at = if detached.is_some() { 0 } else { data_at.unwrap_or(0) };
    place(blame, &fields, &mut layout, attached_at)?;
    Ok(layout)
}

/// The fields, and where the data starts when an empty line ends the header.
fn read_fields(blame: Blame<'_>) -> Result<(Fields, Option<u64>), ReadError> {
    let bytes = text::head(blame)?;
    let (magic, mut at) = text::line(&bytes, 0).unwrap_or(("", 0));
    if !magic.starts_with("NRRD000") {
        let shown: String = magic.chars().take(16).collect();
        return Err(blame.header("the first line", shown.escape_debug(), "NRRD0001 to NRRD0005"));
    }
    let mut fields = Fields::default();
    while let Some((line, next)) = text::line(&bytes, at) {
        at = next;
        if line.is_empty() {
            return Ok((fields, Some(at as u64)));
        }
        if line.starts_with('#') || line.contains(":=") {
            continue;
        }
        let Some((key, value)) = line.split_once(": ").or_else(|| line.split_once(':')) else {
            return Err(blame.header("a line of the header", line.escape_debug(), "`field: value`"));
        };
        fields.push(key, value);
    }
    Ok((fields, None))
}

fn element(blame: Blame<'_>, fields: &Fields) -> Result<ElementType, ReadError> {
    let expected = "one of signed char, uchar, short, ushort, int, uint, longlong, ulonglong, float, double";
    let found = fields.require(blame, "type", expected)?;
    Ok(match found {
        "signed char" | "int8" | "int8_t" => ElementType::I8,
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => ElementType::U8,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => ElementType::I16,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => ElementType::U16,
        "int" | "signed int" | "int32" | "int32_t" => ElementType::I32,
        "uint" | "unsigned int" | "uint32" | "uint32_t" => ElementType::U32,
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => ElementType::I64,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => ElementType::U64,
        "float" => ElementType::F32,
        "double" => ElementType::F64,
        _ => return Err(blame.header("`type`", found, expected)),
    })
}

fn encoding(blame: Blame<'_>, fields: &Fields) -> Result<Encoding, ReadError> {
    let expected = "raw, gzip or ascii";
    match fields.require(blame, "encoding", expected)?.to_lowercase().as_str() {
        "raw" => Ok(Encoding::Raw),
        "gzip" | "gz" => Ok(Encoding::Gzip),
        "ascii" | "text" | "txt" => Ok(Encoding::Ascii),
        found @ ("bzip2" | "bz2" | "hex") => {
            Err(blame.unsupported(format!("its encoding is {found}"), "save it with raw or gzip encoding"))
        }
        found => Err(blame.header("`encoding`", found, expected)),
    }
}

fn endian(blame: Blame<'_>, fields: &Fields, layout: &RawLayout) -> Result<Endian, ReadError> {
    match fields.get("endian").map(str::to_lowercase).as_deref() {
        Some("little") => Ok(Endian::Little),
        Some("big") => Ok(Endian::Big),
        None if layout.element.size() == 1 || layout.encoding == Encoding::Ascii => Ok(Endian::NATIVE),
        found => Err(blame.header("`endian`", found.unwrap_or(""), "little or big")),
    }
}

/// Applies `line skip` and `byte skip`.
fn place(blame: Blame<'_>, fields: &Fields, layout: &mut RawLayout, attached_at: u64) -> Result<(), ReadError> {
    let skip = |keys: &[&'static str]| -> Result<i64, ReadError> {
        fields.find(keys).map_or(Ok(0), |(key, value)| text::integer(blame, key, value))
    };
    let (lines, bytes) = (skip(&["line skip", "lineskip"])?, skip(&["byte skip", "byteskip"])?);
    if lines < 0 || bytes < -1 {
        return Err(blame.header("`line skip` or `byte skip`", lines.min(bytes), "0 or more (a byte skip may be -1)"));
    }
    layout.start = match (bytes, lines, layout.encoding) {
        (-1, _, Encoding::Raw) => Start::EndOfFile,
        (-1, ..) => {
            return Err(blame.header("`byte skip`", -1, "0 or more, because the data is not raw"));
        }
        (_, 0, _) => Start::At(attached_at),
        _ if attached_at == 0 => Start::AfterLines(lines as u64),
        _ => {
            return Err(
                blame.unsupported("it skips lines behind its own header", "put the voxels into a file of their own")
            );
        }
    };
    layout.skip_unpacked = u64::try_from(bytes).unwrap_or(0);
    Ok(())
}

/// The axes of the array, sorted into channels and space.
struct Axes {
    dims: [u32; 3],
    channels: u32,
    /// The numbers of the axes of the file that run through space.
    spatial: Vec<usize>,
    rank: usize,
}

impl Axes {
    fn read(blame: Blame<'_>, fields: &Fields) -> Result<Self, ReadError> {
        let sizes =
            text::dimensions(blame, "sizes", fields.require(blame, "sizes", "a number of samples for every axis")?)?;
        let rank: usize = text::integer(blame, "dimension", fields.require(blame, "dimension", "1 to 4")?)?;
        if sizes.len() != rank {
            return Err(blame.header(
                "`sizes`",
                format!("{} numbers", sizes.len()),
                format!("{rank}, one for every dimension"),
            ));
        }
        let kinds: Vec<&str> = fields.get("kinds").map(|kinds| kinds.split_whitespace().collect()).unwrap_or_default();
        let directions = match fields.get("space directions") {
            Some(text) => vectors(text).into_iter().map(|v| v != "none").collect(),
            None => Vec::new(),
        };
        let is_spatial = |axis: usize| {
            let by_kind = kinds
                .get(axis)
                .is_none_or(|kind| matches!(kind.to_lowercase().as_str(), "domain" | "space" | "???" | "none"));
            by_kind && directions.get(axis).copied().unwrap_or(true)
        };
        let mut spatial: Vec<usize> = (0..rank).filter(|&axis| is_spatial(axis)).collect();
        // Without a word about the axes, a short first one in front of three others is taken for components.
        if spatial.len() == 4 && kinds.is_empty() && sizes[0] <= 4 {
            spatial.remove(0);
        }
        let others: Vec<usize> =
            (0..rank).filter(|axis| !spatial.contains(axis) && (*axis == 0 || sizes[*axis] > 1)).collect();
        let channels = match others.as_slice() {
            [] => 1,
            [0] if sizes[0] <= 4 => sizes[0],
            [axis, ..] => {
                let found = format!("its axis {axis} has {} samples that do not run through space", sizes[*axis]);
                return Err(blame
                    .unsupported(found, "only a first axis of 1 to 4 components is read; permute or split the axes"));
            }
        };
        if spatial.is_empty() || spatial.len() > 3 {
            return Err(blame.unsupported(
                format!("it has {} axes through space", spatial.len()),
                "a volume has one to three; extract one volume",
            ));
        }
        let mut dims = [1; 3];
        spatial.iter().enumerate().for_each(|(to, &from)| dims[to] = sizes[from]);
        Ok(Self { dims, channels, spatial, rank })
    }

    fn transform(&self, blame: Blame<'_>, fields: &Fields) -> Result<DAffine3, ReadError> {
        let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut origin = DVec3::ZERO;
        if let Some(found) = fields.get("space directions") {
            let all = self.one_each(blame, "space directions", vectors(found))?;
            for (axis, direction) in axes.iter_mut().zip(&all) {
                *axis = parse_vector(blame, "space directions", direction)?;
            }
            complete(&mut axes, all.len());
        } else if let Some(found) = fields.get("spacings") {
            let all = self.one_each(blame, "spacings", found.split_whitespace().collect())?;
            for (axis, spacing) in axes.iter_mut().zip(all) {
                *axis *= text::number(blame, "spacings", spacing)?;
            }
            if let Some(mins) = fields.get("axis mins") {
                let all = self.one_each(blame, "axis mins", mins.split_whitespace().collect())?;
                for (at, min) in all.into_iter().enumerate() {
                    // Samples that stand for cells lie half a spacing inside of the cell's border.
                    let inside = if is_cell(fields, self.spatial[at]) { 0.5 * axes[at][at] } else { 0.0 };
                    origin[at] = text::number(blame, "axis mins", min)? + inside;
                }
            }
        }
        if let Some(found) = fields.get("space origin") {
            origin = parse_vector(blame, "space origin", found)?;
        }
        let transform = affine(axes, origin);
        match fields.get("space").unwrap_or("").to_lowercase().as_str() {
            "left-posterior-superior" | "lps" => Ok(flip_left_posterior(transform)),
            "left-anterior-superior" | "las" => Ok(DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * transform),
            "" | "right-anterior-superior" | "ras" | "scanner-xyz" | "3d-right-handed" | "3d-left-handed" => {
                Ok(transform)
            }
            found => Err(blame.header(
                "`space`",
                found,
                "right-anterior-superior, left-posterior-superior, left-anterior-superior or scanner-xyz",
            )),
        }
    }

    /// The entries of the axes through space; the field must have one for every axis.
    fn one_each<'a>(&self, blame: Blame<'_>, key: &str, all: Vec<&'a str>) -> Result<Vec<&'a str>, ReadError> {
        if all.len() != self.rank {
            return Err(blame.header(
                format!("`{key}`"),
                format!("{} entries", all.len()),
                format!("{}, one for every dimension", self.rank),
            ));
        }
        Ok(self.spatial.iter().map(|&axis| all[axis]).collect())
    }
}

fn is_cell(fields: &Fields, axis: usize) -> bool {
    let centers = fields.find(&["centers", "centerings"]).map_or("", |(_, value)| value);
    centers.split_whitespace().nth(axis) == Some("cell")
}

/// Flat images get a third axis that stands upright on the others.
fn complete(axes: &mut [DVec3; 3], known: usize) {
    if known == 2 {
        axes[2] = axes[0].cross(axes[1]).normalize_or(DVec3::Z);
    } else if known == 1 {
        axes[1] = axes[0].any_orthonormal_vector();
        axes[2] = axes[0].cross(axes[1]).normalize_or(DVec3::Z);
    }
}

/// The vectors `(x,y,z)` and words of a field; vectors may contain white space.
fn vectors(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let end = match rest.starts_with('(') {
            true => rest.find(')').map_or(rest.len(), |at| at + 1),
            false => rest.find(|c: char| c.is_whitespace() || c == '(').unwrap_or(rest.len()),
        };
        found.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    found
}

fn parse_vector(blame: Blame<'_>, key: &str, found: &str) -> Result<DVec3, ReadError> {
    let expected = || blame.header(format!("`{key}`"), found, "vectors such as (0.5,0,0)");
    let inner = found.trim().strip_prefix('(').and_then(|rest| rest.strip_suffix(')')).ok_or_else(expected)?;
    let numbers: Vec<f64> = inner.split(',').map(|word| text::number(blame, key, word)).collect::<Result<_, _>>()?;
    match *numbers.as_slice() {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        [x, y] => Ok(DVec3::new(x, y, 0.0)),
        _ => Err(expected()),
    }
}
