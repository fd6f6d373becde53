//! Errors of pictures as a display shows them.

use super::ciede2000::ciede2000;
use super::color::{Lab, srgb_encode};
use super::filter::Plane;
use super::flip::Flip;
use super::linear::{CompareError, Pixel, nearest_rank};
use super::ssim::ssim;
use rayon::prelude::*;

/// An opaque picture of 8-bit sRGB codes, row 0 at the top, x fastest; it has one pixel at least.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DisplayPicture {
    size: [u32; 2],
    pixels: Vec<[u8; 3]>,
}

impl DisplayPicture {
    /// A picture of these pixels.
    ///
    /// # Errors
    /// There are no pixels, or not as many as width times height.
    pub fn new(size: [u32; 2], pixels: Vec<[u8; 3]>) -> Result<Self, CompareError> {
        if pixels.len() as u64 != u64::from(size[0]) * u64::from(size[1]) {
            return Err(CompareError::PixelCount { size, found: pixels.len() });
        }
        if pixels.is_empty() { Err(CompareError::Empty) } else { Ok(Self { size, pixels }) }
    }

    /// What a display shows of linear premultiplied pixels over a linear background.
    ///
    /// # Errors
    /// There are no pixels, or not as many as width times height.
    pub fn of<P: Pixel>(size: [u32; 2], pixels: &[P], background: [f64; 3]) -> Result<Self, CompareError> {
        let shown = |pixel: &P| {
            let [r, g, b, a] = pixel.widen();
            let over = |premultiplied: f64, behind: f64| srgb_encode(premultiplied + (1.0 - a) * behind);
            [over(r, background[0]), over(g, background[1]), over(b, background[2])]
        };
        Self::new(size, pixels.par_iter().map(shown).collect())
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    pub(super) fn plane(&self, value: impl Fn([u8; 3]) -> f64 + Sync) -> Plane {
        let values = self.pixels.par_iter().map(|&pixel| value(pixel)).collect();
        Plane { size: self.size.map(|n| n as usize), values }
    }

    pub(super) fn check_like(&self, reference: &Self) -> Result<(), CompareError> {
        if self.size == reference.size {
            Ok(())
        } else {
            Err(CompareError::DifferentShapes { found: self.size, expected: reference.size })
        }
    }
}

/// The visible distance of a picture from a reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayComparison {
    /// Peak signal-to-noise ratio of the codes, decibels; infinite for equal pictures.
    pub psnr: f64,
    /// Mean structural similarity, see [`ssim`]; 1 for equal pictures.
    pub ssim: f64,
    /// Mean colour difference, see [`ciede2000`].
    pub ciede2000_mean: f64,
    /// The colour difference that 95 % of the pixels do not exceed (nearest rank).
    pub ciede2000_p95: f64,
    /// Mean of the map of [`Flip`] for its default viewer, 0 to 1.
    pub flip_mean: f64,
}

