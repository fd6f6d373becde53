//! Writers of tiny files in every format, as the tests need them.

use std::io::Write;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};
use rayloom_volume::{ElementType, ReadError, Volume, Voxels, read};

/// The grid of every tiny volume.
pub const DIMS: [u32; 3] = [3, 2, 4];

/// Little or big endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    Little,
    Big,
}

pub const ORDERS: [Order; 2] = [Order::Little, Order::Big];

/// Reads without looking at the progress.
pub fn load(path: &Path) -> Result<Volume, ReadError> {
    read(path, &mut |_| ())
}

/// Voxels of the given type that include its extremes.
pub fn voxels(element: ElementType, channels: u32) -> Voxels {
    let count = DIMS.iter().product::<u32>() * channels;
    macro_rules! filled {
        ($variant:ident, $type:ty) => {
            Voxels::$variant(
                (0..count)
                    .map(|i| match i {
                        0 => <$type>::MIN,
                        1 => <$type>::MAX,
                        i => (i * 3) as $type,
                    })
                    .collect(),
            )
        };
    }
    match element {
        ElementType::U8 => filled!(U8, u8),
        ElementType::I8 => filled!(I8, i8),
        ElementType::U16 => filled!(U16, u16),
        ElementType::I16 => filled!(I16, i16),
        ElementType::U32 => filled!(U32, u32),
        ElementType::I32 => filled!(I32, i32),
        ElementType::U64 => filled!(U64, u64),
        ElementType::I64 => filled!(I64, i64),
        ElementType::F32 => filled!(F32, f32),
        ElementType::F64 => filled!(F64, f64),
    }
}

/// The bytes of the voxels in the given order.
pub fn bytes(voxels: &Voxels, order: Order) -> Vec<u8> {
    macro_rules! flat {
        ($elements:expr) => {
            $elements
                .iter()
                .flat_map(|v| match order {
                    Order::Little => v.to_le_bytes().to_vec(),
                    Order::Big => v.to_be_bytes().to_vec(),
                })
                .collect()
        };
    }
    rayloom_volume::with_voxels!(voxels, elements => flat!(elements))
}

/// The voxels as text.
pub fn text(voxels: &Voxels) -> Vec<u8> {
    rayloom_volume::with_voxels!(voxels, elements => elements.iter().map(|v| format!("{v:?}\n")).collect::<String>().into_bytes())
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// Writes a file into a folder.
pub fn put(folder: &Path, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, contents).unwrap();
    path
}

/// A NIfTI header under construction: fields are written at their offsets in the byte order of the file.
pub struct Nifti {
    pub bytes: Vec<u8>,
    pub order: Order,
    pub version: u8,
}

impl Nifti {
    /// A single-file header of the given version, element type and dimensions, padded to where the voxels start.
    pub fn new(version: u8, order: Order, datatype: i16, dims: [u32; 3]) -> Self {
        let mut header = Self { bytes: vec![0; if version == 2 { 544 } else { 352 }], order, version };
        match version {
            2 => {
                header.i32(0, 540);
                header.bytes[4..12].copy_from_slice(b"n+2\0\r\n\x1a\n");
                header.i16(12, datatype);
                header.i64(168, 544);
                header.i32(500, 2);
            }
            _ => {
                header.i32(0, 348);
                header.bytes[344..348].copy_from_slice(b"n+1\0");
                header.i16(70, datatype);
                header.f32(108, 352.0);
                header.bytes[123] = 2;
            }
        }
        header.dim(0, 3);
        for (axis, dim) in dims.into_iter().enumerate() {
            header.dim(axis + 1, i64::from(dim));
            header.real(76, 104, axis + 1, 1.0);
        }
        header
    }

    fn write<const N: usize>(&mut self, offset: usize, little: [u8; N]) {
        let mut bytes = little;
        if self.order == Order::Big {
            bytes.reverse();
        }
        self.bytes[offset..offset + N].copy_from_slice(&bytes);
    }

    pub fn i16(&mut self, offset: usize, value: i16) {
        self.write(offset, value.to_le_bytes());
    }

    pub fn i32(&mut self, offset: usize, value: i32) {
        self.write(offset, value.to_le_bytes());
    }

    pub fn i64(&mut self, offset: usize, value: i64) {
        self.write(offset, value.to_le_bytes());
    }

    pub fn f32(&mut self, offset: usize, value: f32) {
        self.write(offset, value.to_le_bytes());
    }

    pub fn dim(&mut self, index: usize, value: i64) {
        match self.version {
            2 => self.i64(16 + 8 * index, value),
            _ => self.i16(40 + 2 * index, value as i16),
        }
    }

    /// A real number of an array that starts at these offsets in version 1 and 2.
    pub fn real(&mut self, offset_1: usize, offset_2: usize, index: usize, value: f64) {
        match self.version {
            2 => self.write(offset_2 + 8 * index, value.to_le_bytes()),
            _ => self.f32(offset_1 + 4 * index, value as f32),
        }
    }

    pub fn rescale(&mut self, slope: f64, intercept: f64) {
        self.real(112, 176, 0, slope);
        self.real(116, 184, 0, intercept);
    }

    pub fn sform(&mut self, rows: [[f64; 4]; 3]) {
        match self.version {
            2 => self.i32(348, 1),
            _ => self.i16(254, 1),
        }
        rows.iter().flatten().enumerate().for_each(|(i, &v)| self.real(280, 400, i, v));
    }

    pub fn qform(&mut self, quaternion: [f64; 3], offset: [f64; 3], mirror: f64) {
        match self.version {
            2 => self.i32(344, 1),
            _ => self.i16(252, 1),
        }
        self.real(76, 104, 0, mirror);
        quaternion.iter().enumerate().for_each(|(i, &v)| self.real(256, 352, i, v));
        offset.iter().enumerate().for_each(|(i, &v)| self.real(268, 376, i, v));
    }

    pub fn with(&self, voxels: &[u8]) -> Vec<u8> {
        [&self.bytes, voxels].concat()
    }
}

/// The NIfTI code of an element type.
pub fn nifti_code(element: ElementType) -> i16 {
    match element {
        ElementType::U8 => 2,
        ElementType::I16 => 4,
        ElementType::I32 => 8,
        ElementType::F32 => 16,
        ElementType::F64 => 64,
        ElementType::I8 => 256,
        ElementType::U16 => 512,
        ElementType::U32 => 768,
        ElementType::I64 => 1024,
        ElementType::U64 => 1280,
    }
}
