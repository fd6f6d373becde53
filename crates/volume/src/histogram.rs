//! Histograms of values, and of values and gradient magnitudes.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::gradient::{GradientRows, Operator};
use crate::{Element, ValueRange, Volume, with_voxels};

/// How often values occur.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// From the left end of the first bin to the right end of the last, data units; the finite range of the channel.
    pub range: ValueRange,
    /// Voxels in each of the equally wide bins. Voxels that are not finite are not counted.
    pub counts: Vec<u64>,
}

/// How often values occur together with gradient magnitudes.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram2D {
    /// The extent of the value axis, data units; the finite range of the channel.
    pub range: ValueRange,
    /// The extent of the gradient axis, from 0 to this, data units per world unit; the largest that occurs.
    pub gradient_max: f64,
    /// Bins along the value and the gradient axis.
    pub bins: [usize; 2],
    /// Voxels in each bin, the value running fastest. Voxels that are not finite are not counted.
    pub counts: Vec<u64>,
}

/// Counts the values of one channel in `bins` equally wide bins over its finite range. The largest value counts for the last
/// bin, and a constant channel for the first.
///
/// # Panics
/// When there is no such channel or no bin.
pub fn histogram(volume: &Volume, channel: u32, bins: usize) -> Histogram {
    let range = volume.ranges()[channel as usize];
    let (channels, channel) = (volume.channels as usize, channel as usize);
    let counts = with_voxels!(&volume.voxels, elements => {
        let chunks = elements.par_chunks((1 << 18) / channels * channels);
        let count = |chunk: &[_]| {
            let mut counts = vec![0; bins];
            for &element in chunk.iter().skip(channel).step_by(channels) {
                if Element::finite(element) {
                    counts[bin(range.normalise(volume.rescaled(Element::to_f64(element))), bins)] += 1;
                }
            }
            counts
        };
        chunks.map(count).reduce(|| vec![0; bins], add)
    });
    Histogram { range, counts }
}

/// Counts values together with gradient magnitudes (central differences, world space) in `bins` over the finite range of the
/// channel and from 0 to the largest gradient magnitude.
///
/// # Panics
/// When there is no such channel or no bin along one of the axes.
pub fn histogram_2d(volume: &Volume, channel: u32, bins: [usize; 2]) -> Histogram2D {
    let range = volume.ranges()[channel as usize];
    let to_world = gradient_to_world(volume);
    let [_, ny, nz] = volume.dims.map(|n| n as usize);
    let rows = || (0..ny * nz).into_par_iter();
    let start = || GradientRows::new(volume, channel, Operator::CentralDifferences);
    let largest = |work: &mut GradientRows<'_>, at: usize| {
        work.compute(at % ny, at / ny);
        magnitudes(work, to_world).fold(0.0, f64::max)
    };
    let gradient_max = rows().map_init(start, largest).reduce(|| 0.0, f64::max);

    let empty = || vec![0; bins[0] * bins[1]];
    let counted = rows().fold(
        || (start(), empty()),
        |(mut work, mut counts), at| {
            work.compute(at % ny, at / ny);
            for (i, magnitude) in magnitudes(&work, to_world).enumerate() {
                let value = volume.value([i as u32, (at % ny) as u32, (at / ny) as u32], channel);
                if value.is_finite() {
                    let steepness = if gradient_max > 0.0 { magnitude / gradient_max } else { 0.0 };
                    counts[bin(steepness, bins[1]) * bins[0] + bin(range.normalise(value), bins[0])] += 1;
                }
            }
            (work, counts)
        },
    );
    let counts = counted.map(|(_, counts)| counts).reduce(empty, add);
    Histogram2D { range, gradient_max, bins, counts }
}

/// The gradient magnitudes of a row, data units per world unit.
fn magnitudes<'a>(rows: &'a GradientRows<'_>, to_world: DMat3) -> impl Iterator<Item = f64> + 'a {
    let [x, y, z] = &rows.gradient;
    x.iter().zip(y).zip(z).map(move |((&x, &y), &z)| (to_world * DVec3::new(x, y, z)).length())
}

/// Turns a gradient per voxel index step into one per world unit.
fn gradient_to_world(volume: &Volume) -> DMat3 {
    volume.index_to_world.matrix3.inverse().transpose()
}

fn bin(normalised: f64, bins: usize) -> usize {
    ((normalised * bins as f64) as usize).min(bins - 1)
}

fn add(mut a: Vec<u64>, b: Vec<u64>) -> Vec<u64> {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
    a
}