impl DisplayComparison {
    /// Compares `picture` with `reference`.
    ///
    /// # Errors
    /// The pictures differ in size.
    pub fn new(picture: &DisplayPicture, reference: &DisplayPicture) -> Result<Self, CompareError> {
        picture.check_like(reference)?;
        let pairs = picture.pixels.par_iter().zip(&reference.pixels);
        let mut differences: Vec<f64> =
            pairs.map(|(&a, &b)| if a == b { 0.0 } else { ciede2000(Lab::of_srgb(b), Lab::of_srgb(a)) }).collect();
        differences.sort_unstable_by(f64::total_cmp);
        let flip = Flip::default().map(picture, reference)?;
        Ok(Self {
            psnr: psnr(picture, reference),
            ssim: ssim(picture, reference)?,
            ciede2000_mean: mean(&differences),
            ciede2000_p95: nearest_rank(&differences, 0.95),
            flip_mean: mean(&flip),
        })
    }
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// `10 log₁₀(255² / mean square error)` over all codes.
fn psnr(picture: &DisplayPicture, reference: &DisplayPicture) -> f64 {
    let codes = picture.pixels.iter().flatten().zip(reference.pixels.iter().flatten());
    let squares: u64 = codes.map(|(&a, &b)| u64::from(a.abs_diff(b)).pow(2)).sum();
    let mean_square = squares as f64 / (3 * picture.pixels.len()) as f64;
    10.0 * (255.0 * 255.0 / mean_square).log10()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A busy picture, and one that differs from it by grain, blocks and a bright bar.
    fn pair(width: u32, height: u32) -> [DisplayPicture; 2] {
        let places = || (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
        let first = |(x, y)| [(x * 7 + y * 3) % 256, (x * x + 5 * y) % 256, (x * y * 2 + 40) % 256].map(|c| c as i32);
        let second = |(x, y)| {
            if y >= 3 * height / 4 && (width / 2..width / 2 + 3).contains(&x) {
                return [255; 3];
            }
            let [r, g, b] = first((x, y));
            let block = if (x / 4 + y / 4) % 2 == 0 { 9 } else { -4 };
            [r + ((x * 3 + y) % 11) as i32 - 5, g + block, b - (y % 3) as i32]
        };
        let picture = |pixel: &dyn Fn((u32, u32)) -> [i32; 3]| {
            let pixels = places().map(|place| pixel(place).map(|c| c.clamp(0, 255) as u8)).collect();
            DisplayPicture::new([width, height], pixels).expect("as many pixels as places")
        };
        [picture(&first), picture(&second)]
    }

    fn uniform(color: [u8; 3]) -> DisplayPicture {
        DisplayPicture::new([8, 8], vec![color; 64]).expect("as many pixels as places")
    }

    #[test]
    fn known_values() -> Result<(), CompareError> {
        // Computed by scikit-image 0.26 and by the evaluator of the authors of the metric (in single precision).
        let [reference, picture] = pair(48, 32);
        let found = DisplayComparison::new(&picture, &reference)?;
        assert!((found.psnr - 21.473_914_968_437_45).abs() < 1e-10);
        assert!((found.ssim - 0.975_140_740_386_430_6).abs() < 1e-10);
        assert!((found.ciede2000_mean - 3.150_204_083_802_238).abs() < 2e-3);
        assert!((found.ciede2000_p95 - 6.074_743_676_806_136).abs() < 2e-3);
        assert!((found.flip_mean - 0.137_379_27).abs() < 1e-5);
        for (size, expected) in [([5, 3], 0.855_449_8), ([1, 1], 0.967_019_1)] {
            let [reference, picture] = pair(size[0], size[1]);
            let found = DisplayComparison::new(&picture, &reference)?;
            assert!((found.flip_mean - expected).abs() < 1e-5, "{size:?}: {found:?}");
            assert!(found.ssim < 1.0 && found.ssim >= -1.0);
        }
        Ok(())
    }

    #[test]
    fn extremes_of_the_scale() -> Result<(), CompareError> {
        let (black, white) = (uniform([0; 3]), uniform([255; 3]));
        let equal = DisplayComparison::new(&black, &black)?;
        assert_eq!((equal.psnr, equal.ssim, equal.ciede2000_mean, equal.flip_mean), (f64::INFINITY, 1.0, 0.0, 0.0));
        let opposite = DisplayComparison::new(&black, &white)?;
        assert!(opposite.psnr == 0.0 && opposite.ssim < 1e-3);
        assert!((opposite.ciede2000_p95 - 100.0).abs() < 1e-9);
        assert!((opposite.flip_mean - 0.967_388_2).abs() < 1e-5);
        let farthest = DisplayComparison::new(&uniform([0, 255, 0]), &uniform([0, 0, 255]))?;
        assert!((farthest.flip_mean - 1.0).abs() < 1e-9);
        Ok(())
    }

    #[test]
    fn linear_pixels_are_shown_over_the_background() -> Result<(), CompareError> {
        let pixels = [[0.0; 4], [0.25, 0.0, 0.0, 0.5], [2.0, -1.0, 1.0, 1.0]];
        let shown = DisplayPicture::of([3, 1], &pixels, [1.0, 1.0, 0.0])?;
        assert_eq!(shown.pixels(), [[255, 255, 0], [srgb_encode(0.75), srgb_encode(0.5), 0], [255, 0, 255]]);
        assert_eq!(DisplayPicture::of::<[f32; 4]>([0, 3], &[], [0.0; 3]), Err(CompareError::Empty));
        assert!(DisplayPicture::of([2, 1], &pixels, [0.0; 3]).is_err());
        let other = DisplayPicture::of([1, 3], &pixels, [0.0; 3])?;
        assert!(matches!(DisplayComparison::new(&shown, &other), Err(CompareError::DifferentShapes { .. })));
        Ok(())
    }
}
