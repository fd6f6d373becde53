//! Tables of transfer functions that keep steep parts: as many cells as steep ramps need, and cut where the function jumps.

use super::{Knot, Medium, TransferFunction};
use crate::ValueRange;

/// A step counts as met this share of the value range below its place. A voxel whose value is that of the step lies above the
/// step, and must do so after it was normalised in `f32`, too.
const SLACK: f64 = 1.0 / (1 << 21) as f64;

/// The opacity of a reference length that a table may be off by between two entries: a fortieth of a code of 8 bits.
const TABLE_ERROR: f64 = 1e-4;

/// A table whose cells (from one entry to the next) are cut into three pieces: at breaks of the function, which are jumps and
/// kinks, and evenly where there are fewer than two.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitTable {
    /// Entries a row: the cells and one more.
    pub width: usize,
    /// [`SplitTable::ROWS`] rows. Row `2 p` is the medium at the start of piece `p` of the cell that begins at the entry, row
    /// `2 p + 1` that at its end, so that row 0 is an ordinary table. The first two numbers of the last row are the two cuts,
    /// counted in entries from the first of the table.
    pub entries: Vec<[f32; 4]>,
}

impl SplitTable {
    /// Starts and ends of the pieces, and the cuts.
    pub const ROWS: usize = 2 * PIECES + 1;
}

/// Pieces of a cell.
const PIECES: usize = 3;

/// A place where the function jumps or bends.
#[derive(Clone, Copy)]
struct Break {
    /// Counted in entries from the first of the table.
    x: f64,
    left: Medium,
    right: Medium,
}

impl TransferFunction {
    /// Whether the function jumps, rises or falls within less than a cell of a table of `n` entries over `range`, or so steeply
    /// that a table of `finest` times as many cells would be off by more than a ten-thousandth.
    pub fn has_steps(&self, range: ValueRange, n: usize, finest: usize) -> bool {
        // A hundredth of a cell less, because knots on the entries themselves are no steps, whichever way they were rounded.
        let cell = 0.99 * range.width() / (n.max(2) - 1) as f64;
        let narrow = self
            .knots
            .windows(2)
            .any(|pair| pair[1].at - pair[0].at < cell && pair[0].right_side() != pair[1].left_side());
        let jumps = self.knots.iter().any(|knot| knot.right.is_some());
        narrow || jumps || self.bends(range, finest * (n.max(2) - 1)) > TABLE_ERROR
    }

    /// The entries that a table over `range` needs: `n`, or those of twice, four times, up to `finest` times as many cells where
    /// straight lines between entries of steep ramps would be off by more than a ten-thousandth, or where steps crowd.
    pub fn table_entries(&self, range: ValueRange, n: usize, finest: usize) -> usize {
        let cells = n.max(2) - 1;
        let crowded = |cells: usize| {
            let breaks = self.breaks(range, cells);
            breaks.windows(3).any(|three| cell_of(&three[0], cells) == cell_of(&three[2], cells))
        };
        let pieces = if self.has_steps(range, n, finest) { PIECES } else { 1 };
        let mut times = 1;
        while 2 * times <= finest && (self.bends(range, times * cells * pieces) > TABLE_ERROR || crowded(times * cells))
        {
            times *= 2;
        }
        times * cells + 1
    }

    /// A bound of how far straight lines over the cells of a table are off in the opacity or colour of a reference length: on a
    /// ramp the extinction `-ln(1 - opacity)` bends, and its product with the colour does.
    fn bends(&self, range: ValueRange, cells: usize) -> f64 {
        let within = |pair: &&[Knot]| pair[0].at < range.max && pair[1].at > range.min && pair[0].at < pair[1].at;
        let ramps = self.knots.windows(2).filter(within);
        let bend = |pair: &[Knot]| {
            let (from, to) = (pair[0].right_side(), pair[1].left_side());
            let share = (1.0 / (cells as f64 * fraction_of(range, pair))).min(1.0);
            let opacity = (to.opacity - from.opacity).abs() * share;
            let color = (0..3).map(|c| (to.color[c] - from.color[c]).abs()).fold(0.0, f64::max) * share;
            let clear = (1.0 - from.opacity.max(to.opacity)).max(opacity);
            let bent = if opacity > 0.0 { opacity * opacity / (8.0 * clear) } else { 0.0 };
            bent + color * opacity / 4.0
        };
        ramps.map(bend).fold(0.0, f64::max)
    }

