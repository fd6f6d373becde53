//! Where a volume has no values: NaN voxels, and what interpolation between them and others touches.

use rayon::prelude::*;

use crate::{Element, Volume, with_voxels};

/// The cells of one channel that touch a NaN voxel, and are not to be seen.
///
/// Cell (i, j, k) of the grid is the part of the volume between the centres of the voxels (i, j, k) and (i + 1, j + 1, k + 1). The
/// outer half voxels belong to the nearest cell, so that there are as many cells as voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaps {
    /// Cells along x, y, z: as many as voxels.
    pub dims: [u32; 3],
    /// 1 for cells that touch a NaN voxel, else 0; x fastest.
    pub cells: Vec<u8>,
}

impl Gaps {
    /// The gaps of a channel; `None` where every voxel has a value.
    ///
    /// # Panics
    /// When there is no such channel.
    pub fn of(volume: &Volume, channel: u32) -> Option<Self> {
        // Ranges know whether anything is not finite, and are needed anyway.
        let may_have = volume.voxels.element_type().is_float() && volume.non_finite() > 0;
        let mut cells: Vec<u8> = may_have.then(|| {
            let (channels, channel) = (volume.channels as usize, channel as usize);
            with_voxels!(&volume.voxels, elements => elements.par_chunks_exact(channels).map(|voxel| u8::from(voxel[channel].nan())).collect())
        })?;
        if !cells.contains(&1) {
            return None;
        }
        // A cell takes in what the next one along an axis touches: once an axis, that is all eight corners.
        let [nx, ny, nz] = volume.dims.map(|n| n as usize);
        for (step, count) in [(1, nx), (nx, ny), (nx * ny, nz)] {
            for at in 0..cells.len().saturating_sub(step) {
                if at / step % count + 1 < count {
                    cells[at] |= cells[at + step];
                }
            }
        }
        Some(Self { dims: volume.dims, cells })
    }

    /// Whether index coordinates lie in a cell that touches a NaN voxel.
    pub fn contains(&self, index: [f64; 3]) -> bool {
        let [nx, ny, _] = self.dims.map(|n| n as usize);
        // Casts saturate: what lies before the first centre belongs to the first cell.
        let [i, j, k] = std::array::from_fn(|axis| (index[axis] as usize).min(self.dims[axis] as usize - 1));
        self.cells[(k * ny + j) * nx + i] != 0
    }
}
