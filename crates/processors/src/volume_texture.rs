//! Volumes as 3-D textures: which format holds them, how texels turn into normalised values, and the upload.

use std::sync::Arc;

use half::f16;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Features, Gpu, GpuError, Texture};
use rayloom_volume::{Element, ValueRange, Volume, VolumeRole, with_voxels};
use rayon::prelude::*;

use crate::Precision;

/// Every integer up to this one is a half float.
const HALF_EXACT: f64 = 2048.0;

/// Voxels converted by one task.
const TASK: usize = 4096;

/// Bytes converted before they are handed to the device.
const SLAB_BYTES: usize = 64 << 20;

/// A volume on the device.
#[derive(Debug)]
pub struct GpuVolume {
    /// The 3-D texture; voxel (i, j, k) is texel (i, j, k).
    pub texture: Arc<Texture>,
    /// Whether it can be sampled with a filtering sampler.
    pub filterable: bool,
    /// With `offset`: `texel * scale + offset` is the normalised value, 0 to 1 over the channel's range. Where the volume
    /// holds gradients, their channels are in normalised values per voxel step.
    pub scale: [f32; 4],
    /// See `scale`.
    pub offset: [f32; 4],
}

impl GpuVolume {
    /// Converts and uploads a volume. NaN becomes the minimum of its channel's range (and is not drawn), an infinity the end it lies beyond.
    /// Fails when a side is longer than the device allows or its memory does not suffice.
    pub fn upload(gpu: &Gpu, volume: &Volume, precision: Precision) -> Result<Self, GpuError> {
        let storage = Storage::choose(volume, precision, gpu.features);
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC;
        let texture = gpu.texture_3d(&format!("the volume `{}`", volume.name), volume.dims, storage.format, usage)?;
        let slice = volume.dims[0] as usize * volume.dims[1] as usize;
        let slices = (SLAB_BYTES / (slice * storage.texel_bytes())).max(1);
        with_voxels!(&volume.voxels, elements => {
            let slabs = elements.chunks(slice * slices * volume.channels as usize);
            for (first, slab) in (0..volume.dims[2]).step_by(slices).zip(slabs) {
                gpu.upload_slices(&texture, first, &storage.encode(volume, slab))?;
            }
        });
        let filterable = gpu.filterable(storage.format);
        let (scale, offset) = storage.decoding();
        Ok(Self { texture: Arc::new(texture), filterable, scale, offset })
    }
}

/// How the texels of a volume are stored.
#[derive(Debug, Clone)]
pub struct Storage {
    /// Texture format.
    pub format: TextureFormat,
    /// What is lost, as a sentence; none when every value is kept (32-bit floats: but for rounding).
    pub loss: Option<String>,
    number: Number,
    channels: Vec<Channel>,
}

/// The kinds of numbers in texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Number {
    Unorm8,
    Unorm16,
    Half,
    Float,
}

/// How one channel is stored: number = normalised value * gain + bias.
#[derive(Debug, Clone, Copy)]
struct Channel {
    /// The range of a channel of values; for gradients, that of the values that they are gradients of.
    range: ValueRange,
    is_gradient: bool,
    gain: f64,
    bias: f64,
}

impl Storage {
    /// The format for a volume at a precision on a device with these abilities.
    pub fn choose(volume: &Volume, precision: Precision, features: Features) -> Self {
        match volume.role {
            VolumeRole::Values => Self::for_values(volume, precision, features),
            VolumeRole::GradientAndValue => Self::for_gradients(volume, precision),
        }
    }

    fn for_values(volume: &Volume, precision: Precision, features: Features) -> Self {
        let spans: Vec<Option<f64>> = (0..volume.channels).map(|channel| code_span(volume, channel)).collect();
        // The codes needed to tell all stored values apart; too many for floats.
        let codes = spans.iter().try_fold(0.0, |most: f64, span| span.map(|s| most.max(s))).unwrap_or(f64::INFINITY);
        let exact_unorm16 = features.norm16 && codes <= 65535.0;
        let (number, lossless) = match precision {
            Precision::Auto if codes <= HALF_EXACT => (Number::Half, true),
            Precision::Auto if exact_unorm16 => (Number::Unorm16, true),
            Precision::Auto | Precision::Bits32 => (Number::Float, true),
            Precision::Bits8 => (Number::Unorm8, codes <= 255.0),
            Precision::Bits16 if features.norm16 => (Number::Unorm16, codes <= 65535.0),
            Precision::Bits16 => (Number::Half, codes <= HALF_EXACT),
        };
        let gain = |span: Option<f64>| match (number, span) {
            (Number::Float, _) => 1.0,
            (_, Some(span)) if lossless => span.max(1.0),
            (Number::Half, _) => 1.0,
            _ => number.unit(),
        };
        let channels = volume.ranges().iter().zip(spans);
        let channels =
            channels.map(|(&range, span)| Channel { range, is_gradient: false, gain: gain(span), bias: 0.0 });
        let loss = (!lossless).then(|| number.loss().to_owned());
        Self { format: number.format(volume.channels), loss, number, channels: channels.collect() }
    }

