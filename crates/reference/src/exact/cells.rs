//! The field along a ray, cell by cell, as a polynomial in each.

use super::bernstein::Bernstein;
use crate::field::{Field, Sampling};
use crate::ray::Segment;
use crate::spline;
use glam::UVec3;

/// The cuts between cells, in voxels from the first voxel centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cuts {
    /// At voxel centres.
    Centers,
    /// At voxel centres and halfway between them.
    HalfVoxels,
}

/// A piece of a ray on which the field is one polynomial.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Where it begins: fraction of the way through the volume.
    pub(super) from: f64,
    /// Where it ends.
    pub(super) to: f64,
    /// The field, in data units, over the piece mapped to `0..1`.
    pub(super) values: Bernstein,
    /// Whether the field has no value here; `values` are substitutes.
    pub(super) is_gap: bool,
}

impl Cell {
    /// The fraction of the way through the volume at `u` of the cell.
    pub(super) fn fraction(&self, u: f64) -> f64 {
        self.from + (self.to - self.from) * u
    }
}

/// Cuts closer together, in shares of the way, are one: rounding decides which of them comes first, and what lies between them
/// would be a cell with the field of one side and the label of the other.
const ONE_CUT: f64 = 1e-14;

/// The cells of a ray from front to back. They cover it without gap or overlap.
pub(super) struct Cells<'a> {
    field: &'a Field,
    segment: Segment,
    axes: [Axis; 3],
    /// The walk through the voxels of another grid, at whose faces cells end, too.
    faces: Option<[Axis; 3]>,
    /// Where the next cell begins.
    from: f64,
}

/// The walk along one axis, in voxels from the first of the cuts.
#[derive(Debug, Clone, Copy)]
struct Axis {
    start: f64,
    speed: f64,
    /// Distance between cuts.
    pitch: f64,
    /// The cut below the current cell, counted in pitches.
    slab: i64,
}

/// Where a cell lies along one axis: from `offsets[0]` to `offsets[1]` voxels past voxel `base`.
#[derive(Debug, Clone, Copy)]
struct Span {
    base: i32,
    offsets: [f64; 2],
}

impl<'a> Cells<'a> {
    pub(super) fn new(field: &'a Field, segment: &Segment, cuts: Cuts) -> Self {
        // The field of closest voxels jumps halfway between centres.
        let half = cuts == Cuts::HalfVoxels || field.sampling() == Sampling::Nearest;
        let pitch = if half { 0.5 } else { 1.0 };
        let (entry, exit) = (field.texture_to_index(segment.entry), field.texture_to_index(segment.exit));
        let axes = [0, 1, 2].map(|axis| Axis::new(entry[axis], (exit - entry)[axis], pitch));
        Self { field, segment: *segment, axes, faces: None, from: 0.0 }
    }

    /// Cells that end at the faces between `dims` voxels as well, if there are any.
    pub(super) fn cut_at_faces(mut self, dims: Option<UVec3>) -> Self {
        self.faces = dims.map(|dims| {
            let [entry, exit] = [self.segment.entry, self.segment.exit].map(|end| end * dims.as_dvec3());
            [0, 1, 2].map(|axis| Axis::new(entry[axis], (exit - entry)[axis], 1.0))
        });
        self
    }

    /// The walks along all axes of all grids.
    fn walks(&mut self) -> impl Iterator<Item = &mut Axis> {
        self.axes.iter_mut().chain(self.faces.iter_mut().flatten())
    }

    /// The end of the cell that begins at `from`: the next cut, or the last of those that are one with it. Passes it.
    fn pass_cut(&mut self) -> f64 {
        let next = self.walks().map(|axis| axis.next_cut()).fold(1.0, f64::min) + ONE_CUT;
        let end = if next >= 1.0 { 1.0 } else { f64::NEG_INFINITY };
        let to = self.walks().map(|axis| axis.next_cut()).filter(|&cut| cut <= next).fold(end, f64::max).min(1.0);
        self.walks().filter(|axis| axis.next_cut() <= to).for_each(Axis::advance);
        to
    }
}

impl Iterator for Cells<'_> {
    type Item = Cell;

    fn next(&mut self) -> Option<Cell> {
        while self.from < 1.0 {
            let (from, axes) = (self.from, self.axes);
            let to = self.pass_cut();
            if to <= from + ONE_CUT && to < 1.0 {
                continue;
            }
            self.from = to;
            let last = self.field.last_center();
            let spans = [0, 1, 2].map(|axis| axes[axis].span(from, to, last[axis]));
            let is_gap = self.field.in_gap(self.segment.at(0.5 * (from + to)));
            return Some(Cell { from, to, values: polynomial(self.field, spans), is_gap });
        }
        None
    }
}

