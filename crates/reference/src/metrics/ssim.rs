//! Structural similarity.

use super::display::DisplayPicture;
use super::filter::{Plane, gaussian};
use super::linear::CompareError;

const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
/// Constants that keep flat windows stable: (0.01 · 255)² and (0.03 · 255)².
const C1: f64 = 6.5025;
const C2: f64 = 58.5225;

/// The mean structural similarity of two pictures: 1 for equal ones, -1 at worst.
///
/// After Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to structural similarity" (2004),
/// with the window and the constants of that paper: Gaussian, 11 × 11, σ = 1.5, on the luma (ITU-R BT.601) of the 8-bit picture.
/// Only windows that lie within the picture count; a picture less than 11 pixels wide or high repeats its edge on that axis.
///
/// # Errors
/// The pictures differ in size.
pub fn ssim(picture: &DisplayPicture, reference: &DisplayPicture) -> Result<f64, CompareError> {
    picture.check_like(reference)?;
    let (a, b) = (luma(picture), luma(reference));
    let window = gaussian(RADIUS, SIGMA);
    let mean = |plane: &Plane| plane.filtered(&window, &window);
    let product = |a: &Plane, b: &Plane| mean(&a.zip(b, |a, b| a * b));
    let (mean_a, mean_b) = (mean(&a), mean(&b));
    let (aa, bb, ab) = (product(&a, &a), product(&b, &b), product(&a, &b));
    let similarity = |i: usize| {
        let (ma, mb) = (mean_a.values[i], mean_b.values[i]);
        let (variance_a, variance_b) = (aa.values[i] - ma * ma, bb.values[i] - mb * mb);
        let covariance = ab.values[i] - ma * mb;
        (2.0 * ma * mb + C1) * (2.0 * covariance + C2) / ((ma * ma + mb * mb + C1) * (variance_a + variance_b + C2))
    };
    let [width, height] = a.size;
    let (columns, rows) = (whole_windows(width), whole_windows(height));
    let count = columns.len() * rows.len();
    let sum: f64 = rows.flat_map(|y| columns.clone().map(move |x| y * width + x)).map(similarity).sum();
    Ok(sum / count as f64)
}

/// The places whose window lies within an axis of `count` pixels; all if there is none.
fn whole_windows(count: usize) -> std::ops::Range<usize> {
    if count > 2 * RADIUS { RADIUS..count - RADIUS } else { 0..count }
}

fn luma(picture: &DisplayPicture) -> Plane {
    picture.plane(|[r, g, b]| 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b))
}