    /// A table of `n` entries over `range` that is exact at every step, in `f64` until it is stored. Where a cell has more than
    /// two breaks it runs straight from the first to the last.
    pub fn split_table(&self, range: ValueRange, n: usize) -> SplitTable {
        let cells = n.max(2) - 1;
        let breaks = self.breaks(range, cells);
        let mut entries = vec![[0.0; 4]; SplitTable::ROWS * (cells + 1)];
        let mut rest = &breaks[..];
        for i in 0..=cells {
            let (own, others) = rest.split_at(rest.partition_point(|it| cell_of(it, cells) <= i));
            rest = others;
            for (row, entry) in self.split_cell(range, cells, i, own).into_iter().enumerate() {
                entries[row * (cells + 1) + i] = entry;
            }
        }
        SplitTable { width: cells + 1, entries }
    }

    /// The column of the cell that begins at entry `i`. Behind the last entry nothing changes any more.
    fn split_cell(&self, range: ValueRange, cells: usize, i: usize, breaks: &[Break]) -> [[f32; 4]; SplitTable::ROWS] {
        let entry = |i: usize| self.medium(self.met(range, range.denormalise(i as f64 / cells as f64)));
        let (start, end) = (entry(i), entry((i + 1).min(cells)));
        let even = |x: f64| {
            let here = self.medium(self.met(range, range.denormalise(x / cells as f64)));
            Break { x, left: here, right: here }
        };
        let at = i as f64;
        let [first, second] = match breaks {
            [] => [even(at + 1.0 / 3.0), even(at + 2.0 / 3.0)],
            [one] if one.x < at + 0.5 => [*one, even(0.5 * (one.x + at + 1.0))],
            [one] => [even(0.5 * (at + one.x)), *one],
            [first, .., last] => [*first, *last],
        };
        let media = [start, first.left, first.right, second.left, second.right, end].map(|medium| medium.to_entry());
        let [a, b, c, d, e, f] = media;
        [a, b, c, d, e, f, [first.x as f32, second.x as f32, 0.0, 0.0]]
    }

    /// The breaks above the first entry of a table, up to the last, in their order.
    fn breaks(&self, range: ValueRange, cells: usize) -> Vec<Break> {
        let mut places: Vec<f64> = self.knots.iter().map(|knot| knot.at).collect();
        places.dedup();
        let x = |at: f64, slack: f64| (range.normalise(at) - slack) * cells as f64;
        let breaks = places.into_iter().filter(|at| (range.min..=range.max).contains(at)).filter_map(|at| {
            let (left, right) = (self.left_medium(at), self.medium(at));
            match left == right {
                // A kink just below a step is passed with the step.
                true => (self.met(range, at) == at).then(|| Break { x: x(at, 0.0), left, right }),
                false => Some(Break { x: x(at, SLACK), left, right }),
            }
        });
        breaks.filter(|it| it.x > 0.0).collect()
    }

    /// The medium just below a knot.
    fn left_medium(&self, at: f64) -> Medium {
        let first = self.knots.partition_point(|knot| knot.at < at);
        self.knots.get(first).map_or(Medium::default(), |knot| knot.left_side().medium())
    }

    /// The value that `value` counts as: the step just above it, if there is one.
    fn met(&self, range: ValueRange, value: f64) -> f64 {
        let above = self.knots.partition_point(|knot| knot.at <= value);
        let reached = |at: f64| range.normalise(at) - range.normalise(value) <= SLACK;
        let near = self.knots[above..].iter().take_while(|knot| reached(knot.at));
        let jumps = near.filter(|knot| self.left_medium(knot.at) != self.medium(knot.at));
        jumps.last().map_or(value, |knot| knot.at)
    }
}

/// Width of a ramp as a share of the range.
fn fraction_of(range: ValueRange, pair: &[Knot]) -> f64 {
    range.normalise(pair[1].at) - range.normalise(pair[0].at)
}

/// The cell that a break lies in.
fn cell_of(it: &Break, cells: usize) -> usize {
    (it.x as usize).min(cells - 1)
}