impl Axis {
    fn new(start: f64, speed: f64, pitch: f64) -> Self {
        let place = start / pitch;
        let slab = place.floor();
        // A ray that begins on a cut and runs down begins below it.
        let below = speed < 0.0 && place == slab;
        Self { start, speed, pitch, slab: slab as i64 - i64::from(below) }
    }

    /// Fraction of the ray at which the current slab is left; infinite for a ray along its faces.
    fn next_cut(&self) -> f64 {
        let cut = self.slab + i64::from(self.speed > 0.0);
        if self.speed == 0.0 { f64::INFINITY } else { (cut as f64 * self.pitch - self.start) / self.speed }
    }

    fn advance(&mut self) {
        self.slab += if self.speed > 0.0 { 1 } else { -1 };
    }

    /// Where a cell lies among voxels of which the `last` has its centre at that index coordinate.
    fn span(&self, from: f64, to: f64, last: f64) -> Span {
        let low = self.slab as f64 * self.pitch;
        if low < 0.0 {
            return Span { base: 0, offsets: [0.0; 2] };
        }
        if low >= last {
            return Span { base: last as i32, offsets: [0.0; 2] };
        }
        let base = low.floor();
        let offset = |u: f64| (self.start + self.speed * u).clamp(low, low + self.pitch) - base;
        Span { base: base as i32, offsets: [offset(from), offset(to)] }
    }
}

/// The field along a straight line through a cell: the sum over the voxels around it of value times weights, each weight a
/// polynomial of the place along the line.
fn polynomial(field: &Field, spans: [Span; 3]) -> Bernstein {
    let [x, y, z] = spans.map(|span| kernel(field.sampling(), span));
    let mut first = None;
    let mut constant = true;
    let mut sum: Option<Bernstein> = None;
    for (k, wz) in z.iter() {
        let mut plane: Option<Bernstein> = None;
        for (j, wy) in y.iter() {
            let mut row: Option<Bernstein> = None;
            for (i, wx) in x.iter() {
                let value = field.tap([i, j, k]);
                constant &= *first.get_or_insert(value) == value;
                accumulate(&mut row, wx, value);
            }
            accumulate_product(&mut plane, wy, row);
        }
        accumulate_product(&mut sum, wz, plane);
    }
    // Weights sum to one only up to rounding, which must not move equal voxels off a knot or an isovalue.
    match (constant, first) {
        (true, Some(value)) => Bernstein::constant(value),
        _ => sum.unwrap_or(Bernstein::constant(0.0)),
    }
}

fn accumulate(sum: &mut Option<Bernstein>, weight: &Bernstein, value: f64) {
    sum.get_or_insert(Bernstein::constant(0.0)).add(weight, value);
}

fn accumulate_product(sum: &mut Option<Bernstein>, weight: &Bernstein, inner: Option<Bernstein>) {
    if let Some(inner) = inner {
        sum.get_or_insert(Bernstein::constant(0.0)).add(&weight.times(&inner), 1.0);
    }
}

/// The voxels that matter along one axis, with their weights.
struct Kernel {
    first: i32,
    count: usize,
    weights: [Bernstein; 4],
}

impl Kernel {
    fn iter(&self) -> impl Iterator<Item = (i32, &Bernstein)> {
        (self.first..).zip(&self.weights[..self.count])
    }
}

fn kernel(sampling: Sampling, Span { base, offsets: [from, to] }: Span) -> Kernel {
    let none = Bernstein::constant(0.0);
    let cubic = |weights: fn(f64) -> [f64; 4], blossoms: fn([f64; 3]) -> [f64; 4]| {
        let weights = if from == to {
            weights(from).map(Bernstein::constant)
        } else {
            let [a, b, c, d] = [[from; 3], [from, from, to], [from, to, to], [to; 3]].map(blossoms);
            [0, 1, 2, 3].map(|i| Bernstein::new(&[a[i], b[i], c[i], d[i]]))
        };
        Kernel { first: base - 1, count: 4, weights }
    };
    match sampling {
        Sampling::Nearest => {
            let above = 0.5 * (from + to) >= 0.5;
            Kernel { first: base + i32::from(above), count: 1, weights: [Bernstein::constant(1.0), none, none, none] }
        }
        Sampling::Trilinear if from == 0.0 && to == 0.0 => {
            Kernel { first: base, count: 1, weights: [Bernstein::constant(1.0), none, none, none] }
        }
        Sampling::Trilinear if from == to => Kernel {
            first: base,
            count: 2,
            weights: [Bernstein::constant(1.0 - to), Bernstein::constant(to), none, none],
        },
        Sampling::Trilinear => {
            let weights = [Bernstein::new(&[1.0 - from, 1.0 - to]), Bernstein::new(&[from, to]), none, none];
            Kernel { first: base, count: 2, weights }
        }
        Sampling::CatmullRom => cubic(crate::field::catmull_rom, catmull_rom_blossoms),
        Sampling::BSplinePrefiltered => cubic(spline::weights, spline_blossoms),
    }
}

