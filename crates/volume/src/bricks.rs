//! Bricks of voxels with the range of values inside, for skipping what is transparent.

use rayon::prelude::*;

use crate::volume::{larger, smaller};
use crate::{Element, ValueRange, Volume, with_voxels};

/// The range of values in every brick of one channel.
///
/// Brick `b` is the part of the volume from `b * size` to `(b + 1) * size` voxels from its corner (texture coordinates
/// `b * size / dims` to `(b + 1) * size / dims`); the last ones may reach beyond the volume. Its range holds every value that
/// trilinear interpolation can give inside of the brick, or up to `apron` voxels outside of it.
#[derive(Clone, Debug, PartialEq)]
pub struct MinMaxBricks {
    /// Bricks along x, y, z.
    pub grid: [u32; 3],
    /// Voxels along the edge of a brick.
    pub size: u32,
    /// Voxels around each brick that its range covers as well.
    pub apron: u32,
    /// The smallest and the largest value of every brick, data units, x fastest. Voxels that are not finite count as in
    /// [`Volume::finite_value`].
    pub ranges: Vec<ValueRange>,
}

impl MinMaxBricks {
    /// Computes the ranges of all bricks with edges of `size` voxels, in parallel. An `apron` of 0 suits trilinear sampling,
    /// 1 tricubic sampling or gradients by central differences.
    ///
    /// # Panics
    /// When there is no such channel or `size` is zero.
    pub fn build(volume: &Volume, channel: u32, size: u32, apron: u32) -> Self {
        assert!(size > 0, "bricks have at least one voxel");
        let grid = volume.dims.map(|n| n.div_ceil(size));
        let stored = volume.stored_range(channel);
        let ranges = with_voxels!(&volume.voxels, elements => {
            let rows = Rows::new(elements, volume, channel, stored);
            (0..grid[1] * grid[2])
                .into_par_iter()
                .flat_map_iter(|at| rows.bricks(grid[0], at % grid[1], at / grid[1], size, apron))
                .map(|range| volume.rescaled_range(range))
                .collect()
        });
        Self { grid, size, apron, ranges }
    }

    /// The range of one brick, data units.
    ///
    /// # Panics
    /// When the brick lies outside of the grid.
    pub fn range(&self, [x, y, z]: [u32; 3]) -> ValueRange {
        let [nx, ny, _] = self.grid.map(|n| n as usize);
        self.ranges[(z as usize * ny + y as usize) * nx + x as usize]
    }

    /// One byte a brick, x fastest: 1 where `is_visible(min, max)` says that something between these values can be seen,
    /// else 0.
    pub fn occupancy(&self, is_visible: impl Fn(f64, f64) -> bool + Sync) -> Vec<u8> {
        self.ranges.par_iter().with_min_len(256).map(|range| u8::from(is_visible(range.min, range.max))).collect()
    }
}

/// One channel of a volume, row by row.
struct Rows<'a, E> {
    elements: &'a [E],
    dims: [usize; 3],
    channels: usize,
    channel: usize,
    finite: (E, E),
}

impl<'a, E: Element> Rows<'a, E> {
    fn new(elements: &'a [E], volume: &Volume, channel: u32, stored: ValueRange) -> Self {
        let dims = volume.dims.map(|n| n as usize);
        // A negative slope turns the range around: what is handed out for NaN is the smallest *value*.
        let finite = match (E::TYPE.is_float(), volume.slope < 0.0) {
            (false, _) => (E::LOWEST, E::HIGHEST),
            (true, false) => (E::from_f64(stored.min), E::from_f64(stored.max)),
            (true, true) => (E::from_f64(stored.max), E::from_f64(stored.min)),
        };
        Self { elements, dims, channels: volume.channels as usize, channel: channel as usize, finite }
    }

    /// The stored ranges of a row of bricks along x.
    fn bricks(&self, count: u32, y: u32, z: u32, size: u32, apron: u32) -> Vec<ValueRange> {
        let [nx, ny, nz] = self.dims;
        let mut low = vec![E::HIGHEST; nx];
        let mut high = vec![E::LOWEST; nx];
        // Whole rows are folded first, element by element, which vectorises; along x only once at the end.
        for k in touched(z, size, apron, nz) {
            for j in touched(y, size, apron, ny) {
                self.fold_row((k * ny + j) * nx, &mut low, &mut high);
            }
        }
        let fold = |b: u32| {
            let span = touched(b, size, apron, nx);
            let min = low[span.clone()].iter().copied().fold(E::HIGHEST, smaller);
            let max = high[span].iter().copied().fold(E::LOWEST, larger);
            ValueRange::new(min.to_f64(), max.to_f64())
        };
        (0..count).map(fold).collect()
    }

    fn fold_row(&self, first_voxel: usize, low: &mut [E], high: &mut [E]) {
        let row = &self.elements[first_voxel * self.channels..][..low.len() * self.channels];
        let fold = |(low, high): (&mut E, &mut E), element: E| {
            let element = self.finite(element);
            *low = smaller(*low, element);
            *high = larger(*high, element);
        };
        let extremes = low.iter_mut().zip(high.iter_mut());
        if self.channels == 1 {
            extremes.zip(row).for_each(|(extreme, &element)| fold(extreme, element));
        } else {
            let channel = row[self.channel..].iter().step_by(self.channels);
            extremes.zip(channel).for_each(|(extreme, &element)| fold(extreme, element));
        }
    }

    /// The element to render; the same for integers.
    #[inline]
    fn finite(&self, element: E) -> E {
        if element.finite() {
            return element;
        }
        let (smallest, largest) = self.finite;
        let turned = smallest > largest;
        match (element.nan(), (element > E::HIGHEST) != turned) {
            (false, true) => largest,
            _ => smallest,
        }
    }
}

/// The voxels along one axis that interpolation in brick `b` and `apron` voxels around can touch.
fn touched(b: u32, size: u32, apron: u32, voxels: usize) -> std::ops::Range<usize> {
    let (b, size, reach) = (b as usize, size as usize, apron as usize + 1);
    let start = (b * size).saturating_sub(reach);
    start..((b + 1) * size).saturating_add(reach).min(voxels)
}
