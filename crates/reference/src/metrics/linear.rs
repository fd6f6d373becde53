//! Errors of linear pictures.
//!
//! Everything is measured on linear, premultiplied pixels `[r, g, b, a]`, before any tone curve. A difference that is not a
//! number (either side not finite) counts as infinite, so that no bad pixel improves a mean.

use rayon::prelude::*;

/// Half a code of an 8-bit image: a larger error may be seen.
pub const VISIBLE_ERROR: f64 = 1.0 / 510.0;

/// Transmittances are held above this before their logarithms are compared: an `f32` opacity near 1 tells no smaller ones
/// apart.
pub const TRANSMITTANCE_FLOOR: f64 = 1e-6;

/// A premultiplied pixel of either precision.
pub trait Pixel: Copy + Sync {
    /// The pixel in double precision.
    fn widen(self) -> [f64; 4];
}

impl Pixel for [f64; 4] {
    fn widen(self) -> [f64; 4] {
        self
    }
}

impl Pixel for [f32; 4] {
    fn widen(self) -> [f64; 4] {
        self.map(f64::from)
    }
}

/// Why two pictures cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// The pictures differ in size.
    #[error(
        "The pictures cannot be compared: one has {found} pixels, the reference {expected}. Render both at the same size."
    )]
    DifferentSizes {
        /// Pixels of the picture.
        found: usize,
        /// Pixels of the reference.
        expected: usize,
    },
    /// There is nothing to compare.
    #[error("The pictures cannot be compared: they have no pixels. Render at least one.")]
    Empty,
    /// A picture has another number of pixels than its size asks for.
    #[error("A picture of {} x {} pixels was given {found} of them.", size[0], size[1])]
    PixelCount {
        /// Width and height.
        size: [u32; 2],
        /// Pixels given.
        found: usize,
    },
    /// The pictures differ in shape.
    #[error(
        "The pictures cannot be compared: one is {} x {} pixels, the reference {} x {}. Render both at the same size.",
        found[0], found[1], expected[0], expected[1]
    )]
    DifferentShapes {
        /// Width and height of the picture.
        found: [u32; 2],
        /// Width and height of the reference.
        expected: [u32; 2],
    },
}

/// Statistics of the absolute error of one quantity over all pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorStatistics {
    /// Largest error: the guarantee.
    pub max: f64,
    /// Mean error.
    pub mean: f64,
    /// Root of the mean square error.
    pub rmse: f64,
    /// The error that 99 % of the pixels do not exceed (nearest rank).
    pub p99: f64,
}

impl ErrorStatistics {
    /// The statistics of `errors`, which are not negative; the order does not matter. All zero for no errors.
    pub fn of(mut errors: Vec<f64>) -> Self {
        if errors.is_empty() {
            return Self { max: 0.0, mean: 0.0, rmse: 0.0, p99: 0.0 };
        }
        errors.sort_unstable_by(f64::total_cmp);
        let count = errors.len() as f64;
        Self {
            max: errors[errors.len() - 1],
            mean: errors.iter().sum::<f64>() / count,
            rmse: (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt(),
            p99: nearest_rank(&errors, 0.99),
        }
    }
}

/// The smallest of some sorted numbers that a share of them does not exceed; there must be one number at least.
pub(super) fn nearest_rank(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted[rank.clamp(1, sorted.len()) - 1]
}

/// The distance of a picture from a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Absolute errors of red, green, blue (premultiplied) and opacity.
    pub channels: [ErrorStatistics; 4],
    /// Statistics of [`Comparison::pixel_errors`].
    pub pixels: ErrorStatistics,
    /// Error `|ln T - ln T_ref|` of the transmittance `T = 1 - a`: the optical depth, sensitive where the picture is deep
    /// and dark. Transmittances are held above [`TRANSMITTANCE_FLOOR`].
    pub transmittance: ErrorStatistics,
    /// Index of the worst pixel, the first of them in row order.
    pub worst: usize,
    /// Largest absolute error over the four channels of each pixel, in row order: the error map.
    pub pixel_errors: Vec<f64>,
}