/// The polar forms of the four weights of the Catmull-Rom spline.
fn catmull_rom_blossoms(at: [f64; 3]) -> [f64; 4] {
    blossoms([[0.0, -0.5, 1.0, -0.5], [1.0, 0.0, -2.5, 1.5], [0.0, 0.5, 2.0, -1.5], [0.0, 0.0, -0.5, 0.5]], at)
}

/// The polar forms of the four weights of the cubic B-spline.
fn spline_blossoms(at: [f64; 3]) -> [f64; 4] {
    let sixth = 1.0 / 6.0;
    let cubics =
        [[sixth, -0.5, 0.5, -sixth], [4.0 * sixth, 0.0, -1.0, 0.5], [sixth, 0.5, 0.5, -0.5], [0.0, 0.0, 0.0, sixth]];
    blossoms(cubics, at)
}

/// The polar form of each cubic `c0 + c1 t + c2 t² + c3 t³`: symmetric, affine in each of the three arguments, and the cubic
/// itself where they agree. Its values at the ends of an interval are the Bernstein coefficients there.
fn blossoms(cubics: [[f64; 4]; 4], [a, b, c]: [f64; 3]) -> [f64; 4] {
    let (linear, square, cube) = ((a + b + c) / 3.0, (a * b + b * c + c * a) / 3.0, a * b * c);
    cubics.map(|[c0, c1, c2, c3]| c0 + c1 * linear + c2 * square + c3 * cube)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use glam::{DAffine3, DVec3};
    use rayloom_volume::{Volume, Voxels};

    const SAMPLINGS: [Sampling; 4] =
        [Sampling::Nearest, Sampling::Trilinear, Sampling::CatmullRom, Sampling::BSplinePrefiltered];

    fn field(dims: [u32; 3], sampling: Sampling) -> Field {
        let count = dims.iter().product::<u32>();
        let values = (0..count).map(|n| f64::from(n.wrapping_mul(2_654_435_761) >> 12) / 1048576.0).collect();
        let volume = Volume::new("test", dims, 1, Voxels::F64(values), DAffine3::IDENTITY).expect("a volume");
        Field::new(&volume, 0, sampling)
    }

    /// Lines across, along faces, through voxel centres and edges, forwards and backwards.
    fn segments() -> Vec<Segment> {
        let ends = [
            (DVec3::new(0.0, 0.13, 0.71), DVec3::new(1.0, 0.88, 0.27)),
            (DVec3::ZERO, DVec3::ONE),
            (DVec3::new(0.3, 0.0, 0.41), DVec3::new(0.3, 1.0, 0.41)),
            (DVec3::new(0.0, 0.5, 0.1), DVec3::new(1.0, 0.5, 0.9)),
            (DVec3::new(0.125, 0.1, 0.0), DVec3::new(0.125, 0.1, 1.0)),
            (DVec3::new(0.0, 0.0, 0.2), DVec3::new(1.0, 0.0, 0.2)),
        ];
        let both = |(entry, exit)| [(entry, exit), (exit, entry)];
        ends.into_iter().flat_map(both).map(|(entry, exit)| Segment { entry, exit, from: 0.0, to: 1.0 }).collect()
    }

    #[test]
    fn cells_are_the_field() {
        for dims in [[4, 5, 6], [1, 1, 1], [1, 7, 2], [4, 1, 5]] {
            for sampling in SAMPLINGS {
                let field = field(dims, sampling);
                for segment in segments() {
                    for cuts in [Cuts::Centers, Cuts::HalfVoxels] {
                        let cells: Vec<_> = Cells::new(&field, &segment, cuts).collect();
                        assert_eq!((cells[0].from, cells[cells.len() - 1].to), (0.0, 1.0));
                        assert!(cells.windows(2).all(|pair| pair[0].to == pair[1].from));
                        for cell in cells.iter().filter(|cell| cell.to - cell.from > 1e-9) {
                            for u in [0.01, 0.4, 0.5, 0.83, 0.99] {
                                let expected = field.at_texture(segment.at(cell.fraction(u)));
                                let found = cell.values.at(u);
                                assert!((found - expected).abs() < 1e-12, "{dims:?} {sampling:?} {found} {expected}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn equal_voxels_are_constant_exactly() {
        let volume = Volume::new("flat", [3; 3], 1, Voxels::F64(vec![0.7; 27]), DAffine3::IDENTITY).expect("a volume");
        for sampling in [Sampling::Nearest, Sampling::Trilinear, Sampling::CatmullRom] {
            let field = Field::new(&volume, 0, sampling);
            for segment in segments() {
                let mut cells = Cells::new(&field, &segment, Cuts::Centers);
                assert!(cells.all(|cell| cell.values == Bernstein::constant(0.7)));
            }
        }
    }
}
