//! Coefficients of the cubic B-spline that passes through the voxels.

use rayon::prelude::*;

use crate::Volume;

/// The pole of the recursive filter, `sqrt(3) - 2`.
const POLE: f64 = -0.267_949_192_431_122_7;

/// The filter's gain, `(1 - pole) (1 - 1 / pole)`.
const GAIN: f64 = 6.0;

/// Voxels after which the start of a line counts for less than `f64` can tell.
const HORIZON: usize = 30;

/// Lines that are filtered together, side by side in memory.
const BUNDLE: usize = 32;

/// The coefficients of the cubic B-spline that interpolates one channel, x fastest, for the channel *normalised* to its range
/// (the spline of the values is `min + (max - min)` times the spline of these).
///
/// The spline passes through every voxel when the coefficients are mirrored at the border voxels: index -1 is index 1, and
/// index n is index n - 2. Coefficients overshoot 0 ..= 1 at edges. Recursive filter with one pole (Unser, Aldroubi, Eden 1993),
/// in `f64` along each axis.
///
/// # Panics
/// When there is no such channel.
pub fn bspline_coefficients(volume: &Volume, channel: u32) -> Vec<f32> {
    let mut coefficients = volume.normalised(channel);
    let [nx, ny, nz] = volume.dims.map(|n| n as usize);
    coefficients.par_chunks_mut(nx).for_each(|line| filter_strided(line, 1, nx));
    coefficients.par_chunks_mut(nx * ny).for_each(|layer| filter_strided(layer, nx, ny));
    filter_along_z(&mut coefficients, nx * ny, nz);
    coefficients
}

/// Filters all `stride` lines of `n` elements that lie interleaved in `block`, a bundle at a time.
fn filter_strided(block: &mut [f32], stride: usize, n: usize) {
    let mut lines = vec![[0.0; BUNDLE]; n];
    for first in (0..stride).step_by(BUNDLE) {
        let width = BUNDLE.min(stride - first);
        for (i, line) in lines.iter_mut().enumerate() {
            let from = &block[i * stride + first..][..width];
            line.iter_mut().zip(from).for_each(|(to, &from)| *to = f64::from(from));
        }
        filter(&mut lines);
        for (i, line) in lines.iter().enumerate() {
            let to = &mut block[i * stride + first..][..width];
            to.iter_mut().zip(line).for_each(|(to, &from)| *to = from as f32);
        }
    }
}

/// Filters along the slowest axis: bundles are gathered and filtered in parallel, a slab of columns at a time.
fn filter_along_z(volume: &mut [f32], layer: usize, n: usize) {
    const COLUMNS: usize = 1 << 12;
    for first in (0..layer).step_by(COLUMNS) {
        let width = COLUMNS.min(layer - first);
        let mut slab = vec![0.0; width * n];
        let source = &*volume;
        slab.par_chunks_mut(BUNDLE * n).enumerate().for_each(|(bundle, block)| {
            let (start, width) = (first + bundle * BUNDLE, block.len() / n);
            for (k, row) in block.chunks_mut(width).enumerate() {
                row.copy_from_slice(&source[k * layer + start..][..width]);
            }
            filter_strided(block, width, n);
        });
        volume.par_chunks_mut(layer).enumerate().for_each(|(k, plane)| {
            for (bundle, block) in slab.chunks(BUNDLE * n).enumerate() {
                let width = block.len() / n;
                plane[first + bundle * BUNDLE..][..width].copy_from_slice(&block[k * width..][..width]);
            }
        });
    }
}

/// Filters a bundle of lines in place: a causal and an anticausal pass. A line of one element is its own coefficient.
fn filter(lines: &mut [[f64; BUNDLE]]) {
    let n = lines.len();
    if n < 2 {
        return;
    }
    lines[0] = causal_start(lines);
    for i in 1..n {
        let before = lines[i - 1];
        (0..BUNDLE).for_each(|b| lines[i][b] = GAIN * lines[i][b] + POLE * before[b]);
    }
    let (last, before) = (lines[n - 1], lines[n - 2]);
    lines[n - 1] = std::array::from_fn(|b| POLE / (POLE * POLE - 1.0) * (POLE * before[b] + last[b]));
    for i in (0..n - 1).rev() {
        let behind = lines[i + 1];
        (0..BUNDLE).for_each(|b| lines[i][b] = POLE * (behind[b] - lines[i][b]));
    }
}

/// The first causal coefficient: the geometric sum over the line mirrored at both ends, with period `2 n - 2`.
fn causal_start(lines: &[[f64; BUNDLE]]) -> [f64; BUNDLE] {
    let n = lines.len();
    let period = 2 * n - 2;
    // Short lines come around before the sum has converged; a whole period in closed form is exact.
    let (terms, scale) = match period < HORIZON {
        true => (period, 1.0 / (1.0 - POLE.powi(period as i32))),
        false => (HORIZON, 1.0),
    };
    let mut sum = [0.0; BUNDLE];
    let mut power = GAIN * scale;
    for k in 0..terms {
        let at = if k < n { k } else { period - k };
        (0..BUNDLE).for_each(|b| sum[b] += power * lines[at][b]);
        power *= POLE;
    }
    sum
}
