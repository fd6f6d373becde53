//! Voxels written as decimal numbers.

use std::io::{BufRead, BufReader, Read};

use super::Progress;
use super::error::{Blame, ReadError};
use crate::Element;

/// Longer runs of text without white space are not numbers.
const LONGEST_NUMBER: u64 = 400;

/// Reads `count` numbers separated by white space or commas.
pub(super) fn read<E: Element>(
    source: impl Read,
    count: u64,
    data: Blame<'_>,
    header: Blame<'_>,
    progress: &mut dyn FnMut(Progress),
) -> Result<Vec<E>, ReadError> {
    let mut reader = BufReader::new(source);
    let mut elements = Vec::new();
    let size = size_of::<E>() as u64;
    while (elements.len() as u64) < count {
        let word = next_word(&mut reader).map_err(data.io("read the voxels"))?;
        if word.is_empty() {
            let (file, header, found) = (data.file.to_owned(), header.file.to_owned(), elements.len() as u64 * size);
            return Err(ReadError::TooShort { file, header, expected: count * size, found });
        }
        elements.push(parse::<E>(&word).ok_or_else(|| {
            let expected = format!("a number of type {}", E::TYPE);
            data.header(format!("voxel number {}", elements.len()), String::from_utf8_lossy(&word), expected)
        })?);
        if elements.len() % (1 << 20) == 0 || elements.len() as u64 == count {
            progress(Progress { done: elements.len() as u64 * size, total: count * size });
        }
    }
    Ok(elements)
}

fn is_separator(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == b','
}

/// The next run of bytes that are no separators; empty at the end of the data.
fn next_word(reader: &mut impl BufRead) -> std::io::Result<Vec<u8>> {
    let mut word = Vec::new();
    loop {
        let buffer = reader.fill_buf()?;
        if buffer.is_empty() {
            return Ok(word);
        }
        let start = if word.is_empty() { buffer.iter().take_while(|&&b| is_separator(b)).count() } else { 0 };
        let rest = &buffer[start..];
        let end = rest.iter().position(|&b| is_separator(b));
        word.extend_from_slice(&rest[..end.unwrap_or(rest.len())]);
        let used = start + end.unwrap_or(rest.len());
        reader.consume(used);
        if (end.is_some() && !word.is_empty()) || word.len() as u64 > LONGEST_NUMBER {
            return Ok(word);
        }
    }
}

/// A number of this type, exact for 64-bit integers too; none when it does not fit.
fn parse<E: Element>(word: &[u8]) -> Option<E> {
    let text = std::str::from_utf8(word).ok()?;
    if E::TYPE.is_float() {
        return text.parse().ok().map(E::from_f64);
    }
    let wide: i128 = text.parse().ok()?;
    let bytes = wide.to_ne_bytes();
    let at = if cfg!(target_endian = "big") { bytes.len() - size_of::<E>() } else { 0 };
    let element: E = bytemuck::pod_read_unaligned(&bytes[at..at + size_of::<E>()]);
    let fits = wide >= E::LOWEST.to_f64() as i128 && wide <= highest::<E>();
    fits.then_some(element)
}

/// The largest integer of this type, exact where `f64` is not.
fn highest<E: Element>() -> i128 {
    match E::TYPE {
        crate::ElementType::U64 => i128::from(u64::MAX),
        crate::ElementType::I64 => i128::from(i64::MAX),
        _ => E::HIGHEST.to_f64() as i128,
    }
}
