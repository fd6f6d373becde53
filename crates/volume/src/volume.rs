//! The volume itself: voxels, what their numbers mean and where they lie in the world.

use std::sync::OnceLock;

use glam::{DAffine3, DMat3, DVec3};
use rayon::prelude::*;
use thiserror::Error;

use crate::{Element, ValueRange, Voxels, with_voxels};

/// What the channels of a volume hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeRole {
    /// Values: scalars, colours or vectors.
    Values,
    /// Four `f32` channels: the gradient in data units per voxel index step (x, y, z), then the value.
    GradientAndValue,
}

/// Why a volume cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum VolumeError {
    /// A dimension is zero.
    #[error("a volume needs at least one voxel along every axis, but its dimensions are {} x {} x {}", .0[0], .0[1], .0[2])]
    NoVoxels([u32; 3]),
    /// The product of the dimensions does not fit into memory.
    #[error("a volume of {} x {} x {} voxels with {channels} channel(s) is too large for this computer's address space", .dims[0], .dims[1], .dims[2])]
    TooLarge {
        /// Voxels along x, y, z.
        dims: [u32; 3],
        /// Channels of a voxel.
        channels: u32,
    },
    /// The number of channels is not 1, 2, 3 or 4.
    #[error("a volume has 1 to 4 channels, but {0} were given")]
    Channels(u32),
    /// The array of voxels has another length than the dimensions ask for.
    #[error("the dimensions ask for {expected} elements, but {found} were given")]
    Length {
        /// Voxels times channels.
        expected: usize,
        /// Elements given.
        found: usize,
    },
    /// The transformation from index to world is not finite or not invertible.
    #[error(
        "the index-to-world transformation cannot be inverted (columns {columns:?}, translation {translation:?}); its three axes must be finite and must not lie in one plane"
    )]
    Transform {
        /// The three axes.
        columns: [[f64; 3]; 3],
        /// The world position of the first voxel.
        translation: [f64; 3],
    },
    /// Slope or intercept make no sense.
    #[error("the slope must be finite and not zero and the intercept finite, but they are {slope} and {intercept}")]
    Rescale {
        /// The factor.
        slope: f64,
        /// The summand.
        intercept: f64,
    },
    /// The role does not fit the voxels.
    #[error("a volume of gradients and values has four f32 channels, but this one has {channels} of {element}")]
    Role {
        /// Channels of a voxel.
        channels: u32,
        /// The element type.
        element: crate::ElementType,
    },
}

/// A regular grid of voxels. Build another one to change it: ranges are computed once and kept.
#[derive(Clone, Debug)]
pub struct Volume {
    /// A short name for people; the file name without extension, for example.
    pub name: String,
    /// Voxels along x, y, z; each at least one.
    pub dims: [u32; 3],
    /// Channels of a voxel, 1 to 4.
    pub channels: u32,
    /// The stored elements, x fastest, channels interleaved.
    pub voxels: Voxels,
    /// Maps a voxel index (centres at integers) to world coordinates; finite and invertible, may be mirrored or sheared.
    pub index_to_world: DAffine3,
    /// Value = stored * slope + intercept. Finite, not zero.
    pub slope: f64,
    /// Value = stored * slope + intercept. Finite.
    pub intercept: f64,
    /// What the channels hold.
    pub role: VolumeRole,
    statistics: OnceLock<Statistics>,
}

#[derive(Clone, Debug)]
struct Statistics {
    ranges: Vec<ValueRange>,
    stored: Vec<ValueRange>,
    non_finite: u64,
}

impl Volume {
    /// A volume of values with slope 1 and intercept 0.
    ///
    /// # Errors
    /// When a dimension is zero, there are not 1 to 4 channels, the number of elements is not voxels times channels, or
    /// the transformation is not finite and invertible.
    pub fn new(
        name: impl Into<String>,
        dims: [u32; 3],
        channels: u32,
        voxels: Voxels,
        index_to_world: DAffine3,
    ) -> Result<Self, VolumeError> {
        let expected = element_count(dims, channels)?;
        if voxels.len() != expected {
            return Err(VolumeError::Length { expected, found: voxels.len() });
        }
        check_transform(&index_to_world)?;
        Ok(Self {
            name: name.into(),
            dims,
            channels,
            voxels,
            index_to_world,
            slope: 1.0,
            intercept: 0.0,
            role: VolumeRole::Values,
            statistics: OnceLock::new(),
        })
    }

