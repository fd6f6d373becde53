//! Empty-space skipping: which bricks hold nothing visible, and whether skipping them is worth it.

use std::sync::Arc;

use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_network::{ProcessError, Properties};
use rayloom_volume::{
    MinMaxBricks, TransferFunction, TransferFunction2D, ValueRange, Volume, distance_map, table_interval,
};
use rayloom_wgsl::{Choice, Emptiness, Kernel, Slot, Snippet, Visibility};

use super::memo::{Memo, VolumeKey};
use super::snippets::PLACES;
use super::splines::Splines;
use super::tables::{ENTRIES, ENTRIES_2D};

/// Share of visible bricks above which leaping costs more than it saves; measured, see docs/PERFORMANCE.md.
pub(super) const WORTHWHILE: f64 = 0.6;

/// The skipping map: 0 for bricks that may hold something visible, else the distance to the nearest such brick.
#[derive(Clone)]
pub(super) struct SkipMap {
    grid: [u32; 3],
    bytes: Arc<Vec<u8>>,
    /// Share of bricks that may hold something visible.
    pub occupied: f64,
}

/// Bricks depend on volume, channel, brick size, apron and whether they are those of spline coefficients.
type BrickKey = (VolumeKey, u32, u32, u32, bool);

/// What makes something visible.
#[derive(Clone, PartialEq)]
enum VisibilityKey {
    Function(TransferFunction),
    Function2D(TransferFunction2D),
    Between([f64; 2]),
    Nothing,
}

/// The map depends on the bricks, on what is visible, on isovalues, on the kind of map and on the kernel's spread.
type MapKey = (BrickKey, VisibilityKey, Vec<f64>, bool, f64);

/// The last bricks and maps: a new transfer function leaves the bricks, and the volume, alone.
#[derive(Default)]
pub(super) struct SkipMemory {
    bricks: Memo<BrickKey, Arc<MinMaxBricks>>,
    map: Memo<MapKey, SkipMap>,
    texture: Memo<MapKey, Arc<Texture>>,
}

/// What the map of a choice depends on.
pub(super) struct Question<'a> {
    volume: &'a Arc<Volume>,
    range: ValueRange,
    kernel: Kernel,
    key: MapKey,
}

impl<'a> Question<'a> {
    /// The question whether a legal choice with a skipping snippet can skip; `None` when it has none.
    pub fn of(
        choice: &Choice,
        properties: &Properties,
        volume: &'a Arc<Volume>,
        channel: u32,
    ) -> Result<Option<Self>, ProcessError> {
        let Some(skipping) = choice.snippet(Slot::Skipping) else { return Ok(None) };
        let sampling = choice.snippet(Slot::Sampling);
        let Some((sampling, kernel)) = sampling.and_then(|sampling| Some((sampling, sampling.declaration().kernel?)))
        else {
            return Ok(None);
        };
        let mut isovalues = Vec::new();
        let mut transparent = false;
        for place in PLACES {
            let Some(output) = place.output.and_then(|output| choice.outputs[output].as_ref()) else { continue };
            let names = match output.declaration().emptiness.as_ref() {
                None | Some(Emptiness::Transparent) => {
                    transparent = true;
                    continue;
                }
                Some(Emptiness::NoCrossing(names)) => names,
                Some(Emptiness::TransparentWithoutCrossing(names)) => {
                    transparent = true;
                    names
                }
            };
            for name in names {
                isovalues.push(properties.f64(&format!("{}.{name}", place.id))?);
            }
        }
        let classification = choice.snippet(Slot::Classification).map(Snippet::declaration);
        let visibility = match classification.map(|classification| &classification.visibility) {
            _ if !transparent => VisibilityKey::Nothing,
            Some(Visibility::TransferFunction) => {
                VisibilityKey::Function(properties.transfer_function("transfer_function")?.clone())
            }
            Some(Visibility::TransferFunction2D) => {
                VisibilityKey::Function2D(properties.transfer_function_2d("transfer_function_2d")?.clone())
            }
            Some(Visibility::Between(low, high)) => {
                let end = |name: &str| properties.f64(&format!("classification.{name}"));
                VisibilityKey::Between([end(low)?, end(high)?])
            }
            None | Some(Visibility::Always) => return Ok(None),
        };
        let brick = if properties.text("brick_size")? == "8" { 8 } else { 4 };
        let splines = sampling.reads("prefiltered");
        let bricks: BrickKey = (VolumeKey(volume.clone()), channel, brick, kernel.apron, splines);
        let distances = skipping.id() != "occupancy";
        let key = (bricks, visibility, isovalues, distances, kernel.spread);
        let range = volume.ranges()[channel as usize];
        Ok(Some(Self { volume, range, kernel, key }))
    }

