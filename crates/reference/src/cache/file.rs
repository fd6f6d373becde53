//! Pictures as files: a header of five words, then colours and depths as float64, then a check sum, all little-endian.

use super::digest::Digest;
use crate::image::Image;
use std::io;
use std::path::Path;

/// "RAYLOOM" and the version of the layout.
const MAGIC: u64 = u64::from_le_bytes(*b"RAYLOOM\x01");
const HEADER_WORDS: usize = 5;
const WORD: usize = 8;
const NUMBERS_PER_PIXEL: usize = 5;

/// The picture in a file, if it is whole and has this key and size.
pub(super) fn read(path: &Path, key: u128, size: [u32; 2]) -> Option<Image> {
    let count = size[0] as usize * size[1] as usize;
    let expected = (HEADER_WORDS + count * NUMBERS_PER_PIXEL + 2) * WORD;
    let bytes = rayloom_files::read(path, expected as u64).ok()?;
    let words: Vec<u64> = bytes.as_chunks::<WORD>().0.iter().map(|word| u64::from_le_bytes(*word)).collect();
    if words.len() * WORD != expected {
        return None;
    }
    let (content, sum) = words.split_at(words.len() - 2);
    let (header, pixels) = content.split_at(HEADER_WORDS);
    if header != self::header(key, size) || sum != halves(check_sum(content)) {
        return None;
    }
    let (colors, depths) = pixels.split_at(count * 4);
    Some(Image {
        size,
        color: colors.as_chunks::<4>().0.iter().map(|color| color.map(f64::from_bits)).collect(),
        depth: depths.iter().copied().map(f64::from_bits).collect(),
    })
}

/// Writes a picture so that a reader finds either all of it or what was there before.
pub(super) fn write(path: &Path, key: u128, image: &Image) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let numbers = image.color.iter().flatten().chain(&image.depth).map(|number| number.to_bits());
    let mut words: Vec<u64> = header(key, image.size).into_iter().chain(numbers).collect();
    words.extend(halves(check_sum(&words)));
    let bytes: Vec<u8> = words.into_iter().flat_map(u64::to_le_bytes).collect();
    rayloom_files::write(path, &bytes)
}

fn header(key: u128, size: [u32; 2]) -> [u64; HEADER_WORDS] {
    let [low, high] = halves(key);
    [MAGIC, low, high, size[0].into(), size[1].into()]
}

fn check_sum(words: &[u64]) -> u128 {
    let mut digest = Digest::new();
    words.iter().for_each(|&word| digest.word(word));
    digest.state
}

fn halves(number: u128) -> [u64; 2] {
    [number as u64, (number >> 64) as u64]
}
