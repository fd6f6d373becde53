//! Pre-integrated classification: whole segments of a ray, looked up by the values at their two ends.
//!
//! Along a segment the value runs linearly from its front to its back. An entry of a table is the *effective medium* of such a
//! segment: the homogeneous medium with the same opacity and the same colour at the length the table was made for, so that
//! `alpha = 1 - exp(-extinction L)` and `C = emission / extinction * alpha`. Shorter segments use the same entry; opacity
//! stays exact (the mean extinction does not depend on the length), colour is exact where the segment is homogeneous.
//!
//! Means over the segment are sums over the cells between table entries. They are summed anew from every front, growing from
//! zero, because differences of prefix sums cancel where a thin medium follows an opaque one.

use rayon::prelude::*;

use super::one_dimensional::table_value;
use super::{Medium, TransferFunction};
use crate::{ValueRange, fraction};

/// Nodes and weights of the Gauss-Legendre rule with five points on `0 ..= 1`.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Self-attenuation is integrated over at least this many parts of a segment; second order in their number.
const MIN_PARTS: usize = 128;

impl TransferFunction {
    /// The mean emission and extinction over the values from `from` to `to` (data units, either order), exact up to the
    /// quadrature: the integral is split at the knots. Equal ends give the medium at that value.
    pub fn mean_medium(&self, from: f64, to: f64) -> Medium {
        let (low, high) = (from.min(to), from.max(to));
        if low == high {
            return self.medium(low);
        }
        let mut sum = Medium::default();
        let inner = self.knots.iter().map(|knot| knot.at).filter(|&at| low < at && at < high);
        let mut start = low;
        for end in inner.chain([high]) {
            let share = fraction(end, low, high) - fraction(start, low, high);
            if share > 0.0 {
                for (node, weight) in GAUSS {
                    accumulate(&mut sum, self.medium(start * (1.0 - node) + end * node), weight * share);
                }
            }
            start = end;
        }
        sum
    }

    /// The table of effective media without self-attenuation inside of a segment: `n` x `n` entries (mean of extinction
    /// times red, green, blue; mean extinction; per reference length) in rows. The row is the value at the segment's back
    /// (current sample), the column the value at its front (previous sample); values are laid out over `range` as in
    /// [`TransferFunction::table`]. Opacity is exact for a linear run of the value, colour to first order in the opacity of
    /// the segment; the table does not depend on the segment's length.
    ///
    /// Formula: `(K(back) - K(front)) / (back - front)` with the integral functions `K` of emission and extinction, and the
    /// medium itself on the diagonal (Engel, Kraus, Ertl 2001). Cost: `n^2`.
    pub fn preintegration_fast(&self, range: ValueRange, n: usize) -> Vec<[f32; 4]> {
        let (points, cells) = (self.points(range, n), self.cells(range, n));
        build(n, |front, column| {
            column[front] = points[front].to_entry();
            for step in [1, -1] {
                let mut sum = Medium::default();
                for (count, cell) in cells_from(front, step, n).enumerate() {
                    accumulate(&mut sum, cells[cell], 1.0);
                    column[back_of(front, step, count)] = scaled(sum, 1.0 / (count + 1) as f64).to_entry();
                }
            }
        })
    }

