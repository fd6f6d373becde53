use wgpu::{TextureFormat, TextureUsages};

use crate::{Gpu, GpuError};

/// A texture with the one view everybody uses.
#[derive(Debug)]
pub struct Texture {
    /// The texture itself.
    pub texture: wgpu::Texture,
    /// A view of all of it.
    pub view: wgpu::TextureView,
    /// Width, height and depth in texels; the depth of a 2-D texture is 1.
    pub size: [u32; 3],
    /// Texel format.
    pub format: TextureFormat,
    /// What it is for; error messages name it.
    pub label: String,
}

impl Texture {
    /// Width and height in texels.
    pub fn size_2d(&self) -> [u32; 2] {
        [self.size[0], self.size[1]]
    }

    /// Bytes of one texel; 0 for formats whose texels cannot be copied on their own.
    pub fn texel_bytes(&self) -> u64 {
        texel_bytes(self.format)
    }

    /// Bytes of the whole texture, without what the driver adds.
    pub fn bytes(&self) -> u64 {
        self.size.iter().map(|&n| u64::from(n)).product::<u64>() * self.texel_bytes()
    }
}

fn texel_bytes(format: TextureFormat) -> u64 {
    format.block_copy_size(None).map_or(0, u64::from)
}

/// At most this much is staged at once when a texture is uploaded, so that a large volume is not in memory twice.
const STAGING_BYTES: u64 = 64 << 20;

impl Gpu {
    /// Creates a 2-D texture; its contents are zero. Fails with the name of the limit when a side is too long.
    pub fn texture_2d(
        &self,
        label: &str,
        size: [u32; 2],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Texture, GpuError> {
        self.create_texture(label, [size[0], size[1], 1], wgpu::TextureDimension::D2, format, usage)
    }

    /// Creates a 3-D texture; its contents are zero. Fails with the name of the limit when a side is too long.
    pub fn texture_3d(
        &self,
        label: &str,
        size: [u32; 3],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Texture, GpuError> {
        self.create_texture(label, size, wgpu::TextureDimension::D3, format, usage)
    }

    fn create_texture(
        &self,
        label: &str,
        size: [u32; 3],
        dimension: wgpu::TextureDimension,
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Texture, GpuError> {
        self.check_size(label, size, dimension)?;
        if !self.device.features().contains(format.required_features()) {
            return Err(GpuError::Unsupported { what: label.to_owned(), format, purpose: "at all" });
        }
        let descriptor = wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: size[2] },
            mip_level_count: 1,
            sample_count: 1,
            dimension,
            format,
            usage,
            view_formats: &[],
        };
        let (texture, view) = self.guarded(label, || {
            let texture = self.device.create_texture(&descriptor);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            (texture, view)
        })?;
        Ok(Texture { texture, view, size, format, label: label.to_owned() })
    }

    fn check_size(&self, label: &str, size: [u32; 3], dimension: wgpu::TextureDimension) -> Result<(), GpuError> {
        if size.contains(&0) {
            let found = format!("{} x {} x {} texels", size[0], size[1], size[2]);
            return Err(GpuError::WrongSize {
                what: label.to_owned(),
                found,
                expected: "at least one texel a side".into(),
            });
        }
        let (limit, allowed) = match dimension {
            wgpu::TextureDimension::D3 => ("maxTextureDimension3D", self.limits.max_texture_dimension_3d),
            _ => ("maxTextureDimension2D", self.limits.max_texture_dimension_2d),
        };
        match size.into_iter().max() {
            Some(found) if found > allowed => Err(GpuError::OverLimit {
                what: format!("{label} ({} x {} x {} texels)", size[0], size[1], size[2]),
                limit,
                found: found.into(),
                unit: "texels along one side",
                allowed: allowed.into(),
            }),
            _ => Ok(()),
        }
    }

    /// Fills the whole texture. `bytes` are its texels, x fastest, without padding.
    pub fn upload(&self, target: &Texture, bytes: &[u8]) -> Result<(), GpuError> {
        if bytes.len() as u64 != target.bytes() {
            return Err(GpuError::WrongSize {
                what: target.label.clone(),
                found: format!("{} bytes of data", bytes.len()),
                expected: format!("{} bytes", target.bytes()),
            });
        }
        let slice_bytes = u64::from(target.size[0]) * u64::from(target.size[1]) * target.texel_bytes();
        let slices_at_once = (STAGING_BYTES / slice_bytes).clamp(1, u64::from(target.size[2])) as u32;
        let chunks = bytes.chunks(slice_bytes as usize * slices_at_once as usize);
        for (first, chunk) in (0..target.size[2]).step_by(slices_at_once as usize).zip(chunks) {
            self.upload_slices(target, first, chunk)?;
        }
        Ok(())
    }

    /// Fills whole slices of a texture from slice `first` on; as many as there are bytes for.
    pub fn upload_slices(&self, target: &Texture, first: u32, bytes: &[u8]) -> Result<(), GpuError> {
        let row_bytes = u64::from(target.size[0]) * target.texel_bytes();
        let slice_bytes = row_bytes * u64::from(target.size[1]);
        let slices = (bytes.len() as u64 / slice_bytes.max(1)) as u32;
        if u64::from(slices) * slice_bytes != bytes.len() as u64 || first + slices > target.size[2] {
            return Err(GpuError::WrongSize {
                what: target.label.clone(),
                found: format!("{} bytes for slices from {first} on", bytes.len()),
                expected: format!("whole slices of {slice_bytes} bytes, at most {}", target.size[2]),
            });
        }
        self.guarded(&target.label, || {
            self.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &target.texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: 0, y: 0, z: first },
                    aspect: wgpu::TextureAspect::All,
                },
                bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_bytes as u32),
                    rows_per_image: Some(target.size[1]),
                },
                wgpu::Extent3d { width: target.size[0], height: target.size[1], depth_or_array_layers: slices },
            );
            // Submitting lets the device take the staged bytes now instead of piling them up.
            self.queue.submit([]);
        })
    }

    /// Whether linear filtering works on textures of this format.
    pub fn filterable(&self, format: TextureFormat) -> bool {
        format
            .guaranteed_format_features(self.device.features())
            .flags
            .contains(wgpu::TextureFormatFeatureFlags::FILTERABLE)
    }
}
