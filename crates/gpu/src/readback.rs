use std::sync::mpsc;

use half::f16;
use wgpu::TextureFormat;

use crate::{Gpu, GpuError, Texture};

impl Gpu {
    /// The texels of a texture as numbers, row 0 at the top, x fastest, slices one after the other; missing channels
    /// are 0 and a missing alpha is 1, as a shader would see them. Waits for the device.
    ///
    /// Formats: 1, 2 or 4 channels of 8- or 16-bit unorm or 16- or 32-bit float.
    pub fn read_rgba_f32(&self, texture: &Texture) -> Result<Vec<[f32; 4]>, GpuError> {
        self.read_region(texture, [0; 3], texture.size)
    }

    /// Like [`Gpu::read_rgba_f32`] for the box of `size` texels at `origin`, which must lie within the texture.
    pub fn read_region(&self, texture: &Texture, origin: [u32; 3], size: [u32; 3]) -> Result<Vec<[f32; 4]>, GpuError> {
        let decode = decoder(texture.format).ok_or_else(|| GpuError::Unsupported {
            what: texture.label.clone(),
            format: texture.format,
            purpose: "to be read back",
        })?;
        let bytes = self.read_texels(texture, origin, size)?;
        let channels = usize::from(texture.format.components());
        let texel_bytes = texture.texel_bytes() as usize;
        Ok(bytes.chunks_exact(texel_bytes).map(|texel| numbers(texel, channels, decode)).collect())
    }

    /// The raw texels of the box of `size` texels at `origin`, without padding. Waits for the device.
    pub fn read_texels(&self, texture: &Texture, origin: [u32; 3], size: [u32; 3]) -> Result<Vec<u8>, GpuError> {
        let inside = (0..3).all(|axis| {
            size[axis] > 0 && origin[axis].checked_add(size[axis]).is_some_and(|end| end <= texture.size[axis])
        });
        if !inside {
            return Err(GpuError::WrongSize {
                what: format!("the part of {} to read back", texture.label),
                found: format!("{size:?} texels at {origin:?}"),
                expected: format!("at least one texel, within {:?}", texture.size),
            });
        }
        let row_bytes = size[0] as usize * texture.texel_bytes() as usize;
        let padded_row = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let rows = size[1] as usize * size[2] as usize;
        let staging = self.staging(&texture.label, (padded_row * rows) as u64)?;
        self.guarded(&format!("reading back {}", texture.label), || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encoder.copy_texture_to_buffer(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture.texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: origin[0], y: origin[1], z: origin[2] },
                    aspect: wgpu::TextureAspect::All,
                },
                wgpu::TexelCopyBufferInfo {
                    buffer: &staging,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(padded_row as u32),
                        rows_per_image: Some(size[1]),
                    },
                },
                wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: size[2] },
            );
            self.queue.submit([encoder.finish()]);
        })?;
        let padded = self.map_and_copy(&staging, &texture.label)?;
        Ok(padded.chunks_exact(padded_row).flat_map(|row| &row[..row_bytes]).copied().collect())
    }

    /// The bytes of a buffer created with `COPY_SRC`. Waits for the device.
    pub fn read_buffer(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
        let staging = self.staging("a buffer to read back", buffer.size())?;
        self.guarded("reading back a buffer", || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
            self.queue.submit([encoder.finish()]);
        })?;
        self.map_and_copy(&staging, "a buffer")
    }

    fn staging(&self, label: &str, size: u64) -> Result<wgpu::Buffer, GpuError> {
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        self.check_buffer(label, size, usage)?;
        self.guarded(label, || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        })
    }

    fn map_and_copy(&self, staging: &wgpu::Buffer, what: &str) -> Result<Vec<u8>, GpuError> {
        let what = format!("{what} was read back");
        let lost = |message: String| GpuError::Lost { what: what.clone(), message };
        let (sender, receiver) = mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver lives until the end of this function; if it does not, nobody wants the news.
            let _ = sender.send(result);
        });
        self.wait(&what)?;
        receiver.recv().map_err(|error| lost(error.to_string()))?.map_err(|error| lost(error.to_string()))?;
        let bytes = staging.get_mapped_range(..).map_err(|error| lost(error.to_string()))?.to_vec();
        staging.unmap();
        Ok(bytes)
    }
}

/// Turns the bytes of one channel into its value.
type Decode = fn(&[u8]) -> f32;

fn decoder(format: TextureFormat) -> Option<(usize, Decode)> {
    use TextureFormat as F;
    Some(match format {
        F::R8Unorm | F::Rg8Unorm | F::Rgba8Unorm => (1, |b| f32::from(b[0]) / 255.0),
        F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => (2, |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0),
        F::R16Float | F::Rg16Float | F::Rgba16Float => (2, |b| f16::from_le_bytes([b[0], b[1]]).to_f32()),
        F::R32Float | F::Rg32Float | F::Rgba32Float => (4, |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        _ => return None,
    })
}

fn numbers(texel: &[u8], channels: usize, (width, decode): (usize, Decode)) -> [f32; 4] {
    let mut rgba = [0.0, 0.0, 0.0, 1.0];
    for (value, bytes) in rgba.iter_mut().zip(texel.chunks_exact(width)).take(channels) {
        *value = decode(bytes);
    }
    rgba
}
