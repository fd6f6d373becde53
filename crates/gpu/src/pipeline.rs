use std::collections::HashMap;
use std::hash::Hash;

use crate::{Gpu, GpuError};

/// Everything but the shader text that makes up a render pipeline.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RenderState {
    /// Entry point of the vertex stage.
    pub vertex: String,
    /// Entry point of the fragment stage.
    pub fragment: String,
    /// Vertex buffers in slot order.
    pub buffers: Vec<VertexLayout>,
    /// Topology, winding and culling.
    pub primitive: wgpu::PrimitiveState,
    /// Colour targets with format and blending.
    pub targets: Vec<wgpu::ColorTargetState>,
    /// Depth test, if any.
    pub depth: Option<wgpu::DepthStencilState>,
}

/// The layout of one vertex buffer.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct VertexLayout {
    /// Bytes from one vertex to the next.
    pub stride: u64,
    /// What a vertex holds.
    pub attributes: Vec<wgpu::VertexAttribute>,
}

/// How often a pipeline was found and how often it had to be compiled.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CacheCounts {
    /// Requests answered from the cache.
    pub hits: u64,
    /// Requests that compiled a pipeline.
    pub misses: u64,
}

/// Compiled pipelines by their WGSL text and entry point. Bind group layouts are derived from the text (`layout:
/// None`), so ask the pipeline for them. Failures are not kept: the same broken text is compiled again when asked for.
#[derive(Debug, Default)]
pub struct PipelineCache {
    modules: HashMap<String, wgpu::ShaderModule>,
    compute: HashMap<(String, String), wgpu::ComputePipeline>,
    render: HashMap<(String, RenderState), wgpu::RenderPipeline>,
    counts: CacheCounts,
}

impl PipelineCache {
    /// An empty cache.
    pub fn new() -> Self {
        Self::default()
    }

    /// The compute pipeline of `wgsl` at `entry_point`. `label` only names it in messages.
    /// Fails with the compiler's message (line and column) when the device refuses the text.
    pub fn compute(
        &mut self,
        gpu: &Gpu,
        label: &str,
        wgsl: &str,
        entry_point: &str,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let key = (wgsl.to_owned(), entry_point.to_owned());
        if let Some(pipeline) = self.compute.get(&key) {
            self.counts.hits += 1;
            return Ok(pipeline.clone());
        }
        self.counts.misses += 1;
        let module = self.module(gpu, label, wgsl)?;
        let pipeline = gpu.guarded(&format!("the shader of {label}"), || {
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: None,
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                cache: None,
            })
        })?;
        self.compute.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    /// The render pipeline of `wgsl` with `state`. `label` only names it in messages.
    /// Fails with the compiler's message (line and column) when the device refuses the text.
    pub fn render(
        &mut self,
        gpu: &Gpu,
        label: &str,
        wgsl: &str,
        state: &RenderState,
    ) -> Result<wgpu::RenderPipeline, GpuError> {
        let key = (wgsl.to_owned(), state.clone());
        if let Some(pipeline) = self.render.get(&key) {
            self.counts.hits += 1;
            return Ok(pipeline.clone());
        }
        self.counts.misses += 1;
        let module = self.module(gpu, label, wgsl)?;
        let pipeline =
            gpu.guarded(&format!("the shader of {label}"), || render_pipeline(gpu, label, &module, state))?;
        self.render.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    fn module(&mut self, gpu: &Gpu, label: &str, wgsl: &str) -> Result<wgpu::ShaderModule, GpuError> {
        if let Some(module) = self.modules.get(wgsl) {
            return Ok(module.clone());
        }
        let module = gpu.guarded(&format!("the shader of {label}"), || {
            gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(wgsl.into()),
            })
        })?;
        self.modules.insert(wgsl.to_owned(), module.clone());
        Ok(module)
    }

    /// How well reuse works.
    pub fn counts(&self) -> CacheCounts {
        self.counts
    }
}

fn render_pipeline(gpu: &Gpu, label: &str, module: &wgpu::ShaderModule, state: &RenderState) -> wgpu::RenderPipeline {
    let buffers: Vec<_> = state
        .buffers
        .iter()
        .map(|buffer| {
            Some(wgpu::VertexBufferLayout {
                array_stride: buffer.stride,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &buffer.attributes,
            })
        })
        .collect();
    let targets: Vec<_> = state.targets.iter().cloned().map(Some).collect();
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(&state.vertex),
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        primitive: state.primitive,
        depth_stencil: state.depth.clone(),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(&state.fragment),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