    /// The table of effective media with self-attenuation, for segments `segment_length` reference lengths long: laid out as
    /// in [`TransferFunction::preintegration_fast`], same opacity, but what lies in front inside of a segment hides what
    /// lies behind. A length that is not positive gives the table without self-attenuation.
    ///
    /// Cost: `n^3 / 3`, in parallel; a tenth of a second at n = 256.
    pub fn preintegration_full(&self, range: ValueRange, n: usize, segment_length: f64) -> Vec<[f32; 4]> {
        if !segment_length.is_finite() || segment_length <= 0.0 {
            return self.preintegration_fast(range, n);
        }
        let points = self.points(range, n);
        // Media of cells and of their halves, quarters, ...: short segments need finer parts than the table has.
        let finest = MIN_PARTS.ilog2();
        let levels: Vec<Vec<Medium>> =
            (0..=finest).map(|level| self.cells(range, (n.max(1) - 1) * (1 << level) + 1)).collect();
        build(n, |front, column| {
            for (back, entry) in column.iter_mut().enumerate() {
                let distance = back.abs_diff(front);
                *entry = match distance {
                    0 => points[front].to_entry(),
                    _ => {
                        let level = MIN_PARTS.div_ceil(distance).next_power_of_two().ilog2();
                        let parts = distance << level;
                        let low = front.min(back) << level;
                        let part =
                            |i: usize| levels[level as usize][if front < back { low + i } else { low + parts - 1 - i }];
                        effective((0..parts).map(part), segment_length / parts as f64, parts).to_entry()
                    }
                };
            }
        })
    }

    fn points(&self, range: ValueRange, n: usize) -> Vec<Medium> {
        (0..n).map(|i| self.medium(table_value(range, n, i))).collect()
    }

    /// The mean media of the `n - 1` cells between the entries of a table.
    fn cells(&self, range: ValueRange, n: usize) -> Vec<Medium> {
        let cell = |i| self.mean_medium(table_value(range, n, i), table_value(range, n, i + 1));
        (0..n.saturating_sub(1)).into_par_iter().map(cell).collect()
    }
}

/// The cells passed on the way up (`step` 1) or down (-1) from an entry.
fn cells_from(front: usize, step: i32, n: usize) -> impl Iterator<Item = usize> {
    let count = if step > 0 { n - 1 - front } else { front };
    (0..count).map(move |i| if step > 0 { front + i } else { front - 1 - i })
}

/// The entry reached after `count + 1` cells.
fn back_of(front: usize, step: i32, count: usize) -> usize {
    if step > 0 { front + count + 1 } else { front - count - 1 }
}

/// Computes the table column by column (one front each) in parallel and turns it so that a row is one back.
fn build(n: usize, column: impl Fn(usize, &mut [[f32; 4]]) + Sync) -> Vec<[f32; 4]> {
    let mut columns = vec![[0.0; 4]; n * n];
    columns.par_chunks_mut(n.max(1)).enumerate().for_each(|(front, entries)| column(front, entries));
    let mut table = vec![[0.0; 4]; n * n];
    table.par_chunks_mut(n.max(1)).enumerate().for_each(|(back, row)| {
        row.iter_mut().enumerate().for_each(|(front, entry)| *entry = columns[front * n + back]);
    });
    table
}

/// The effective medium of homogeneous parts of equal length, the first in front.
fn effective(parts: impl Iterator<Item = Medium>, part_length: f64, count: usize) -> Medium {
    let (mut sum, mut color) = (Medium::default(), [0.0; 3]);
    for part in parts.filter(|part| part.extinction > 0.0) {
        let reaching_eye = (-sum.extinction * part_length).exp();
        let weight = reaching_eye * -(-part.extinction * part_length).exp_m1() / part.extinction;
        (0..3).for_each(|c| color[c] += part.emission[c] * weight);
        accumulate(&mut sum, part, 1.0);
    }
    let mean = scaled(sum, 1.0 / count as f64);
    let opacity = -(-sum.extinction * part_length).exp_m1();
    if opacity <= 0.0 {
        return mean;
    }
    Medium { emission: color.map(|c| c / opacity * mean.extinction), extinction: mean.extinction }
}

fn accumulate(sum: &mut Medium, medium: Medium, weight: f64) {
    sum.extinction += medium.extinction * weight;
    (0..3).for_each(|c| sum.emission[c] += medium.emission[c] * weight);
}

fn scaled(medium: Medium, factor: f64) -> Medium {
    Medium { emission: medium.emission.map(|e| e * factor), extinction: medium.extinction * factor }
}
