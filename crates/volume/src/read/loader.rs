//! The one place where voxels are read: sizes are checked first, then bytes are unpacked, put in order and counted.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};

use flate2::read::{MultiGzDecoder, ZlibDecoder};
use rayon::prelude::*;

use super::error::{Blame, ReadError};
use super::layout::{Encoding, Endian, RawLayout, Start};
use super::{Progress, ascii};
use crate::{Element, ElementType, Volume, Voxels};

/// Bytes read between two reports of progress.
const CHUNK: usize = 1 << 23;

/// Deflate cannot shrink data further than to one byte in 1032, so a small file cannot hold more than that.
const DEFLATE_LIMIT: u64 = 1032;

/// Reads the voxels that `layout` describes; `blame` is the file with the header.
pub(super) fn load(
    layout: RawLayout,
    blame: Blame<'_>,
    progress: &mut dyn FnMut(Progress),
) -> Result<Volume, ReadError> {
    layout.check(blame)?;
    let bytes = layout.byte_count(blame)?;
    let source = Source::open(&layout, blame, bytes)?;
    let voxels = match layout.element {
        ElementType::U8 => read_as::<u8>(source, &layout, progress),
        ElementType::I8 => read_as::<i8>(source, &layout, progress),
        ElementType::U16 => read_as::<u16>(source, &layout, progress),
        ElementType::I16 => read_as::<i16>(source, &layout, progress),
        ElementType::U32 => read_as::<u32>(source, &layout, progress),
        ElementType::I32 => read_as::<i32>(source, &layout, progress),
        ElementType::U64 => read_as::<u64>(source, &layout, progress),
        ElementType::I64 => read_as::<i64>(source, &layout, progress),
        ElementType::F32 => read_as::<f32>(source, &layout, progress),
        ElementType::F64 => read_as::<f64>(source, &layout, progress),
    }?;
    Volume::new(layout.name, layout.dims, layout.channels, voxels, layout.index_to_world)
        .and_then(|volume| volume.with_rescale(layout.slope, layout.intercept))
        .map_err(blame.volume())
}

/// An opened data file, positioned at the first voxel.
struct Source<'a> {
    unpacked: Box<dyn Read>,
    /// Bytes of voxels that the header promises.
    bytes: u64,
    data: Blame<'a>,
    header: Blame<'a>,
}

impl<'a> Source<'a> {
    fn open(layout: &'a RawLayout, header: Blame<'a>, bytes: u64) -> Result<Self, ReadError> {
        let data = Blame { file: &layout.data_file };
        let mut file = rayloom_files::open(data.file).map_err(data.io("open the file with the voxels"))?;
        let length = file.metadata().map_err(data.io("look up the size"))?.len();
        let start = start_of_data(&mut file, layout, data, length, bytes)?;
        let packed = length.saturating_sub(start);
        let most = match layout.encoding {
            Encoding::Raw => packed,
            Encoding::Gzip | Encoding::Zlib => packed.saturating_mul(DEFLATE_LIMIT),
            // A digit and a space at least; the last space may be missing.
            Encoding::Ascii => packed.div_ceil(2).saturating_mul(layout.element.size() as u64),
        };
        let found = most.saturating_sub(layout.skip_unpacked);
        if found < bytes {
            return Err(ReadError::TooShort {
                file: data.file.to_owned(),
                header: header.file.to_owned(),
                expected: bytes,
                found,
            });
        }
        file.seek(SeekFrom::Start(start)).map_err(data.io("find the voxels"))?;
        let mut unpacked: Box<dyn Read> = match layout.encoding {
            Encoding::Raw | Encoding::Ascii => Box::new(file),
            Encoding::Gzip => Box::new(MultiGzDecoder::new(BufReader::with_capacity(1 << 17, file))),
            Encoding::Zlib => Box::new(ZlibDecoder::new(BufReader::with_capacity(1 << 17, file))),
        };
        skip(&mut unpacked, layout.skip_unpacked).map_err(data.io("skip to the voxels"))?;
        Ok(Self { unpacked, bytes, data, header })
    }