    /// The same volume with other data units: value = stored * `slope` + `intercept`.
    ///
    /// # Errors
    /// When one of them is not finite or the slope is zero.
    pub fn with_rescale(mut self, slope: f64, intercept: f64) -> Result<Self, VolumeError> {
        if !slope.is_finite() || slope == 0.0 || !intercept.is_finite() {
            return Err(VolumeError::Rescale { slope, intercept });
        }
        self.slope = slope;
        self.intercept = intercept;
        self.statistics = OnceLock::new();
        Ok(self)
    }

    /// The same volume in another role.
    ///
    /// # Errors
    /// When [`VolumeRole::GradientAndValue`] is asked of a volume that has not four `f32` channels.
    pub fn with_role(mut self, role: VolumeRole) -> Result<Self, VolumeError> {
        let fits = self.channels == 4 && matches!(self.voxels, Voxels::F32(_));
        if role == VolumeRole::GradientAndValue && !fits {
            return Err(VolumeError::Role { channels: self.channels, element: self.voxels.element_type() });
        }
        self.role = role;
        Ok(self)
    }

    /// How many voxels there are.
    pub fn voxel_count(&self) -> usize {
        self.dims.iter().map(|&n| n as usize).product()
    }

    /// The flat position in [`Volume::voxels`] of a channel of a voxel.
    #[inline]
    pub fn position(&self, [i, j, k]: [u32; 3], channel: u32) -> usize {
        let [nx, ny, _] = self.dims.map(|n| n as usize);
        ((k as usize * ny + j as usize) * nx + i as usize) * self.channels as usize + channel as usize
    }

    /// The value of a voxel in data units, as stored: it may be NaN or infinite.
    ///
    /// # Panics
    /// When the index or the channel lies outside of the volume, like indexing a slice.
    #[inline]
    pub fn value(&self, index: [u32; 3], channel: u32) -> f64 {
        assert!(
            index.iter().zip(&self.dims).all(|(i, n)| i < n) && channel < self.channels,
            "voxel {index:?}, channel {channel} lies outside of a volume of {:?} with {} channel(s)",
            self.dims,
            self.channels
        );
        self.rescaled(self.voxels.stored(self.position(index, channel)))
    }

    /// The value of a voxel to render: as [`Volume::value`], but NaN becomes the minimum of the channel's range and an
    /// infinity the end of the range that it lies beyond.
    ///
    /// # Panics
    /// When the index or the channel lies outside of the volume, like indexing a slice.
    #[inline]
    pub fn finite_value(&self, index: [u32; 3], channel: u32) -> f64 {
        self.ranges()[channel as usize].finite_value(self.value(index, channel))
    }

    /// All values of one channel, x fastest, normalised to the channel's range (0 ..= 1) in `f64` and then rounded; NaN
    /// and infinities as in [`Volume::finite_value`].
    ///
    /// # Panics
    /// When there is no such channel.
    pub fn normalised(&self, channel: u32) -> Vec<f32> {
        let range = self.ranges()[channel as usize];
        let (channels, channel) = (self.channels as usize, channel as usize);
        let normalise = |stored: f64| range.normalise(range.finite_value(self.rescaled(stored))) as f32;
        with_voxels!(&self.voxels, elements => elements.par_chunks_exact(channels).map(|voxel| normalise(voxel[channel].to_f64())).collect())
    }

    /// The data value of a stored one: `stored * slope + intercept`.
    #[inline]
    pub fn rescaled(&self, stored: f64) -> f64 {
        stored * self.slope + self.intercept
    }

    /// The finite range of every channel in data units; `0 ..= 0` for a channel without a finite voxel. Computed at the
    /// first call, in parallel, and kept.
    pub fn ranges(&self) -> &[ValueRange] {
        &self.statistics().ranges
    }

    /// How many elements are NaN or infinite, over all channels.
    pub fn non_finite(&self) -> u64 {
        self.statistics().non_finite
    }

    /// The finite range of a channel as stored, before slope and intercept.
    ///
    /// # Panics
    /// When there is no such channel.
    pub fn stored_range(&self, channel: u32) -> ValueRange {
        self.statistics().stored[channel as usize]
    }

