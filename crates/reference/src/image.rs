//! Pictures as the reference renders them.

use crate::scene::SceneError;

/// View depth of a pixel in which nothing was met, in world units; the value that GPU depth images hold there.
pub const MISS: f64 = 3.0e38;

/// Part of a picture, in pixels from its top left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    /// Leftmost column.
    pub x: u32,
    /// Topmost row.
    pub y: u32,
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
}

impl Rectangle {
    /// Checks that there is something in this rectangle and that it lies within a picture of `size`.
    pub(crate) fn check_within(self, size: [u32; 2]) -> Result<(), SceneError> {
        let fits = |start: u32, count: u32, limit: u32| count > 0 && start < limit && count <= limit - start;
        if fits(self.x, self.width, size[0]) && fits(self.y, self.height, size[1]) {
            Ok(())
        } else {
            Err(SceneError::Rectangle { found: self, size })
        }
    }
}

/// A picture with depth, row 0 at the top, x fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Linear premultiplied red, green, blue and opacity.
    pub color: Vec<[f64; 4]>,
    /// View depth in world units, along the viewing direction, or [`MISS`].
    pub depth: Vec<f64>,
}

impl Image {
    /// Colour of the pixel in column `x` and row `y`; transparent outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [f64; 4] {
        let [width, height] = self.size;
        if x < width && y < height { self.color[y as usize * width as usize + x as usize] } else { [0.0; 4] }
    }
}

/// What a ray brings back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelResult {
    /// Linear premultiplied red, green, blue and opacity.
    pub color: [f64; 4],
    /// View depth in world units, or [`MISS`].
    pub depth: f64,
}

impl PixelResult {
    /// Nothing met.
    pub const NOTHING: Self = Self { color: [0.0; 4], depth: MISS };

    /// Puts straight `color` of some opacity behind what is there; the depth is that of the first.
    pub(crate) fn put_behind(&mut self, [r, g, b]: [f64; 3], opacity: f64, depth: f64) {
        if self.color[3] == 0.0 {
            self.depth = depth;
        }
        let weight = (1.0 - self.color[3]) * opacity;
        for (sum, c) in self.color.iter_mut().zip([r, g, b, 1.0]) {
            *sum += weight * c;
        }
    }
}
