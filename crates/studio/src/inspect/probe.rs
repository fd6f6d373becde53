//! The exact value of one pixel.

use std::sync::Arc;

use rayloom_gpu::{Gpu, GpuError};
use rayloom_processors::{Image, MISS};

/// A pixel that someone wants to know.
#[derive(Clone, Debug)]
pub struct Pixel {
    /// The image.
    pub image: Arc<Image>,
    /// Column and row, from the upper left.
    pub at: [u32; 2],
}

impl Pixel {
    /// Whether it is the same pixel of the same image.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.image, &other.image) && self.at == other.at
    }
}

/// What a pixel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Column and row.
    pub at: [u32; 2],
    /// The four channels.
    pub color: [f32; 4],
    /// View depth, world units, where there is any and something was hit.
    pub depth: Option<f32>,
}

impl Reading {
    /// Reads a pixel. Waits for the device: not for the window's thread.
    ///
    /// # Errors
    /// The pixel is outside of the image; the device is lost.
    pub fn of(gpu: &Gpu, pixel: &Pixel) -> Result<Self, GpuError> {
        let [x, y] = pixel.at;
        let read = |texture| gpu.read_region(texture, [x, y, 0], [1; 3]).map(|texels| texels[0]);
        let depth = pixel.image.depth.as_ref().map(|depth| read(depth)).transpose()?.map(|texel| texel[0]);
        let color = read(&pixel.image.color)?;
        Ok(Self { at: pixel.at, color, depth: depth.filter(|&depth| depth < MISS) })
    }
}
