//! Gradients at the voxels.

use rayon::prelude::*;

use crate::{Element, Volume, VolumeError, VolumeRole, Voxels, with_voxels};

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
/// along an axis with one voxel the gradient is zero. Voxels that are not finite count as in [`Volume::finite_value`]; the values
/// of the result are NaN where those of the volume are.
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
    let [nx, ny, _] = volume.dims.map(|n| n as usize);
    let may_be_nan = volume.non_finite() > 0;
    voxels.par_chunks_mut(4 * nx).enumerate().for_each_init(
        || GradientRows::new(volume, channel, operator),
        |rows, (row, line)| {
            rows.compute(row % ny, row / ny);
            let [x, y, z] = &rows.gradient;
            let parts = x.iter().zip(y).zip(z).zip(rows.values());
            for (voxel, (((x, y), z), value)) in line.chunks_exact_mut(4).zip(parts) {
                voxel.copy_from_slice(&[*x as f32, *y as f32, *z as f32, *value as f32]);
            }
            if may_be_nan {
                for (i, voxel) in line.chunks_exact_mut(4).enumerate() {
                    let stored = volume.voxels.stored((row * nx + i) * volume.channels as usize + channel as usize);
                    voxel[3] = if stored.is_nan() { f32::NAN } else { voxel[3] };
                }
            }
        },
    );
    Volume::new(volume.name.clone(), volume.dims, 4, Voxels::F32(voxels), volume.index_to_world)?
        .with_role(VolumeRole::GradientAndValue)
}

/// Computes gradients a row of voxels (along x) at a time, in `f64`.
pub(crate) struct GradientRows<'a> {
    volume: &'a Volume,
    channel: u32,
    operator: Operator,
    /// The row and those around it, `[y][z]`; the ones beyond the border are copies of those at the border.
    around: [[Vec<f64>; 3]; 3],
    /// The parts of the gradients along x, y and z, data units per voxel index step.
    pub gradient: [Vec<f64>; 3],
    scratch: Vec<f64>,
}

impl<'a> GradientRows<'a> {
    pub fn new(volume: &'a Volume, channel: u32, operator: Operator) -> Self {
        let row = || vec![0.0; volume.dims[0] as usize];
        let three = || std::array::from_fn(|_| row());
        let around = std::array::from_fn(|_| three());
        Self { volume, channel, operator, around, gradient: three(), scratch: row() }
    }

    /// The finite values of the row last computed.
    pub fn values(&self) -> &[f64] {
        &self.around[1][1]
    }

    /// Computes the gradients of the row at `y`, `z`.
    pub fn compute(&mut self, y: usize, z: usize) {
        let (across_y, across_z) = (Neighbours::of(y, self.volume.dims[1]), Neighbours::of(z, self.volume.dims[2]));
        for a in 0..3 {
            for b in 0..3 {
                // Central differences do not look around corners.
                if self.operator == Operator::Sobel || a == 1 || b == 1 {
                    load_row(self.volume, self.channel, across_y.at[a], across_z.at[b], &mut self.around[a][b]);
                }
            }
        }
        let (smooth_y, smooth_z) = match self.operator {
            Operator::CentralDifferences => (ITSELF, ITSELF),
            Operator::Sobel => (across_y.smoothing, across_z.smoothing),
        };
        self.sum(smooth_y, smooth_z, 0);
        differences(&self.scratch, &mut self.gradient[0]);
        self.sum(across_y.difference, smooth_z, 1);
        self.sum(smooth_y, across_z.difference, 2);
    }

    /// The sum of the rows around, weighted along y and z: for x into the scratch row, else smoothed into the gradient.
    fn sum(&mut self, weights_y: [f64; 3], weights_z: [f64; 3], axis: usize) {
        self.scratch.fill(0.0);
        for (rows, weight_y) in self.around.iter().zip(weights_y) {
            for (row, weight) in rows.iter().zip(weights_z.map(|weight_z| weight_y * weight_z)) {
                if weight != 0.0 {
                    self.scratch.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
                }
            }
        }
        match (axis, self.operator) {
            (0, _) => {}
            (_, Operator::CentralDifferences) => self.gradient[axis].copy_from_slice(&self.scratch),
            (_, Operator::Sobel) => smooth(&self.scratch, &mut self.gradient[axis]),
        }
    }
}

/// Weights that leave everything as it is.
const ITSELF: [f64; 3] = [0.0, 1.0, 0.0];

/// The neighbours along one axis, with the weights of the operators.
struct Neighbours {
    at: [usize; 3],
    difference: [f64; 3],
    smoothing: [f64; 3],
}

impl Neighbours {
    fn of(i: usize, n: u32) -> Self {
        let last = n as usize - 1;
        let (difference, smoothing) = match (i > 0, i < last) {
            (true, true) => ([-0.5, 0.0, 0.5], [0.25, 0.5, 0.25]),
            // At the border one neighbour is missing; smoothing with the other alone would shift the voxel.
            (true, false) => ([-1.0, 1.0, 0.0], ITSELF),
            (false, true) => ([0.0, -1.0, 1.0], ITSELF),
            (false, false) => ([0.0; 3], ITSELF),
        };
        Self { at: [i.saturating_sub(1), i, (i + 1).min(last)], difference, smoothing }
    }
}

fn differences(row: &[f64], result: &mut [f64]) {
    let last = row.len() - 1;
    if last == 0 {
        result[0] = 0.0;
        return;
    }
    result[0] = row[1] - row[0];
    result[last] = row[last] - row[last - 1];
    result[1..last].iter_mut().zip(row.windows(3)).for_each(|(to, w)| *to = 0.5 * w[2] - 0.5 * w[0]);
}

fn smooth(row: &[f64], result: &mut [f64]) {
    result.copy_from_slice(row);
    if row.len() > 2 {
        let last = row.len() - 1;
        result[1..last].iter_mut().zip(row.windows(3)).for_each(|(to, w)| *to = 0.25 * (w[0] + w[2]) + 0.5 * w[1]);
    }
}

/// Loads the finite values of one channel of a row.
fn load_row(volume: &Volume, channel: u32, y: usize, z: usize, row: &mut [f64]) {
    let channels = volume.channels as usize;
    let first = (z * volume.dims[1] as usize + y) * row.len() * channels;
    with_voxels!(&volume.voxels, elements => {
        let stored = &elements[first..first + row.len() * channels];
        let rescale = |(to, from): (&mut f64, &_)| *to = volume.rescaled(Element::to_f64(*from));
        match channels {
            1 => row.iter_mut().zip(stored).for_each(rescale),
            _ => row.iter_mut().zip(stored[channel as usize..].iter().step_by(channels)).for_each(rescale),
        }
    });
    // Looked for afterwards, because a loop without branches is several times faster.
    if !row.iter().fold(true, |all, value| all & value.is_finite()) {
        let range = volume.ranges()[channel as usize];
        row.iter_mut().for_each(|value| *value = range.finite_value(*value));
    }
}
