//! The continuous field that a volume stands for.

use crate::spline;
use glam::{DVec3, UVec3};
use rayloom_volume::{Gaps, ValueRange, Volume};

/// How the field between voxel centres is reconstructed from the voxels.
///
/// Beyond the outermost voxel centres, in the outer half voxel, the field is constant along the axis, as with a texture that
/// clamps to its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sampling {
    /// The value of the closest voxel.
    Nearest,
    /// Linear along each axis: what texture hardware does.
    #[default]
    Trilinear,
    /// Cubic Catmull-Rom spline along each axis: interpolates, may overshoot. Taps beyond the edge repeat the edge voxel.
    CatmullRom,
    /// Cubic B-spline through the voxel values (coefficients from the inverse filter, mirrored at the edge).
    BSplinePrefiltered,
}

/// One channel of a volume as a function of position, in data units and float64.
#[derive(Debug, Clone)]
pub struct Field {
    dims: UVec3,
    samples: Vec<f64>,
    sampling: Sampling,
    range: ValueRange,
    gaps: Option<Gaps>,
}

impl Field {
    /// The field of `channel` of `volume`. Voxels that are not finite take the substitutes that the volume hands out for
    /// rendering; where those are NaN, and in the cells of interpolation that touch them, the field is not to be seen.
    pub fn new(volume: &Volume, channel: u32, sampling: Sampling) -> Self {
        let dims = UVec3::from_array(volume.dims);
        let range = volume.ranges()[channel as usize];
        let mut samples = Vec::with_capacity(dims.as_usizevec3().element_product());
        for k in 0..dims.z {
            for j in 0..dims.y {
                for i in 0..dims.x {
                    samples.push(volume.finite_value([i, j, k], channel));
                }
            }
        }
        if sampling == Sampling::BSplinePrefiltered {
            spline::prefilter(&mut samples, dims);
        }
        Self { dims, samples, sampling, range, gaps: Gaps::of(volume, channel) }
    }

    /// Number of voxels along each axis.
    pub fn dims(&self) -> UVec3 {
        self.dims
    }

    /// Index coordinates of the last voxel centre on each axis; the first is zero.
    pub fn last_center(&self) -> DVec3 {
        self.dims.as_dvec3() - 1.0
    }

    /// How the field is reconstructed.
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// Smallest and largest finite voxel value of the channel, in data units.
    pub fn range(&self) -> ValueRange {
        self.range
    }

    /// Whether the field has no value at texture coordinates.
    pub fn in_gap(&self, texture: DVec3) -> bool {
        self.gaps.as_ref().is_some_and(|gaps| gaps.contains(self.texture_to_index(texture).to_array()))
    }

    /// The field at texture coordinates, in data units.
    pub fn at_texture(&self, texture: DVec3) -> f64 {
        self.at_index(self.texture_to_index(texture))
    }

    /// The field at index coordinates, in data units.
    pub fn at_index(&self, index: DVec3) -> f64 {
        let p = index.clamp(DVec3::ZERO, self.last_center());
        match self.sampling {
            Sampling::Nearest => self.sample((p + 0.5).floor().as_ivec3().to_array(), clamp),
            Sampling::Trilinear => self.trilinear(p),
            Sampling::CatmullRom => self.weighted(p, catmull_rom, clamp),
            Sampling::BSplinePrefiltered => self.weighted(p, spline::weights, mirror),
        }
    }

    /// Index coordinates of texture coordinates.
    pub fn texture_to_index(&self, texture: DVec3) -> DVec3 {
        texture * self.dims.as_dvec3() - 0.5
    }

    /// Between the eight voxels around `p`, which lies within the voxel centres.
    fn trilinear(&self, p: DVec3) -> f64 {
        // Positions are not negative: truncation is the floor, and an instruction where the floor is a call.
        let [i, j, k] = p.to_array().map(|x| x as usize);
        let t = p - DVec3::new(i as f64, j as f64, k as f64);
        let [nx, ny, nz] = self.dims.to_array().map(|n| n as usize);
        // At the last voxel centre there is no next voxel, and it has no weight.
        let [x, y, z] = [usize::from(i + 1 < nx), nx * usize::from(j + 1 < ny), nx * ny * usize::from(k + 1 < nz)];
        let first = (k * ny + j) * nx + i;
        let along_x = |at: usize| self.samples[at] * (1.0 - t.x) + self.samples[at + x] * t.x;
        let along_y = |at: usize| along_x(at) * (1.0 - t.y) + along_x(at + y) * t.y;
        along_y(first) * (1.0 - t.z) + along_y(first + z) * t.z
    }

    /// Sum over the 4×4×4 neighbourhood of `p` under separable weights; voxels of no weight are not read.
    fn weighted(&self, p: DVec3, weights: fn(f64) -> [f64; 4], wrap: Wrap) -> f64 {
        let base = p.floor();
        let [wx, wy, wz] = (p - base).to_array().map(weights);
        let [x, y, z] = base.as_ivec3().to_array();
        let taps = |w: [f64; 4], first: i32| (first - 1..).zip(w).filter(|&(_, w)| w != 0.0);
        let mut sum = 0.0;
        for (k, wk) in taps(wz, z) {
            for (j, wj) in taps(wy, y) {
                let row: f64 = taps(wx, x).map(|(i, wi)| wi * self.sample([i, j, k], wrap)).sum();
                sum += wk * wj * row;
            }
        }
        sum
    }

    /// What reconstruction weights at a voxel, one or two of them beyond the edge at most: its value, or its coefficient of
    /// [`Sampling::BSplinePrefiltered`].
    pub(crate) fn tap(&self, index: [i32; 3]) -> f64 {
        let wrap = if self.sampling == Sampling::BSplinePrefiltered { mirror } else { clamp };
        self.sample(index, wrap)
    }

    fn sample(&self, index: [i32; 3], wrap: Wrap) -> f64 {
        let dims = self.dims.to_array();
        let [i, j, k] = [0, 1, 2].map(|axis| wrap(index[axis], dims[axis]));
        self.samples[(k * dims[1] as usize + j) * dims[0] as usize + i]
    }
}

/// Maps an index, at most a voxel or two out of range, to one of `count` voxels.
type Wrap = fn(i32, u32) -> usize;

fn clamp(index: i32, count: u32) -> usize {
    (index.max(0) as u32).min(count - 1) as usize
}

/// Reflection about the centres of the outermost voxels.
fn mirror(index: i32, count: u32) -> usize {
    if count == 1 {
        return 0;
    }
    let period = 2 * (count as i32 - 1);
    let folded = index.rem_euclid(period);
    folded.min(period - folded) as usize
}

/// Weights of the voxels at -1, 0, 1, 2 for the position `t` in 0..1.
pub(crate) fn catmull_rom(t: f64) -> [f64; 4] {
    [
        0.5 * t * (t * (2.0 - t) - 1.0),
        0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
        0.5 * t * (t * (4.0 - 3.0 * t) + 1.0),
        0.5 * t * t * (t - 1.0),
    ]
}