    fn for_gradients(volume: &Volume, precision: Precision) -> Self {
        let number = match precision {
            Precision::Auto | Precision::Bits32 => Number::Float,
            Precision::Bits16 => Number::Half,
            Precision::Bits8 => Number::Unorm8,
        };
        let ranges = volume.ranges();
        let range = ranges[3];
        let steepest =
            ranges[..3].iter().flat_map(|r| [r.min, r.max]).map(|g| per_range(g, range).abs()).fold(0.0, f64::max);
        // Code 128 is zero, so that flat regions stay exactly flat.
        let (gain, bias) = match number {
            Number::Unorm8 if steepest > 0.0 => (127.0 / steepest, 128.0),
            Number::Unorm8 => (1.0, 128.0),
            _ => (1.0, 0.0),
        };
        let gradient = Channel { range, is_gradient: true, gain, bias };
        let value_gain = if number == Number::Unorm8 { number.unit() } else { 1.0 };
        let value = Channel { range, is_gradient: false, gain: value_gain, bias: 0.0 };
        let loss = (number != Number::Float).then(|| number.loss().to_owned());
        Self { format: number.format(4), loss, number, channels: vec![gradient, gradient, gradient, value] }
    }

    /// Scale and offset that turn texels into normalised values; a padded fourth channel stays as it is.
    fn decoding(&self) -> ([f32; 4], [f32; 4]) {
        let (mut scale, mut offset) = ([1.0; 4], [0.0; 4]);
        for (i, channel) in self.channels.iter().enumerate() {
            scale[i] = (self.number.unit() / channel.gain) as f32;
            offset[i] = (-channel.bias / channel.gain) as f32;
        }
        (scale, offset)
    }

    fn texel_bytes(&self) -> usize {
        self.number.bytes() * texture_channels(self.channels.len())
    }

    /// The texels of consecutive voxels.
    fn encode<E: Element>(&self, volume: &Volume, elements: &[E]) -> Vec<u8> {
        let (channels, texel) = (self.channels.len(), self.texel_bytes());
        let mut bytes = vec![0; elements.len() / channels * texel];
        let tasks = bytes.par_chunks_mut(texel * TASK).zip(elements.par_chunks(channels * TASK));
        tasks.for_each(|(bytes, elements)| {
            for (texel, voxel) in bytes.chunks_exact_mut(texel).zip(elements.chunks_exact(channels)) {
                let numbers = texel.chunks_exact_mut(self.number.bytes());
                for ((bytes, element), channel) in numbers.zip(voxel).zip(&self.channels) {
                    let normalised = channel.normalise(volume.rescaled(element.to_f64()));
                    self.number.write(normalised * channel.gain + channel.bias, bytes);
                }
            }
        });
        bytes
    }
}

impl Channel {
    #[inline]
    fn normalise(&self, value: f64) -> f64 {
        if !self.is_gradient {
            self.range.normalise(self.range.finite_value(value))
        } else if value.is_finite() {
            per_range(value, self.range)
        } else {
            0.0
        }
    }
}

impl Number {
    /// The number that a shader reads as 1.
    fn unit(self) -> f64 {
        match self {
            Self::Unorm8 => 255.0,
            Self::Unorm16 => 65535.0,
            Self::Half | Self::Float => 1.0,
        }
    }

    fn bytes(self) -> usize {
        match self {
            Self::Unorm8 => 1,
            Self::Unorm16 | Self::Half => 2,
            Self::Float => 4,
        }
    }

    fn format(self, channels: u32) -> TextureFormat {
        use TextureFormat as F;
        let formats = match self {
            Self::Unorm8 => [F::R8Unorm, F::Rg8Unorm, F::Rgba8Unorm],
            Self::Unorm16 => [F::R16Unorm, F::Rg16Unorm, F::Rgba16Unorm],
            Self::Half => [F::R16Float, F::Rg16Float, F::Rgba16Float],
            Self::Float => [F::R32Float, F::Rg32Float, F::Rgba32Float],
        };
        formats[channels.clamp(1, 3) as usize - 1]
    }

    fn loss(self) -> &'static str {
        match self {
            Self::Unorm8 => "The volume was reduced to 256 steps over its value range.",
            Self::Unorm16 => "The volume was reduced to 65536 steps over its value range.",
            Self::Half => "The volume was reduced to half floats, at most 2048 steps over its value range.",
            Self::Float => "The volume was rounded to 32-bit floats.",
        }
    }

    #[inline]
    fn write(self, number: f64, bytes: &mut [u8]) {
        match self {
            // Casts saturate.
            Self::Unorm8 => bytes[0] = number.round() as u8,
            Self::Unorm16 => bytes.copy_from_slice(&(number.round() as u16).to_le_bytes()),
            Self::Half => bytes.copy_from_slice(&f16::from_f64(number).to_le_bytes()),
            Self::Float => bytes.copy_from_slice(&(number as f32).to_le_bytes()),
        }
    }
}

/// A gradient in data units as normalised values: 0 when the range is one value wide.
fn per_range(gradient: f64, range: ValueRange) -> f64 {
    let width = range.width();
    if width > 0.0 { gradient / width } else { 0.0 }
}

/// Channels of a texel that holds this many; there are no formats with three.
fn texture_channels(channels: usize) -> usize {
    if channels == 3 { 4 } else { channels }
}

/// The number of integer steps between the smallest and the largest stored value of a channel; none for floats.
fn code_span(volume: &Volume, channel: u32) -> Option<f64> {
    let integer = !volume.voxels.element_type().is_float();
    integer.then(|| volume.stored_range(channel).width())
}
