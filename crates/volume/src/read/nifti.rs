//! NIfTI-1 and NIfTI-2 (`nifti1.h`, `nifti2.h` of the Data Format Working Group), and their ancestor Analyze 7.5.

use std::io::Read;
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;
use glam::{DAffine3, DMat3, DVec3};

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start, affine, dimension};
use crate::ElementType;

const SIZE_1: usize = 348;
const SIZE_2: usize = 540;

/// Reads the header of a `.nii`, or of a pair of `.hdr` and `.img`.
pub(super) fn read_header(path: &Path) -> Result<RawLayout, ReadError> {
    let (header_file, image_file) = files(path);
    let blame = Blame { file: &header_file };
    let bytes = header_bytes(blame)?;
    let header = Header::find(&bytes, blame)?;
    let single = header.check_magic(blame)?;

    let (element, colour_channels) = header.element(blame)?;
    let (dims, vector_channels) = header.dims(blame)?;
    if colour_channels > 1 && vector_channels > 1 {
        return Err(blame.unsupported("it holds vectors of colours", "store one volume of colours"));
    }
    let data_file = if single { header_file.clone() } else { image_file };
    let mut layout = RawLayout::raw(path, data_file, dims, element);
    layout.channels = colour_channels.max(vector_channels);
    layout.planar = vector_channels > 1;
    layout.endian = header.endian;
    layout.encoding = if is_gzip(&layout.data_file)? { Encoding::Gzip } else { Encoding::Raw };
    let offset = header.offset(blame, single)?;
    match layout.encoding {
        Encoding::Gzip => layout.skip_unpacked = offset,
        _ => layout.start = Start::At(offset),
    }
    if colour_channels == 1 && header.version > 0 {
        (layout.slope, layout.intercept) = header.rescale();
    }
    layout.index_to_world = header.transform(blame, dims)?;
    Ok(layout)
}

/// The files with header and voxels; the same one twice for a `.nii`.
fn files(path: &Path) -> (PathBuf, PathBuf) {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let lower = name.to_lowercase();
    let (stem, packed) = if lower.ends_with(".gz") { (&name[..name.len() - 3], ".gz") } else { (&name[..], "") };
    if lower.trim_end_matches(".gz").ends_with(".nii") {
        return (path.to_owned(), path.to_owned());
    }
    let stem = &stem[..stem.len().saturating_sub(4)];
    let other = |extension: &str| {
        let candidates = [packed, "", ".gz"].map(|packed| path.with_file_name(format!("{stem}{extension}{packed}")));
        candidates.iter().find(|file| file.exists()).unwrap_or(&candidates[0]).clone()
    };
    match lower.contains(".img") && !lower.trim_end_matches(".gz").ends_with(".hdr") {
        true => (other(".hdr"), path.to_owned()),
        false => (path.to_owned(), other(".img")),
    }
}

fn is_gzip(file: &Path) -> Result<bool, ReadError> {
    let blame = Blame { file };
    let mut magic = Vec::new();
    let opened = rayloom_files::open(file).map_err(blame.io("open it"))?;
    opened.take(2).read_to_end(&mut magic).map_err(blame.io("read it"))?;
    Ok(magic == [0x1f, 0x8b])
}

fn header_bytes(blame: Blame<'_>) -> Result<Vec<u8>, ReadError> {
    let file = rayloom_files::open(blame.file).map_err(blame.io("open it"))?;
    let mut bytes = Vec::new();
    let most = SIZE_2 as u64;
    let result = match is_gzip(blame.file)? {
        true => MultiGzDecoder::new(file).take(most).read_to_end(&mut bytes),
        false => file.take(most).read_to_end(&mut bytes),
    };
    match result {
        // A header that is cut short is reported as such below.
        Err(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => Err(blame.io("read its header")(error)),
        _ => Ok(bytes),
    }
}

/// The bytes of a header and how to read them. Version 0 is Analyze.
struct Header<'a> {
    bytes: &'a [u8],
    endian: Endian,
    version: u8,
}

