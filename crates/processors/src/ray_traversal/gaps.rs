//! Where the volume has no values: kept and brought to the device only when there is such a place.

use std::convert::Infallible;
use std::sync::Arc;

use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_volume::{Gaps, Volume};

use super::memo::{Memo, VolumeKey};

type Key = (VolumeKey, u32);

/// The gaps of the last volume and channel.
#[derive(Default)]
pub(super) struct GapMemory {
    gaps: Memo<Key, Option<Arc<Gaps>>>,
    texture: Memo<Key, Arc<Texture>>,
}

impl GapMemory {
    /// The gaps of a channel; `None` where every voxel has a value.
    pub fn of(&mut self, volume: &Arc<Volume>, channel: u32) -> Option<Arc<Gaps>> {
        let key = (VolumeKey(volume.clone()), channel);
        let Ok(gaps) = self.gaps.get(key, || Ok::<_, Infallible>(Gaps::of(volume, channel).map(Arc::new)));
        gaps
    }

    /// The same as a texture, r8uint.
    pub fn texture(&mut self, gpu: &Gpu, volume: &Arc<Volume>, channel: u32) -> Result<Option<Arc<Texture>>, GpuError> {
        let Some(gaps) = self.of(volume, channel) else { return Ok(None) };
        let texture = self.texture.get((VolumeKey(volume.clone()), channel), || {
            let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
            let texture = gpu.texture_3d("the voxels without value", gaps.dims, TextureFormat::R8Uint, usage)?;
            gpu.upload(&texture, &gaps.cells)?;
            Ok::<_, GpuError>(Arc::new(texture))
        })?;
        Ok(Some(texture))
    }
}