    /// The lengths of the voxel edges in world units.
    pub fn spacing(&self) -> DVec3 {
        let m = self.index_to_world.matrix3;
        DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length())
    }

    /// The edge of a cube as large as a voxel, world units.
    pub fn mean_spacing(&self) -> f64 {
        // Factor by factor, since the determinant of tiny and huge voxels leaves f64's range long before their edges do.
        let spacing = self.spacing();
        let axes = self.index_to_world.matrix3;
        let unit = DMat3::from_cols(axes.x_axis / spacing.x, axes.y_axis / spacing.y, axes.z_axis / spacing.z);
        spacing.x.cbrt() * spacing.y.cbrt() * spacing.z.cbrt() * unit.determinant().abs().cbrt()
    }

    /// The dimensions as a vector.
    pub fn dims_f64(&self) -> DVec3 {
        DVec3::from_array(self.dims.map(f64::from))
    }

    /// Maps texture coordinates (the box is `0 ..= 1`) to world coordinates.
    pub fn texture_to_world(&self) -> DAffine3 {
        self.index_to_world * DAffine3::from_translation(DVec3::splat(-0.5)) * DAffine3::from_scale(self.dims_f64())
    }

    fn statistics(&self) -> &Statistics {
        self.statistics.get_or_init(|| {
            let (extremes, non_finite) =
                with_voxels!(&self.voxels, elements => extremes(elements, self.channels as usize));
            let stored: Vec<_> = extremes.iter().map(|e| e.unwrap_or(ValueRange::new(0.0, 0.0))).collect();
            let ranges = extremes
                .iter()
                .map(|e| e.map_or(ValueRange::new(0.0, 0.0), |range| self.rescaled_range(range)))
                .collect();
            Statistics { ranges, stored, non_finite }
        })
    }

    /// The range in data units of a range of stored values.
    pub(crate) fn rescaled_range(&self, stored: ValueRange) -> ValueRange {
        let ends = [stored.min, stored.max].map(|end| self.rescaled(end).clamp(f64::MIN, f64::MAX));
        ValueRange::new(ends[0].min(ends[1]), ends[0].max(ends[1]))
    }
}

/// The number of elements of a volume.
///
/// # Errors
/// When a dimension is zero, there are not 1 to 4 channels, or the number does not fit into `isize`.
pub(crate) fn element_count(dims: [u32; 3], channels: u32) -> Result<usize, VolumeError> {
    if dims.contains(&0) {
        return Err(VolumeError::NoVoxels(dims));
    }
    if !(1..=4).contains(&channels) {
        return Err(VolumeError::Channels(channels));
    }
    let count = dims.iter().chain([&channels]).try_fold(1_u64, |product, &n| product.checked_mul(u64::from(n)));
    count
        .and_then(|count| isize::try_from(count).ok())
        .map(isize::unsigned_abs)
        .ok_or(VolumeError::TooLarge { dims, channels })
}

fn check_transform(transform: &DAffine3) -> Result<(), VolumeError> {
    let m = transform.matrix3;
    let axes = [m.x_axis, m.y_axis, m.z_axis];
    let unit = DMat3::from_cols(axes[0].normalize_or_zero(), axes[1].normalize_or_zero(), axes[2].normalize_or_zero());
    if transform.is_finite() && unit.determinant().abs() > 1e-9 {
        return Ok(());
    }
    Err(VolumeError::Transform { columns: axes.map(|a| a.to_array()), translation: transform.translation.to_array() })
}

/// The finite extremes of every channel (none where no element is finite) and the number of elements that are not finite.
fn extremes<E: Element>(elements: &[E], channels: usize) -> (Vec<Option<ValueRange>>, u64) {
    const CHUNK: usize = 1 << 18;
    let chunks = elements.par_chunks(CHUNK / channels * channels);
    let (extremes, non_finite) = chunks.map(|chunk| chunk_extremes(chunk, channels)).reduce(
        || ([(E::HIGHEST, E::LOWEST); 4], 0),
        |(a, m), (b, n)| (std::array::from_fn(|c| (smaller(a[c].0, b[c].0), larger(a[c].1, b[c].1))), m + n),
    );
    let ranges = extremes[..channels]
        .iter()
        .map(|&(low, high)| (low <= high).then(|| ValueRange::new(low.to_f64(), high.to_f64())))
        .collect();
    (ranges, non_finite)
}

fn chunk_extremes<E: Element>(chunk: &[E], channels: usize) -> ([(E, E); 4], u64) {
    let mut result = [(E::HIGHEST, E::LOWEST); 4];
    let mut non_finite = 0;
    for (channel, (low, high)) in result[..channels].iter_mut().enumerate() {
        let mut fold = |element: E| {
            let finite = element.finite();
            *low = if finite { smaller(*low, element) } else { *low };
            *high = if finite { larger(*high, element) } else { *high };
            non_finite += u64::from(!finite);
        };
        // One channel is the common case, and a loop without stride is the one that is vectorised.
        if channels == 1 {
            chunk.iter().for_each(|&element| fold(element));
        } else {
            chunk.iter().skip(channel).step_by(channels).for_each(|&element| fold(element));
        }
    }
    (result, non_finite)
}

#[inline]
pub(crate) fn smaller<E: PartialOrd>(a: E, b: E) -> E {
    if b < a { b } else { a }
}

#[inline]
pub(crate) fn larger<E: PartialOrd>(a: E, b: E) -> E {
    if b > a { b } else { a }
}