impl<'a> Header<'a> {
    fn find(bytes: &'a [u8], blame: Blame<'_>) -> Result<Self, ReadError> {
        let expected = "the 348 bytes of NIfTI-1 or the 540 bytes of NIfTI-2";
        let Some(first) = bytes.first_chunk::<4>().filter(|_| bytes.len() >= SIZE_1) else {
            return Err(blame.header("the length of the header", format!("{} bytes", bytes.len()), expected));
        };
        let (little, big) = (i32::from_le_bytes(*first), i32::from_be_bytes(*first));
        let (endian, size) = match [SIZE_1 as i32, SIZE_2 as i32] {
            sizes if sizes.contains(&little) => (Endian::Little, little as usize),
            sizes if sizes.contains(&big) => (Endian::Big, big as usize),
            _ => return Err(blame.header("sizeof_hdr", little, "348 or 540 in either byte order")),
        };
        if bytes.len() < size {
            return Err(blame.header("the length of the header", format!("{} bytes", bytes.len()), expected));
        }
        let version = match size {
            SIZE_2 => 2,
            _ => u8::from(bytes[344..347] == *b"n+1" || bytes[344..347] == *b"ni1"),
        };
        Ok(Self { bytes, endian, version })
    }

    /// Whether header and voxels share one file.
    fn check_magic(&self, blame: Blame<'_>) -> Result<bool, ReadError> {
        let magic = if self.version == 2 { &self.bytes[4..8] } else { &self.bytes[344..348] };
        let pair_by_name = !blame.file.to_string_lossy().to_lowercase().trim_end_matches(".gz").ends_with(".nii");
        match (self.version, magic) {
            (0, _) if pair_by_name => Ok(false),
            (1, b"n+1\0") | (2, b"n+2\0") => Ok(true),
            (1, b"ni1\0") | (2, b"ni2\0") => Ok(false),
            _ => Err(blame.header(
                "magic",
                String::from_utf8_lossy(magic).escape_debug(),
                "n+1, ni1, n+2 or ni2 and a zero byte",
            )),
        }
    }

    fn at<const N: usize>(&self, offset: usize) -> [u8; N] {
        let mut bytes = [0; N];
        bytes.copy_from_slice(&self.bytes[offset..offset + N]);
        if self.endian != Endian::Little {
            bytes.reverse();
        }
        bytes
    }

    fn i16(&self, offset: usize) -> i64 {
        i16::from_le_bytes(self.at(offset)).into()
    }

    fn i32(&self, offset: usize) -> i64 {
        i32::from_le_bytes(self.at(offset)).into()
    }

    /// A field that is `f32` in version 1 and `f64` in version 2, the `index`-th of an array.
    fn real(&self, offset_1: usize, offset_2: usize, index: usize) -> f64 {
        match self.version {
            2 => f64::from_le_bytes(self.at(offset_2 + 8 * index)),
            _ => f32::from_le_bytes(self.at(offset_1 + 4 * index)).into(),
        }
    }

    fn dim(&self, index: usize) -> i64 {
        match self.version {
            2 => i64::from_le_bytes(self.at(16 + 8 * index)),
            _ => self.i16(40 + 2 * index),
        }
    }

    /// Dimensions along x, y, z, and the length of the vectors in the fifth dimension.
    fn dims(&self, blame: Blame<'_>) -> Result<([u32; 3], u32), ReadError> {
        let rank = self.dim(0);
        if !(1..=7).contains(&rank) {
            return Err(blame.header("dim[0], the number of dimensions,", rank, "1 to 7"));
        }
        let mut dims = [1; 7];
        for (index, dim) in dims.iter_mut().enumerate().take(rank as usize) {
            *dim = dimension(blame, &format!("dim[{}]", index + 1), self.dim(index + 1).into())?;
        }
        if dims[3] > 1 {
            return Err(blame.unsupported(
                format!("it is a series of {} volumes", dims[3]),
                "extract one volume of the series into a file of its own",
            ));
        }
        if dims[4] > 4 || dims[5] > 1 || dims[6] > 1 {
            let found = format!("its voxels hold {} x {} x {} components", dims[4], dims[5], dims[6]);
            return Err(blame.unsupported(found, "a voxel has at most four; extract those of interest"));
        }
        Ok(([dims[0], dims[1], dims[2]], dims[4]))
    }

    fn element(&self, blame: Blame<'_>) -> Result<(ElementType, u32), ReadError> {
        let code = self.i16(if self.version == 2 { 12 } else { 70 });
        let element = match code {
            2 | 128 | 2304 => ElementType::U8,
            4 => ElementType::I16,
            8 => ElementType::I32,
            16 => ElementType::F32,
            64 => ElementType::F64,
            256 => ElementType::I8,
            512 => ElementType::U16,
            768 => ElementType::U32,
            1024 => ElementType::I64,
            1280 => ElementType::U64,
            1 | 32 | 1536 | 1792 | 2048 => {
                let what = format!("its datatype is {code} (bits, complex or 128-bit numbers)");
                return Err(blame.unsupported(what, "convert it to integers of up to 64 bits, float or double"));
            }
            _ => {
                return Err(blame.header("datatype", code, "a code of nifti1.h such as 2 (u8), 4 (i16) or 16 (f32)"));
            }
        };
        let channels = match code {
            128 => 3,
            2304 => 4,
            _ => 1,
        };
        Ok((element, channels))
    }

