//! Volumes made of formulas, each with its closed form for tests to compare with.

mod fields;
mod hydrogen;

use glam::{DAffine3, DVec3};
use rayon::prelude::*;

pub use fields::Field;

use crate::volume::element_count;
use crate::{Volume, VolumeError, Voxels};

/// Samples a field at the voxel centres of a grid: `f32`, one channel.
///
/// The field's domain `[-1, 1]^3` is the box of the volume, which is centred at the world's origin and `extent` world units
/// long along x, y, z: voxel `i` of `n` lies at `(2 i + 1) / n - 1` in the domain.
///
/// # Errors
/// When a dimension is zero, the grid is too large, or the extent is not finite and non-zero.
pub fn generate(field: &Field, dims: [u32; 3], extent: DVec3) -> Result<Volume, VolumeError> {
    let count = element_count(dims, 1)?;
    let mut voxels: Vec<f32> = Vec::new();
    voxels.try_reserve_exact(count).map_err(|_| VolumeError::TooLarge { dims, channels: 1 })?;
    voxels.resize(count, 0.0);
    let [nx, ny, _] = dims.map(|n| n as usize);
    voxels.par_chunks_mut(nx).enumerate().for_each(|(row, line)| {
        let (y, z) = (domain(row % ny, dims[1]), domain(row / ny, dims[2]));
        for (i, voxel) in line.iter_mut().enumerate() {
            *voxel = field.value(DVec3::new(domain(i, dims[0]), y, z)) as f32;
        }
    });
    let spacing = extent / DVec3::from_array(dims.map(f64::from));
    let first = 0.5 * (spacing - extent);
    let index_to_world = DAffine3::from_translation(first) * DAffine3::from_scale(spacing);
    Volume::new(field.id(), dims, 1, Voxels::F32(voxels), index_to_world)
}

/// Where voxel `i` of `n` lies in `-1 ..= 1`.
fn domain(i: usize, n: u32) -> f64 {
    (2 * i + 1) as f64 / f64::from(n) - 1.0
}
