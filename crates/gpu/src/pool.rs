use std::sync::Arc;

use wgpu::{TextureFormat, TextureUsages};

use crate::{Gpu, GpuError, Texture};

/// Hands out 2-D render targets and takes them back by itself: a texture is free again once every [`Arc`] to it is
/// dropped, and the next request of the same size and format gets it, with its *old contents*.
#[derive(Debug, Default)]
pub struct TexturePool {
    textures: Vec<Arc<Texture>>,
    counts: PoolCounts,
}

/// How often a pool made a texture and how often it could hand out an old one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PoolCounts {
    /// Textures made.
    pub created: u64,
    /// Requests served with an old texture.
    pub reused: u64,
}

impl TexturePool {
    /// An empty pool.
    pub fn new() -> Self {
        Self::default()
    }

    /// A texture of `size` (width, height) that can be sampled, copied, drawn into and, where the format allows it,
    /// written by compute shaders. Write every texel: what an earlier owner left is still in it.
    pub fn get(
        &mut self,
        gpu: &Gpu,
        label: &str,
        size: [u32; 2],
        format: TextureFormat,
    ) -> Result<Arc<Texture>, GpuError> {
        let fits = |texture: &&Arc<Texture>| {
            texture.format == format && texture.size_2d() == size && Arc::strong_count(texture) == 1
        };
        if let Some(texture) = self.textures.iter().find(fits) {
            self.counts.reused += 1;
            return Ok(texture.clone());
        }
        let texture = Arc::new(gpu.texture_2d(label, size, format, usages(gpu, format))?);
        self.textures.push(texture.clone());
        self.counts.created += 1;
        Ok(texture)
    }

    /// Frees textures that nobody holds until at most `keep` bytes of such are left, the oldest first, and returns how
    /// many bytes that were.
    pub fn trim(&mut self, keep: u64) -> u64 {
        let is_free = |texture: &Arc<Texture>| Arc::strong_count(texture) == 1;
        let free: u64 = self.textures.iter().filter(|t| is_free(t)).map(|t| t.bytes()).sum();
        let mut freed = 0;
        self.textures.retain(|texture| {
            let goes = is_free(texture) && free - freed > keep;
            freed += if goes { texture.bytes() } else { 0 };
            !goes
        });
        freed
    }

    /// Bytes of all textures of the pool, in use or free.
    pub fn bytes(&self) -> u64 {
        self.textures.iter().map(|texture| texture.bytes()).sum()
    }

    /// How well reuse works.
    pub fn counts(&self) -> PoolCounts {
        self.counts
    }
}

fn usages(gpu: &Gpu, format: TextureFormat) -> TextureUsages {
    let wanted = TextureUsages::TEXTURE_BINDING
        | TextureUsages::STORAGE_BINDING
        | TextureUsages::RENDER_ATTACHMENT
        | TextureUsages::COPY_SRC
        | TextureUsages::COPY_DST;
    wanted & format.guaranteed_format_features(gpu.device.features()).allowed_usages
}
