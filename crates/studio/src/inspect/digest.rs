//! What is worth seeing of a volume, small enough to be drawn: thumbnails and a histogram.

use std::sync::OnceLock;

use egui::{Color32, ColorImage, TextureHandle};
use rayloom_gpu::Features;
use rayloom_processors::{Storage, VolumeData};
use rayloom_volume::{Histogram, ValueRange, Volume, VolumeRole, histogram};

/// Longest side of a thumbnail, pixels.
const SIDE: f64 = 128.0;
/// Bins of the histogram.
const BINS: usize = 128;
/// Samples along a ray of the maximum projection at most.
const RAY_SAMPLES: u32 = 96;

/// A small picture of a volume.
pub(super) struct Thumbnail {
    /// What it shows.
    pub name: &'static str,
    /// The picture, in true proportions.
    pub picture: ColorImage,
}

/// A volume in brief.
pub(super) struct Digest {
    /// Finite range of every channel, data units.
    pub ranges: Vec<ValueRange>,
    /// Voxels that are not finite.
    pub non_finite: u64,
    /// The channel that the rest is about, from 0: the values beside gradients, else the first.
    pub channel: u32,
    /// How often values occur.
    pub histogram: Histogram,
    /// Three slices through the middle, and the maximum along z.
    pub thumbnails: Vec<Thumbnail>,
    /// Format on the device, and what is lost by it.
    pub format: String,
    /// See `format`.
    pub loss: Option<String>,
    /// The thumbnails on the window's device, once they have been shown.
    pub textures: OnceLock<Vec<TextureHandle>>,
}

impl Digest {
    /// Looks at all voxels: not for the window's thread.
    pub(super) fn new(data: &VolumeData, features: Features) -> Self {
        let volume = &*data.volume;
        let channel = match volume.role {
            VolumeRole::Values => 0,
            VolumeRole::GradientAndValue => volume.channels - 1,
        };
        let names = ["across x", "across y", "across z"];
        let mut thumbnails: Vec<Thumbnail> = (0..3)
            .map(|axis| {
                let middle = volume.dims[axis] / 2;
                Thumbnail { name: names[axis], picture: thumbnail(volume, channel, axis, middle..middle + 1) }
            })
            .collect();
        thumbnails.push(Thumbnail { name: "maximum", picture: thumbnail(volume, channel, 2, 0..volume.dims[2]) });
        let storage = Storage::choose(volume, data.precision, features);
        Self {
            ranges: volume.ranges().to_vec(),
            non_finite: volume.non_finite(),
            channel,
            histogram: histogram(volume, channel, BINS),
            thumbnails,
            format: format!("{:?}", storage.format).to_lowercase(),
            loss: storage.loss,
            textures: OnceLock::new(),
        }
    }
}

/// The largest values along an axis over a range of voxels, seen along that axis: the remaining axes run right and up.
fn thumbnail(volume: &Volume, channel: u32, axis: usize, along: std::ops::Range<u32>) -> ColorImage {
    let [right, up] = [[1, 2], [0, 2], [0, 1]][axis];
    let extent = volume.dims_f64() * volume.spacing();
    let scale = SIDE / extent[right].max(extent[up]);
    let size = [extent[right], extent[up]].map(|length| (length * scale).round().max(1.0) as usize);
    let range = volume.ranges()[channel as usize];
    let stride = along.len().div_ceil(RAY_SAMPLES as usize);
    let voxel = |pixel: usize, pixels: usize, voxels: u32| ((pixel * voxels as usize) / pixels) as u32;
    let value = |x: usize, y: usize| {
        let mut index = [0; 3];
        index[right] = voxel(x, size[0], volume.dims[right]);
        index[up] = voxel(size[1] - 1 - y, size[1], volume.dims[up]);
        let values = along.clone().step_by(stride).map(|position| {
            index[axis] = position;
            volume.finite_value(index, channel)
        });
        values.fold(f64::NEG_INFINITY, f64::max)
    };
    let grey = |value: f64| Color32::from_gray((range.normalise(value) * 255.0).round() as u8);
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| grey(value(x, y)));
    ColorImage::new(size, pixels.collect())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rayloom_processors::Precision;
    use rayloom_volume::Voxels;

    use super::*;

    #[test]
    fn thumbnails_have_true_proportions_and_up_is_up() {
        let values = (0..4 * 2 * 3).map(|i| (i / 8) as u8).collect();
        let identity = Default::default();
        let volume = Volume::new("ramp", [4, 2, 3], 1, Voxels::U8(values), identity).expect("a volume");
        let features = Features { timestamps: false, float32_filterable: false, norm16: false };
        let digest = Digest::new(&VolumeData::new(Arc::new(volume), Precision::Auto), features);
        let sizes: Vec<_> = digest.thumbnails.iter().map(|thumbnail| thumbnail.picture.size).collect();
        assert_eq!(sizes, [[85, 128], [128, 96], [128, 64], [128, 64]]);
        let across_y = &digest.thumbnails[1].picture;
        assert_eq!(across_y[(0, 0)], Color32::WHITE);
        assert_eq!(across_y[(0, 95)], Color32::BLACK);
        assert_eq!(digest.thumbnails[3].picture[(5, 5)], Color32::WHITE);
        assert_eq!(digest.histogram.counts.iter().sum::<u64>(), 24);
    }
}
