//! Coefficients of the B-spline through a volume, for tricubic sampling.

use std::sync::Arc;

use bytemuck::cast_slice;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_network::ProcessError;
use rayloom_volume::{Volume, Voxels, bspline_coefficients};

use super::memo::{Memo, VolumeKey};

/// The last coefficients, on the CPU and on the device.
#[derive(Default)]
pub(super) struct Splines {
    coefficients: Memo<(VolumeKey, u32), Arc<Volume>>,
    texture: Memo<(VolumeKey, u32), Arc<Texture>>,
}

impl Splines {
    /// The coefficients of the spline through a channel, normalised, as a volume of one channel.
    pub fn coefficients(&mut self, volume: &Arc<Volume>, channel: u32) -> Result<Arc<Volume>, ProcessError> {
        self.coefficients.get((VolumeKey(volume.clone()), channel), || {
            let voxels = Voxels::F32(bspline_coefficients(volume, channel));
            let name = format!("spline of {}", volume.name);
            Ok(Arc::new(Volume::new(name, volume.dims, 1, voxels, volume.index_to_world)?))
        })
    }

    /// The coefficients as a texture, r32float.
    pub fn texture(&mut self, gpu: &Gpu, volume: &Arc<Volume>, channel: u32) -> Result<Arc<Texture>, ProcessError> {
        let coefficients = self.coefficients(volume, channel)?;
        let texture = self.texture.get((VolumeKey(volume.clone()), channel), || {
            let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
            let texture = gpu.texture_3d("spline coefficients", volume.dims, TextureFormat::R32Float, usage)?;
            if let Voxels::F32(values) = &coefficients.voxels {
                gpu.upload(&texture, cast_slice(values))?;
            }
            Ok::<_, GpuError>(Arc::new(texture))
        })?;
        Ok(texture)
    }
}
