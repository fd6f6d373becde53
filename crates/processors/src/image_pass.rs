//! Small full-screen computations: one invocation a pixel, in workgroups of 8 x 8.

use rayloom_gpu::wgpu;
use rayloom_gpu::{GpuError, Texture};

use crate::explain::{Explanation, Role};
use crate::{Context, plain_shader};

/// Side of a workgroup; the shaders say `@workgroup_size(8, 8)`.
const GROUP: u32 = 8;

/// What is bound to one binding of group 0.
#[derive(Clone, Copy)]
pub enum Bind<'a> {
    /// The bytes of a uniform.
    Uniform(&'a [u8]),
    /// A texture to read or to write.
    Texture(&'a Texture),
    /// A buffer.
    Buffer(&'a wgpu::Buffer),
    /// A sampler.
    Sampler(&'a wgpu::Sampler),
}

/// One computation for every pixel of an image.
pub struct ImagePass<'a> {
    /// What it is, for messages.
    pub label: &'a str,
    /// Path of its shader in the library.
    pub shader: &'static str,
    /// Flags that are set for `#if` in it.
    pub flags: &'static [&'static str],
    /// Its entry point, with workgroups of 8 x 8.
    pub entry_point: &'a str,
    /// Group 0: binding 0, 1, ... All of them must occur in the shader.
    pub bindings: &'a [Bind<'a>],
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl Context {
    /// Runs a computation for every pixel; its time is measured if that is switched on.
    pub fn run_image_pass(&mut self, pass: &ImagePass<'_>) -> Result<(), GpuError> {
        self.ledger.record(|| {
            let [width, height] = pass.size;
            Explanation::new(Role::Computed, format!("{} at {width} x {height} pixels", pass.label), "one pass")
        });
        let gpu = &self.gpu;
        let pipeline =
            self.pipelines.compute(gpu, pass.label, &plain_shader(pass.shader, pass.flags), pass.entry_point)?;
        let uniforms = pass
            .bindings
            .iter()
            .map(|binding| match binding {
                Bind::Uniform(bytes) => gpu.buffer(pass.label, bytes, wgpu::BufferUsages::UNIFORM).map(Some),
                _ => Ok(None),
            })
            .collect::<Result<Vec<_>, _>>()?;
        gpu.guarded(pass.label, || {
            let resources =
                pass.bindings.iter().zip(&uniforms).map(|(binding, uniform)| resource(binding, uniform.as_ref()));
            let entries: Vec<_> = (0..)
                .zip(resources)
                .filter_map(|(binding, resource)| Some(wgpu::BindGroupEntry { binding, resource: resource? }))
                .collect();
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(pass.label),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(pass.label),
                timestamp_writes: self.timer.compute_pass(),
            });
            compute.set_pipeline(&pipeline);
            compute.set_bind_group(0, &group, &[]);
            compute.dispatch_workgroups(pass.size[0].div_ceil(GROUP), pass.size[1].div_ceil(GROUP), 1);
            drop(compute);
            gpu.queue.submit([encoder.finish()]);
        })
    }
}

fn resource<'a>(binding: &Bind<'a>, uniform: Option<&'a wgpu::Buffer>) -> Option<wgpu::BindingResource<'a>> {
    Some(match binding {
        Bind::Uniform(_) => uniform?.as_entire_binding(),
        Bind::Texture(texture) => wgpu::BindingResource::TextureView(&texture.view),
        Bind::Buffer(buffer) => buffer.as_entire_binding(),
        Bind::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
    })
}
