//! Separable filters.

use rayon::prelude::*;

/// One number for every pixel, row by row.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    pub(super) size: [usize; 2],
    pub(super) values: Vec<f64>,
}

/// An odd number of weights; the middle one belongs to the pixel itself.
pub(super) type Kernel = Vec<f64>;

/// A kernel of the radius with these weights, not normalised.
pub(super) fn kernel(radius: usize, weight: impl Fn(f64) -> f64) -> Kernel {
    (0..=2 * radius).map(|i| weight(i as f64 - radius as f64)).collect()
}

/// `exp(-x² / 2σ²)`, summing to one.
pub(super) fn gaussian(radius: usize, sigma: f64) -> Kernel {
    normalised(kernel(radius, |x| (-0.5 * (x / sigma).powi(2)).exp()))
}

/// The kernel scaled to the sum one.
pub(super) fn normalised(mut kernel: Kernel) -> Kernel {
    let sum: f64 = kernel.iter().sum();
    kernel.iter_mut().for_each(|weight| *weight /= sum);
    kernel
}

impl Plane {
    /// What `f` makes of two planes of one size, pixel by pixel.
    pub(super) fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64 + Sync) -> Self {
        let values = self.values.par_iter().zip(&other.values).map(|(&a, &b)| f(a, b)).collect();
        Self { size: self.size, values }
    }

    /// Correlation with the kernel `across` along rows and `down` along columns. Pixels beyond the edge repeat the edge.
    pub(super) fn filtered(&self, across: &[f64], down: &[f64]) -> Self {
        let [width, height] = self.size;
        let row = |y: usize| &self.values[y * width..(y + 1) * width];
        let along = |y: usize| (0..width).map(move |x| weighted(across, x, width, |at| row(y)[at]));
        let rows: Vec<f64> = (0..height).into_par_iter().flat_map_iter(along).collect();
        let along = |y: usize| {
            let rows = &rows;
            (0..width).map(move |x| weighted(down, y, height, |at| rows[at * width + x]))
        };
        let values = (0..height).into_par_iter().flat_map_iter(along).collect();
        Self { size: self.size, values }
    }
}

/// Sum of the weights times the values around place `center` of `count`.
fn weighted(kernel: &[f64], center: usize, count: usize, value: impl Fn(usize) -> f64) -> f64 {
    let radius = kernel.len() / 2;
    let at = |i: usize| (center + i).saturating_sub(radius).min(count - 1);
    kernel.iter().enumerate().map(|(i, weight)| weight * value(at(i))).sum()
}
