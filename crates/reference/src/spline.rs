//! Interpolation by cubic B-splines.

use glam::UVec3;

/// Weights of the coefficients at -1, 0, 1, 2 for the position `t` in 0..1.
pub(crate) fn weights(t: f64) -> [f64; 4] {
    let u = 1.0 - t;
    [u * u * u / 6.0, (4.0 - 3.0 * t * t * (2.0 - t)) / 6.0, (4.0 - 3.0 * u * u * (2.0 - u)) / 6.0, t * t * t / 6.0]
}

/// Replaces samples (x fastest) by the coefficients of the B-spline through them, mirrored about the outermost samples.
pub(crate) fn prefilter(samples: &mut [f64], dims: UVec3) {
    let counts = dims.as_usizevec3().to_array();
    let mut stride = 1;
    for count in counts {
        let block = stride * count;
        for start in (0..samples.len()).step_by(block) {
            for offset in start..start + stride {
                solve_line(samples, offset, stride, count);
            }
        }
        stride = block;
    }
}

/// Solves `(c[i-1] + 4 c[i] + c[i+1]) / 6 = f[i]` along one line, `c[-1] = c[1]` at both ends, by Gaussian elimination.
///
/// The matrix is diagonally dominant, so no pivoting is needed and the error does not grow.
fn solve_line(samples: &mut [f64], start: usize, stride: usize, count: usize) {
    if count == 1 {
        return;
    }
    let at = |i: usize| start + i * stride;
    let mut upper = vec![0.0; count];
    upper[0] = 0.5;
    samples[at(0)] *= 1.5;
    for i in 1..count {
        let lower = if i == count - 1 { 2.0 } else { 1.0 };
        let pivot = 4.0 - lower * upper[i - 1];
        upper[i] = 1.0 / pivot;
        samples[at(i)] = (6.0 * samples[at(i)] - lower * samples[at(i - 1)]) / pivot;
    }
    for i in (0..count - 1).rev() {
        samples[at(i)] -= upper[i] * samples[at(i + 1)];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_reproduce_the_samples() {
        let f = [3.0, -1.0, 4.0, 1.0, -5.0, 9.0];
        for n in 1..=f.len() {
            let mut c = f[..n].to_vec();
            prefilter(&mut c, UVec3::new(1, n as u32, 1));
            for i in 0..n {
                let before = c[if i == 0 { 1.min(n - 1) } else { i - 1 }];
                let after = c[if i + 1 == n { n.saturating_sub(2) } else { i + 1 }];
                assert!(((before + 4.0 * c[i] + after) / 6.0 - f[i]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn weights_sum_to_one_and_keep_the_position() {
        for t in [0.0, 0.3, 1.0] {
            let w = weights(t);
            assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!((-w[0] + w[2] + 2.0 * w[3] - t).abs() < 1e-15);
        }
    }
}