    fn offset(&self, blame: Blame<'_>, single: bool) -> Result<u64, ReadError> {
        let found = match self.version {
            2 => i64::from_le_bytes(self.at(168)) as f64,
            _ => self.real(108, 0, 0),
        };
        let least = match (single, self.version) {
            (false, _) => 0.0,
            (true, 2) => SIZE_2 as f64,
            (true, _) => SIZE_1 as f64,
        };
        // Some writers leave the offset of a single file at zero; the voxels follow the header and its extension flag.
        let offset = if single && found == 0.0 { least + 4.0 } else { found };
        if offset.is_finite() && offset >= least && offset < 1e15 {
            Ok(offset as u64)
        } else {
            Err(blame.header("vox_offset", found, format!("at least {least} bytes")))
        }
    }

    /// Slope and intercept; a slope of zero (or NaN, as nibabel writes it) means none.
    fn rescale(&self) -> (f64, f64) {
        let slope = self.real(112, 176, 0);
        if slope.is_finite() && slope != 0.0 { (slope, self.real(116, 184, 0)) } else { (1.0, 0.0) }
    }

    /// The transformation into RAS+ millimetres: sform, else qform, else voxel sizes alone.
    fn transform(&self, blame: Blame<'_>, dims: [u32; 3]) -> Result<DAffine3, ReadError> {
        let (qform, sform, units) = match self.version {
            0 => (0, 0, 2),
            1 => (self.i16(252), self.i16(254), i64::from(self.bytes[123])),
            _ => (self.i32(344), self.i32(348), self.i32(500)),
        };
        let millimetres = match units & 7 {
            1 => 1000.0,
            3 => 0.001,
            _ => 1.0,
        };
        let to_millimetres = DAffine3::from_scale(DVec3::splat(millimetres));
        let usable = |t: &DAffine3| t.is_finite() && t.matrix3.determinant() != 0.0;
        if let Some(transform) = (sform > 0).then(|| self.sform()).filter(usable) {
            return Ok(to_millimetres * transform);
        }
        let sizes = self.voxel_sizes(blame, dims)?;
        match (qform > 0).then(|| self.qform(sizes)).filter(usable) {
            Some(transform) => Ok(to_millimetres * transform),
            None => Ok(to_millimetres * DAffine3::from_scale(sizes)),
        }
    }

    fn sform(&self) -> DAffine3 {
        let row = |r: usize| -> [f64; 4] { std::array::from_fn(|c| self.real(280, 400, 4 * r + c)) };
        let [x, y, z] = [row(0), row(1), row(2)];
        let column = |c: usize| DVec3::new(x[c], y[c], z[c]);
        affine([column(0), column(1), column(2)], column(3))
    }

    fn qform(&self, sizes: DVec3) -> DAffine3 {
        let [b, c, d] = std::array::from_fn(|i| self.real(256, 352, i));
        let offset = DVec3::from_array(std::array::from_fn(|i| self.real(268, 376, i)));
        let imaginary = b * b + c * c + d * d;
        let quaternion = glam::DQuat::from_xyzw(b, c, d, (1.0 - imaginary).max(0.0).sqrt());
        if !(quaternion.is_finite() && quaternion.length() > 0.0) {
            return DAffine3::from_mat3_translation(DMat3::ZERO, offset);
        }
        let mirror = if self.real(76, 104, 0) < 0.0 { -1.0 } else { 1.0 };
        let scale = DMat3::from_diagonal(sizes * DVec3::new(1.0, 1.0, mirror));
        DAffine3::from_mat3_translation(DMat3::from_quat(quaternion.normalize()) * scale, offset)
    }

    fn voxel_sizes(&self, blame: Blame<'_>, dims: [u32; 3]) -> Result<DVec3, ReadError> {
        let mut sizes = DVec3::ONE;
        for axis in 0..3 {
            let size = self.real(76, 104, axis + 1).abs();
            if size.is_finite() && size > 0.0 {
                sizes[axis] = size;
            } else if dims[axis] > 1 {
                return Err(blame.header(format!("pixdim[{}]", axis + 1), size, "a size of voxels above 0"));
            }
        }
        Ok(sizes)
    }
}
