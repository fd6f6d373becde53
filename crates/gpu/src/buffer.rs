use bytemuck::Pod;

use crate::{Gpu, GpuError};

impl Gpu {
    /// A uniform buffer that holds `value`.
    pub fn uniform<T: Pod>(&self, label: &str, value: &T) -> Result<wgpu::Buffer, GpuError> {
        self.buffer(label, bytemuck::bytes_of(value), wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST)
    }

    /// A storage buffer that holds `values`; never empty, since a binding must not be.
    pub fn storage<T: Pod>(&self, label: &str, values: &[T]) -> Result<wgpu::Buffer, GpuError> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        self.buffer(label, bytemuck::cast_slice(values), usage)
    }

    /// A buffer that holds `bytes`, padded with zeros to a multiple of 16 (at least 16).
    /// Fails with the name of the limit when it would be too large for the device or for a binding.
    pub fn buffer(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
        self.check_buffer(label, bytes.len() as u64, usage)?;
        let padding = bytes.len().max(1).next_multiple_of(16) - bytes.len();
        let padded;
        let contents = if padding == 0 {
            bytes
        } else {
            padded = [bytes, &vec![0; padding]].concat();
            &padded
        };
        self.guarded(label, || {
            // Not made mapped, as that panics where there is no memory or no device any more.
            let usage = usage | wgpu::BufferUsages::COPY_DST;
            let size = contents.len() as u64;
            let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
            let buffer = self.device.create_buffer(&descriptor);
            self.queue.write_buffer(&buffer, 0, contents);
            buffer
        })
    }

    pub(crate) fn check_buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<(), GpuError> {
        let limits = &self.limits;
        let mut bounds = vec![("maxBufferSize", limits.max_buffer_size)];
        if usage.contains(wgpu::BufferUsages::UNIFORM) {
            bounds.push(("maxUniformBufferBindingSize", limits.max_uniform_buffer_binding_size));
        }
        if usage.contains(wgpu::BufferUsages::STORAGE) {
            bounds.push(("maxStorageBufferBindingSize", limits.max_storage_buffer_binding_size));
        }
        for (limit, allowed) in bounds {
            if bytes > allowed {
                return Err(GpuError::OverLimit {
                    what: label.to_owned(),
                    limit,
                    found: bytes,
                    unit: "bytes",
                    allowed,
                });
            }
        }
        Ok(())
    }
}
