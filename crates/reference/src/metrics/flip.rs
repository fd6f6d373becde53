//! The difference that shows when two pictures are flipped back and forth.

use super::color::{Lab, relative_xyz, rgb_of, srgb_decode};
use super::display::DisplayPicture;
use super::filter::{Kernel, Plane, gaussian, kernel, normalised};
use super::linear::CompareError;
use rayon::prelude::*;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Pixels per degree of visual angle on a display 0.7 m wide with 3840 pixels across, seen from 0.7 m: the viewer that the
/// authors of the metric assume.
pub const PIXELS_PER_DEGREE: f64 = 0.7 * 3840.0 / 0.7 * PI / 180.0;

/// Weights and widths of the one or two Gaussians that model contrast sensitivity, for the achromatic, the red-green and the
/// blue-yellow channel.
const SENSITIVITIES: [[(f64, f64); 2]; 3] =
    [[(1.0, 0.0047), (0.0, 1e-5)], [(1.0, 0.0053), (0.0, 1e-5)], [(34.1, 0.04), (13.5, 0.025)]];
const WIDEST: f64 = 0.04;
/// Exponent of the colour difference.
const COLOR_EXPONENT: f64 = 0.7;
/// Colour differences up to this share of the largest are spread over [`LIKELY_RANGE`] of the scale.
const LIKELY_SHARE: f64 = 0.4;
const LIKELY_RANGE: f64 = 0.95;
/// Width of the edges and points that are noticed, in degrees.
const FEATURE_WIDTH: f64 = 0.082;
/// Exponent of the difference of features.
const FEATURE_EXPONENT: f64 = 0.5;

/// ꟻLIP for displayed pictures (LDR-ꟻLIP), after Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A
/// difference evaluator for alternating images" (2020).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flip {
    /// Pixels per degree of visual angle: how closely the viewer looks. Positive; [`PIXELS_PER_DEGREE`] by default.
    pub pixels_per_degree: f64,
}

impl Default for Flip {
    fn default() -> Self {
        Self { pixels_per_degree: PIXELS_PER_DEGREE }
    }
}

impl Flip {
    /// The noticed difference of every pixel, 0 to 1, row by row. Its mean is the number that the authors recommend.
    ///
    /// # Errors
    /// The pictures differ in size.
    pub fn map(&self, picture: &DisplayPicture, reference: &DisplayPicture) -> Result<Vec<f64>, CompareError> {
        picture.check_like(reference)?;
        let colors = [picture, reference].map(|picture| self.seen_colors(picture));
        let features = [picture, reference].map(|picture| self.features(picture));
        let largest = hyab(hunt([0.0, 1.0, 0.0]), hunt([0.0, 0.0, 1.0])).powf(COLOR_EXPONENT);
        let pixel = |i: usize| {
            let color = spread(hyab(colors[0][i], colors[1][i]).powf(COLOR_EXPONENT), largest);
            let difference = |kind: usize| (features[0][kind].values[i] - features[1][kind].values[i]).abs();
            let feature = (FRAC_1_SQRT_2 * difference(0).max(difference(1))).powf(FEATURE_EXPONENT);
            color.powf(1.0 - feature)
        };
        Ok((0..colors[0].len()).into_par_iter().map(pixel).collect())
    }

    /// The colours that are left after the eye has blurred them, with the Hunt effect.
    fn seen_colors(&self, picture: &DisplayPicture) -> Vec<Lab> {
        let channels = [0, 1, 2].map(|channel| {
            let plane = picture.plane(|pixel| opponent(pixel.map(srgb_decode))[channel]);
            self.blurred(&plane, SENSITIVITIES[channel])
        });
        let color = |i: usize| {
            let [y, cx, cz] = [0, 1, 2].map(|channel| channels[channel].values[i]);
            let y = (y + 16.0) / 116.0;
            hunt(rgb_of([y + cx / 500.0, y, y - cz / 200.0]).map(|c| c.clamp(0.0, 1.0)))
        };
        (0..channels[0].values.len()).into_par_iter().map(color).collect()
    }

    /// A plane under the weighted sum of two Gaussians, of which each is separable.
    fn blurred(&self, plane: &Plane, gaussians: [(f64, f64); 2]) -> Plane {
        let ppd = self.pixels_per_degree;
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * ppd).ceil() as usize;
        let bell = |b: f64| kernel(radius, |x| (-(PI * x / ppd).powi(2) / b).exp());
        let share = |(a, b): (f64, f64)| a * PI / b * bell(b).iter().sum::<f64>().powi(2);
        let total: f64 = gaussians.into_iter().map(share).sum();
        let [first, second] = gaussians.map(|gaussian| {
            let weight = share(gaussian) / total;
            (weight > 0.0).then(|| (normalised(bell(gaussian.1)), weight))
        });
        let apply = |(kernel, _): &(Kernel, f64)| plane.filtered(kernel, kernel);
        match (first, second) {
            (Some(a), Some(b)) => apply(&a).zip(&apply(&b), |x, y| a.1 * x + b.1 * y),
            (a, b) => a.or(b).map_or(plane.clone(), |only| apply(&only)),
        }
    }

    /// How much of an edge and how much of a point every pixel is.
    fn features(&self, picture: &DisplayPicture) -> [Plane; 2] {
        let sigma = 0.5 * FEATURE_WIDTH * self.pixels_per_degree;
        let radius = (3.0 * sigma).ceil() as usize;
        let grey = picture.plane(|pixel| relative_xyz(pixel.map(srgb_decode))[1]);
        let smooth = gaussian(radius, sigma);
        let bell = |x: f64| (-0.5 * (x / sigma).powi(2)).exp();
        let edge = balanced(kernel(radius, |x| -x * bell(x)));
        let point = balanced(kernel(radius, |x| ((x / sigma).powi(2) - 1.0) * bell(x)));
        [edge, point]
            .map(|detector| grey.filtered(&detector, &smooth).zip(&grey.filtered(&smooth, &detector), f64::hypot))
    }
}

/// A kernel whose positive weights sum to one, and whose negative ones to minus one.
fn balanced(mut kernel: Kernel) -> Kernel {
    let positive: f64 = kernel.iter().filter(|&&weight| weight > 0.0).sum();
    let negative: f64 = kernel.iter().filter(|&&weight| weight < 0.0).sum();
    for weight in &mut kernel {
        *weight /= if *weight > 0.0 { positive } else { -negative };
    }
    kernel
}

/// The opponent colours Y Cx Cz of a linear sRGB colour.
fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// A linear sRGB colour in L*a*b*, in which dark colours are less colourful (the Hunt effect).
fn hunt(rgb: [f64; 3]) -> Lab {
    let Lab { lightness, a, b } = Lab::of_linear(rgb);
    let share = 0.01 * lightness;
    Lab { lightness, a: share * a, b: share * b }
}

/// City-block distance between lightness and colour, Euclidean within colour.
fn hyab(a: Lab, b: Lab) -> f64 {
    (a.lightness - b.lightness).abs() + (a.a - b.a).hypot(a.b - b.b)
}

/// Spreads a colour difference over 0 to 1, most of which the likely ones get.
fn spread(difference: f64, largest: f64) -> f64 {
    let likely = LIKELY_SHARE * largest;
    if difference < likely {
        LIKELY_RANGE / likely * difference
    } else {
        LIKELY_RANGE + (difference - likely) / (largest - likely) * (1.0 - LIKELY_RANGE)
    }
}