impl Comparison {
    /// Compares `picture` with `reference` pixel by pixel; both in the same row order.
    ///
    /// # Errors
    /// The pictures are empty or differ in size.
    pub fn new<A: Pixel, B: Pixel>(picture: &[A], reference: &[B]) -> Result<Self, CompareError> {
        if picture.len() != reference.len() {
            return Err(CompareError::DifferentSizes { found: picture.len(), expected: reference.len() });
        }
        if picture.is_empty() {
            return Err(CompareError::Empty);
        }
        let errors: Vec<[f64; 5]> = picture
            .par_iter()
            .zip(reference)
            .map(|(&found, &expected)| pixel_errors(found.widen(), expected.widen()))
            .collect();
        let column = |i: usize| errors.iter().map(|e| e[i]).collect::<Vec<_>>();
        let pixel_errors: Vec<f64> = errors.iter().map(|e| e[..4].iter().copied().fold(0.0, f64::max)).collect();
        let pixels = ErrorStatistics::of(pixel_errors.clone());
        Ok(Self {
            channels: [0, 1, 2, 3].map(|i| ErrorStatistics::of(column(i))),
            pixels,
            transmittance: ErrorStatistics::of(column(4)),
            worst: pixel_errors.iter().position(|&e| e == pixels.max).unwrap_or(0),
            pixel_errors,
        })
    }

    /// Share, 0 to 1, of the pixels none of whose channels is wrong by more than `tolerance`.
    pub fn share_within(&self, tolerance: f64) -> f64 {
        let within = self.pixel_errors.iter().filter(|&&e| e <= tolerance).count();
        within as f64 / self.pixel_errors.len() as f64
    }

    /// Share, 0 to 1, of the pixels with an error above [`VISIBLE_ERROR`].
    pub fn share_visible(&self) -> f64 {
        let visible = self.pixel_errors.iter().filter(|&&e| e > VISIBLE_ERROR).count();
        visible as f64 / self.pixel_errors.len() as f64
    }
}

/// Absolute errors of the four channels and of the logarithm of the transmittance.
fn pixel_errors(found: [f64; 4], expected: [f64; 4]) -> [f64; 5] {
    let error = |found: f64, expected: f64| {
        let e = (found - expected).abs();
        if e.is_nan() { f64::INFINITY } else { e }
    };
    // Not `max`, which would turn what is not a number into the floor.
    let log_transmittance =
        |a: f64| if 1.0 - a < TRANSMITTANCE_FLOOR { TRANSMITTANCE_FLOOR.ln() } else { (-a).ln_1p() };
    [
        error(found[0], expected[0]),
        error(found[1], expected[1]),
        error(found[2], expected[2]),
        error(found[3], expected[3]),
        error(log_transmittance(found[3]), log_transmittance(expected[3])),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_computed_comparison() -> Result<(), CompareError> {
        let mut reference = vec![[0.0, 0.0, 0.0, 0.5]; 200];
        let mut picture = reference.clone();
        picture[7] = [0.3, 0.0, 0.0, 0.75];
        picture[9] = [0.0, 0.1, 0.0, 0.5];
        picture[11] = [0.001, 0.0, 0.0, 0.5];
        let comparison = Comparison::new(&picture, &reference)?;
        let [red, green, blue, opacity] = comparison.channels;
        assert_eq!((red.max, green.max, blue.max, opacity.max), (0.3, 0.1, 0.0, 0.25));
        assert!((red.mean - 0.301 / 200.0).abs() < 1e-15);
        assert!((red.rmse - ((0.09 + 1e-6) / 200.0_f64).sqrt()).abs() < 1e-15);
        // Rank 198 of 200: two worse pixels are left out.
        assert_eq!(comparison.pixels.p99, 0.001);
        assert_eq!(comparison.worst, 7);
        assert_eq!(comparison.share_within(0.0), 197.0 / 200.0);
        assert_eq!(comparison.share_within(0.1), 199.0 / 200.0);
        assert_eq!(comparison.share_visible(), 2.0 / 200.0);
        assert!((comparison.transmittance.max - 2.0_f64.ln()).abs() < 1e-15);
        reference.pop();
        assert!(Comparison::new(&picture, &reference).is_err());
        assert_eq!(Comparison::new::<[f32; 4], [f64; 4]>(&[], &[]), Err(CompareError::Empty));
        Ok(())
    }

    #[test]
    fn opaque_and_broken_pixels() -> Result<(), CompareError> {
        let opaque = Comparison::new(&[[0.0f32, 0.0, 0.0, 1.0]], &[[0.0, 0.0, 0.0, 1.0 - 1e-9]])?;
        assert_eq!(opaque.transmittance.max, 0.0);
        let broken = Comparison::new(&[[0.0, f32::NAN, 0.0, f32::NAN]], &[[0.0; 4]])?;
        assert_eq!((broken.pixels.max, broken.transmittance.max), (f64::INFINITY, f64::INFINITY));
        assert_eq!(broken.share_visible(), 1.0);
        Ok(())
    }
}
