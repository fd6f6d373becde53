//! Pictures of a screen.

use std::collections::HashSet;
use std::path::Path;

/// Colours that a window with a rendered volume has at least (8000 are usual); one with panels and text alone has 1600.
const COLORS: usize = 3000;
/// How much a channel must differ to count, of 255: more than the edge of a cursor or a spinner does by chance.
const STEP: u8 = 16;
/// Part of the pixels that must differ for pictures to be different; a cursor covers less.
const PART: f64 = 0.02;

/// Red, green and blue, row by row from the top.
pub struct Picture {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// From the format of `xwd` with 32 bits a pixel; `None` if it is another one.
    pub fn from_xwd(bytes: &[u8]) -> Option<Self> {
        let field = |index: usize| {
            let four = bytes.get(4 * index..4 * index + 4)?;
            usize::try_from(u32::from_be_bytes(four.try_into().ok()?)).ok()
        };
        let (header, width, height, little) = (field(0)?, field(4)?, field(5)?, field(7)? == 0);
        let (bits, row, colors) = (field(11)?, field(12)?, field(19)?);
        if bits != 32 {
            return None;
        }
        // After the header comes a colour map with entries of 12 bytes.
        let rows = bytes.get(header + 12 * colors..)?.chunks(row).take(height);
        let pixels = rows.flat_map(|row| row.chunks_exact(4).take(width)).map(|pixel| match little {
            true => [pixel[2], pixel[1], pixel[0]],
            false => [pixel[1], pixel[2], pixel[3]],
        });
        let picture = Self { width, pixels: pixels.collect() };
        (picture.pixels.len() == width * height).then_some(picture)
    }

    /// A rectangle: left, top, width, height.
    pub fn part(&self, [left, top, width, height]: [u32; 4]) -> Self {
        let [left, top, width, height] = [left, top, width, height].map(|pixels| pixels as usize);
        let rows = self.pixels.chunks(self.width).skip(top).take(height);
        let pixels = rows.flat_map(|row| row.iter().skip(left).take(width)).copied().collect();
        Self { width, pixels }
    }

    /// Whether it has as many colours as a rendered volume.
    pub fn is_rich(&self) -> bool {
        self.pixels.iter().collect::<HashSet<_>>().len() >= COLORS
    }

    /// Whether it shows something else than a picture of the same size.
    pub fn differs(&self, other: &Self) -> bool {
        let pairs = self.pixels.iter().zip(&other.pixels);
        let different = pairs.filter(|(a, b)| a.iter().zip(b.iter()).any(|(a, b)| a.abs_diff(*b) > STEP)).count();
        different as f64 > PART * self.pixels.len() as f64
    }

    /// Writes a PPM file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), String> {
        let mut bytes = format!("P6 {} {} 255\n", self.width, self.pixels.len() / self.width.max(1)).into_bytes();
        bytes.extend(self.pixels.iter().flatten());
        std::fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
    }
}
