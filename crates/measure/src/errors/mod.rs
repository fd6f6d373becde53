//! How far pictures are from what they should show: here the errors of a setting over all its views.

pub(crate) mod color;
pub(crate) mod estimate;
pub(crate) mod surface;

use rayloom_reference::Comparison;
use rayloom_reference::metrics::Pixel;
use serde::Serialize;

use crate::MeasureError;

/// How far pictures are from their reference; of every pixel the largest error of its four premultiplied channels counts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// Largest error: the guarantee.
    pub max: f64,
    /// Mean error.
    pub mean: f64,
    /// Root of the mean square error.
    pub rmse: f64,
    /// The error that 99 % of the pixels do not exceed.
    pub p99: f64,
    /// Share of the pixels that are off by more than 1/510, half a code of an 8-bit image.
    pub visible: f64,
    /// Largest error of the logarithm of the transmittance.
    pub transmittance: f64,
    /// Index of the worst pixel, row by row and view by view.
    pub worst: usize,
}

impl Errors {
    /// Of a picture or several in a row, with the error of each pixel.
    ///
    /// # Errors
    /// Pictures that differ in size, or that are empty.
    pub fn of<A: Pixel, B: Pixel>(pictures: &[A], reference: &[B]) -> Result<(Self, Vec<f64>), MeasureError> {
        let comparison = Comparison::new(pictures, reference)?;
        let errors = Self {
            max: comparison.pixels.max,
            mean: comparison.pixels.mean,
            rmse: comparison.pixels.rmse,
            p99: comparison.pixels.p99,
            visible: comparison.share_visible(),
            transmittance: comparison.transmittance.max,
            worst: comparison.worst,
        };
        Ok((errors, comparison.pixel_errors))
    }
}
