//! Gradients at the voxels.

use glam::DVec3;
use rayon::prelude::*;

use crate::{Volume, VolumeError, VolumeRole, Voxels};

/// How a gradient is estimated from the voxels around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `(f(i + 1) - f(i - 1)) / 2` along every axis.
    CentralDifferences,
    /// Central differences, smoothed by `(1, 2, 1) / 4` along both other axes: less noise, less detail.
    Sobel,
}

/// The gradients of one channel, in data units per voxel index step, and its values: four `f32` channels
/// ([`VolumeRole::GradientAndValue`]) on the same grid.
///
/// Differences at the borders are one-sided, so a linear field has the same gradient everywhere, border voxels included;
/// along an axis with one voxel the gradient is zero. Voxels that are not finite count as in [`Volume::finite_value`].
///
/// # Errors
/// When the result does not fit into memory.
///
/// # Panics
/// When there is no such channel.
pub fn gradient_volume(volume: &Volume, channel: u32, operator: Operator) -> Result<Volume, VolumeError> {
    let count = crate::volume::element_count(volume.dims, 4)?;
    let mut voxels: Vec<f32> = Vec::new();
    voxels.try_reserve_exact(count).map_err(|_| VolumeError::TooLarge { dims: volume.dims, channels: 4 })?;
    voxels.resize(count, 0.0);
    let grid = Grid::new(volume, channel);
    let [nx, ny, _] = grid.dims;
    voxels.par_chunks_mut(4 * nx).enumerate().for_each(|(row, line)| {
        for (i, voxel) in line.chunks_exact_mut(4).enumerate() {
            let index = [i, row % ny, row / ny];
            let gradient = grid.gradient(index, operator);
            let parts = [gradient.x, gradient.y, gradient.z, grid.value(index)];
            voxel.iter_mut().zip(parts).for_each(|(to, from)| *to = from as f32);
        }
    });
    Volume::new(volume.name.clone(), volume.dims, 4, Voxels::F32(voxels), volume.index_to_world)?
        .with_role(VolumeRole::GradientAndValue)
}

/// The finite values of one channel, with differences between them.
pub(crate) struct Grid<'a> {
    volume: &'a Volume,
    channel: usize,
    pub dims: [usize; 3],
}

impl<'a> Grid<'a> {
    pub fn new(volume: &'a Volume, channel: u32) -> Self {
        // The range is needed for every voxel below; a missing channel is noticed here.
        assert!((channel as usize) < volume.ranges().len(), "there is no channel {channel}");
        Self { volume, channel: channel as usize, dims: volume.dims.map(|n| n as usize) }
    }

    #[inline]
    pub fn value(&self, [i, j, k]: [usize; 3]) -> f64 {
        let position = ((k * self.dims[1] + j) * self.dims[0] + i) * self.volume.channels as usize + self.channel;
        let value = self.volume.rescaled(self.volume.voxels.stored(position));
        if value.is_finite() { value } else { self.volume.ranges()[self.channel].finite_value(value) }
    }

    /// The gradient in data units per voxel index step.
    pub fn gradient(&self, index: [usize; 3], operator: Operator) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|axis| match operator {
            Operator::CentralDifferences => self.difference(index, axis),
            Operator::Sobel => self.smoothed_difference(index, axis),
        }))
    }

    /// The difference between the neighbours along an axis, one-sided at the border.
    #[inline]
    fn difference(&self, index: [usize; 3], axis: usize) -> f64 {
        let (mut before, mut behind) = (index, index);
        before[axis] = index[axis].saturating_sub(1);
        behind[axis] = (index[axis] + 1).min(self.dims[axis] - 1);
        match behind[axis] - before[axis] {
            0 => 0.0,
            // Halved before they are subtracted, so that the ends of the range of f64 do not overflow.
            2 => 0.5 * self.value(behind) - 0.5 * self.value(before),
            _ => self.value(behind) - self.value(before),
        }
    }

    /// Mean of the differences around, weighted 1, 2, 1 along both other axes; neighbours beyond the border are left out
    /// together with their mirror images, so that the mean stays where the voxel is.
    fn smoothed_difference(&self, index: [usize; 3], axis: usize) -> f64 {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let reach = |axis: usize| usize::from(index[axis] > 0 && index[axis] + 1 < self.dims[axis]);
        let (reach_u, reach_v) = (reach(u), reach(v));
        let weight = |offset: usize, reach: usize| if reach == 0 || offset == 1 { 2.0 } else { 1.0 };
        let (mut sum, mut weights) = (0.0, 0.0);
        for a in 1 - reach_u..=1 + reach_u {
            for b in 1 - reach_v..=1 + reach_v {
                let mut at = index;
                at[u] = index[u] + a - 1;
                at[v] = index[v] + b - 1;
                let share = weight(a, reach_u) * weight(b, reach_v);
                sum += share * self.difference(at, axis);
                weights += share;
            }
        }
        sum / weights
    }
}