    /// The answer, from memory where nothing changed.
    pub fn map(&self, memory: &mut SkipMemory, splines: &mut Splines) -> Result<SkipMap, ProcessError> {
        let (_, channel, size, apron, of_splines) = self.key.0;
        let coefficients = match of_splines {
            true => Some(splines.coefficients(self.volume, channel)?),
            false => None,
        };
        let bricks = memory.bricks.get(self.key.0.clone(), || {
            let bricks = match &coefficients {
                Some(coefficients) => MinMaxBricks::build(coefficients, 0, size, apron),
                None => MinMaxBricks::build(self.volume, channel, size, apron),
            };
            Ok::<_, ProcessError>(Arc::new(bricks))
        })?;
        memory.map.get(self.key.clone(), || {
            let occupied = bricks.occupancy(|min, max| self.shows(min, max));
            let share = occupied.iter().map(|&brick| f64::from(brick)).sum::<f64>() / occupied.len().max(1) as f64;
            let bytes = match self.key.3 {
                true => distance_map(&occupied, bricks.grid),
                false => occupied.iter().map(|brick| 1 - brick).collect(),
            };
            Ok(SkipMap { grid: bricks.grid, bytes: Arc::new(bytes), occupied: share })
        })
    }

    /// The map as a texture, r8uint.
    pub fn texture(
        &self,
        gpu: &Gpu,
        memory: &mut SkipMemory,
        splines: &mut Splines,
    ) -> Result<Arc<Texture>, ProcessError> {
        let map = self.map(memory, splines)?;
        memory
            .texture
            .get(self.key.clone(), || {
                let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
                let texture = gpu.texture_3d("skipping map", map.grid, TextureFormat::R8Uint, usage)?;
                gpu.upload(&texture, &map.bytes)?;
                Ok::<_, GpuError>(Arc::new(texture))
            })
            .map_err(Into::into)
    }

    /// Bricks a unit of volume coordinates, along each axis.
    pub fn brick_scale(&self) -> [f32; 3] {
        self.volume.dims.map(|voxels| voxels as f32 / self.key.0.2 as f32)
    }

    /// Whether a brick with values (data units; spline coefficients: normalised) between `min` and `max` can show anything.
    fn shows(&self, min: f64, max: f64) -> bool {
        let (min, max) = match self.key.0.4 {
            true => (self.range.denormalise(min), self.range.denormalise(max)),
            false => (min, max),
        };
        // A kernel that overshoots widens the span of values; rounding on the way to the shader, a little more.
        let (middle, half) = (0.5 * (min + max), 0.5 * (max - min) * self.kernel.spread + 1e-5 * self.range.width());
        let (min, max) = (middle - half, middle + half);
        let crossed = self.key.2.iter().any(|isovalue| (min..=max).contains(isovalue));
        crossed || self.visible(min, max)
    }

    fn visible(&self, min: f64, max: f64) -> bool {
        let function = |function: &TransferFunction, entries| {
            let (min, max) = table_interval(self.range, entries, min, max);
            !function.transparent_between(min, max)
        };
        match &self.key.1 {
            // Pre-integrated tables are the coarser ones.
            VisibilityKey::Function(f) => function(f, ENTRIES) || function(f, ENTRIES_2D),
            VisibilityKey::Function2D(f) => visible_2d(f, self.range, min, max),
            VisibilityKey::Between([low, high]) => max >= *low && min <= *high,
            VisibilityKey::Nothing => false,
        }
    }
}

fn visible_2d(function: &TransferFunction2D, range: ValueRange, min: f64, max: f64) -> bool {
    let (min, max) = table_interval(range, ENTRIES_2D, min, max);
    !function.transparent_between(min, max)
}