    fn too_short(&self, found: usize) -> ReadError {
        ReadError::TooShort {
            file: self.data.file.to_owned(),
            header: self.header.file.to_owned(),
            expected: self.bytes,
            found: found as u64,
        }
    }
}

fn start_of_data(
    file: &mut File,
    layout: &RawLayout,
    data: Blame<'_>,
    length: u64,
    bytes: u64,
) -> Result<u64, ReadError> {
    match layout.start {
        Start::At(start) => Ok(start),
        Start::EndOfFile => Ok(length.saturating_sub(bytes)),
        Start::AfterLines(lines) => {
            let mut reader = BufReader::new(file);
            let mut start = 0;
            for _ in 0..lines {
                let line = reader.skip_until(b'\n').map_err(data.io("skip the lines before the voxels"))?;
                if line == 0 {
                    break;
                }
                start += line as u64;
            }
            Ok(start)
        }
    }
}

fn skip(reader: &mut dyn Read, bytes: u64) -> std::io::Result<()> {
    std::io::copy(&mut reader.take(bytes), &mut std::io::sink()).map(drop)
}

fn read_as<E: Element>(
    source: Source<'_>,
    layout: &RawLayout,
    progress: &mut dyn FnMut(Progress),
) -> Result<Voxels, ReadError> {
    let mut elements = match layout.encoding {
        Encoding::Ascii => ascii::read::<E>(
            source.unpacked,
            source.bytes / size_of::<E>() as u64,
            source.data,
            source.header,
            progress,
        )?,
        _ => read_binary::<E>(source, layout, progress)?,
    };
    if layout.planar && layout.channels > 1 {
        elements = interleaved(&elements, layout.channels as usize);
    }
    Ok(E::wrap(elements))
}

/// Reads chunk by chunk into an array that grows with what is really there, so that a header that lies about compressed
/// data costs no more memory than the data.
fn read_binary<E: Element>(
    mut source: Source<'_>,
    layout: &RawLayout,
    progress: &mut dyn FnMut(Progress),
) -> Result<Vec<E>, ReadError> {
    let total = (source.bytes / size_of::<E>() as u64) as usize;
    let mut elements: Vec<E> = Vec::new();
    while elements.len() < total {
        let chunk = (CHUNK / size_of::<E>()).min(total - elements.len());
        let start = elements.len();
        elements
            .try_reserve(chunk)
            .map_err(|_| ReadError::Memory { file: source.data.file.to_owned(), bytes: source.bytes })?;
        elements.resize(start + chunk, E::zeroed());
        let wanted: &mut [u8] = bytemuck::cast_slice_mut(&mut elements[start..]);
        let found = fill(&mut source.unpacked, wanted).map_err(source.data.io("read the voxels"))?;
        if found < wanted.len() {
            return Err(source.too_short(start * size_of::<E>() + found));
        }
        if layout.endian != Endian::NATIVE && size_of::<E>() > 1 {
            elements[start..].par_iter_mut().for_each(|element| *element = element.reversed());
        }
        progress(Progress { done: (elements.len() * size_of::<E>()) as u64, total: source.bytes });
    }
    // The checksum of compressed data is compared when its end is read, not before.
    if layout.encoding != Encoding::Raw {
        let _further = source.unpacked.read(&mut [0]).map_err(source.data.io("verify the checksum of the voxels"))?;
    }
    elements.shrink_to_fit();
    Ok(elements)
}

/// Fills the buffer as far as there is data. A compressed stream that ends early counts as the end of the data.
fn fill(reader: &mut dyn Read, mut buffer: &mut [u8]) -> std::io::Result<usize> {
    let wanted = buffer.len();
    while !buffer.is_empty() {
        match reader.read(buffer) {
            Ok(0) => break,
            Ok(n) => buffer = &mut buffer[n..],
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => break,
            Err(error) => return Err(error),
        }
    }
    Ok(wanted - buffer.len())
}

fn interleaved<E: Element>(planes: &[E], channels: usize) -> Vec<E> {
    let voxels = planes.len() / channels;
    (0..planes.len()).into_par_iter().map(|at| planes[at % channels * voxels + at / channels]).collect()
}
