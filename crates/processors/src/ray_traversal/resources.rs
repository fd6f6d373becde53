//! What the global variables of the ray loop are bound to: one table of names, purposes and how each thing is made.

use std::sync::Arc;

use bytemuck::bytes_of;
use rayloom_gpu::Texture;
use rayloom_gpu::wgpu;
use rayloom_network::ProcessError;
use rayloom_volume::ValueRange;

use super::dispatch::{Pass, Targets};
use super::frame::{Frame, Source};
use super::memory::Memory;
use super::{OUTPORTS, parameters, tables};
use crate::explain::{Explanation, Role, texture};
use crate::{Context, VolumeData};

/// A resource with what keeps it alive.
#[derive(Clone)]
pub(super) enum Resource {
    Texture(Arc<Texture>),
    Buffer(wgpu::Buffer),
    Sampler(wgpu::Sampler),
}

impl Resource {
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Texture(texture) => wgpu::BindingResource::TextureView(&texture.view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }

    /// What is bound to a global variable of the shader, and what for.
    pub fn explanation(&self, name: &str) -> Explanation {
        let purpose = row(name).map_or("the picture and its depth", |row| row.purpose);
        let bound = |what: &str| Explanation::new(Role::Bound, format!("{name}: {what}"), purpose);
        match self {
            // Render targets tell their memory where they are taken.
            Self::Texture(target) if name.starts_with("out") => bound(&texture(target)),
            Self::Texture(read) => bound(&texture(read)).bytes(read.bytes()),
            Self::Buffer(buffer) => bound("buffer").bytes(buffer.size()),
            Self::Sampler(_) => bound("linear filter"),
        }
    }
}

/// What resources are made from.
pub(super) struct Making<'a> {
    pub pass: &'a Pass<'a>,
    pub context: &'a Context,
    pub memory: &'a mut Memory,
    pub frame: &'a Frame,
    pub targets: &'a Targets,
}

type Made = Result<Resource, ProcessError>;

/// One global variable.
struct Row {
    name: &'static str,
    purpose: &'static str,
    make: fn(&mut Making<'_>) -> Made,
}

/// All that is not an output's.
const TABLE: [Row; 16] = [
    Row { name: "frame", purpose: "what all rays share: view, step, light", make: |making| making.frame() },
    Row { name: "source", purpose: "the volume's place, values and bricks", make: |making| making.source() },
    Row {
        name: "params",
        purpose: "numbers of the snippets; changing one assembles nothing",
        make: |making| making.parameters(),
    },
    Row { name: "volume", purpose: "what is sampled", make: |making| making.volume() },
    Row {
        name: "linear_sampler",
        purpose: "the sampling snippet leaves interpolation to the texture unit",
        make: |making| Ok(Resource::Sampler(linear_sampler(making))),
    },
    Row {
        name: "entry_points",
        purpose: "where rays begin",
        make: |making| Ok(Resource::Texture(making.pass.inputs.entry.color.clone())),
    },
    Row {
        name: "exit_points",
        purpose: "where rays end",
        make: |making| Ok(Resource::Texture(making.pass.inputs.exit.color.clone())),
    },
    Row {
        name: "transfer_table",
        purpose: "classification looks values up: emission and extinction per reference length",
        make: |making| making.transfer_table(),
    },
    Row {
        name: "transfer_table_2d",
        purpose: "classification looks values and gradient magnitudes up",
        make: |making| making.transfer_table_2d(),
    },
    Row {
        name: "preintegrated_table",
        purpose: "classification looks up pairs of values",
        make: |making| making.preintegrated(),
    },
    Row {
        name: "label_volume",
        purpose: "classification goes by labels",
        make: |making| Ok(Resource::Texture(making.labels().on_gpu(&making.context.gpu)?.texture.clone())),
    },
    Row { name: "label_table", purpose: "classification goes by labels", make: |making| making.label_table() },
    Row { name: "skip_map", purpose: "tells empty bricks", make: |making| making.skip_map() },
    Row {
        name: "gap_map",
        purpose: "tells voxels without a value, which are not drawn",
        make: |making| making.gap_map(),
    },
    Row {
        name: "counters",
        purpose: "samples are counted",
        make: |making| Ok(Resource::Buffer(making.context.gpu.storage("sample counters", &[0u32; 6])?)),
    },
    Row {
        name: "overrun",
        purpose: "loops of your own are watched",
        make: |making| Ok(Resource::Buffer(making.context.gpu.storage("overrun", &[0u32; 4])?)),
    },
];

fn row(name: &str) -> Option<&'static Row> {
    TABLE.iter().find(|row| row.name == name)
}

/// Whether something is written, and so no input of the loop.
pub(super) fn is_output(name: &str) -> bool {
    matches!(name, "counters" | "sample_map") || name.starts_with("out")
}

/// The error for a global variable that is not in the table.
pub(super) fn unknown(name: &str) -> ProcessError {
    ProcessError::new(format!(
        "the shader binds `{name}`, which the ray traversal does not provide; a snippet may bind only what its `reads` name"
    ))
}

impl Making<'_> {
    /// The resource behind a global variable of the shader.
    pub fn resource(&mut self, name: &str) -> Made {
        match row(name) {
            Some(row) => (row.make)(self),
            None => self.output(name),
        }
    }

    fn range(&self) -> ValueRange {
        self.pass.inputs.volume.volume.ranges()[self.pass.plan.channel as usize]
    }

    fn labels(&self) -> &VolumeData {
        self.pass.inputs.labels.unwrap_or(self.pass.inputs.volume)
    }

    fn frame(&mut self) -> Made {
        Ok(Resource::Buffer(self.context.gpu.buffer("frame", bytes_of(self.frame), wgpu::BufferUsages::UNIFORM)?))
    }

    fn source(&mut self) -> Made {
        let (pass, gpu) = (self.pass, &self.context.gpu);
        let mut source = Source::new(pass.inputs.view, &pass.inputs.volume.volume, self.range(), pass.job.properties)?;
        if !pass.reads("prefiltered") {
            let stored = pass.inputs.volume.on_gpu(gpu)?;
            (source.texel_scale, source.texel_offset) = (stored.scale, stored.offset);
        }
        if let Some(question) = &pass.plan.skipping {
            source.brick_scale = question.brick_scale();
        }
        if pass.reads("labels") {
            let labels = self.labels();
            let (stored, range) = (labels.on_gpu(gpu)?, labels.volume.ranges()[0]);
            source.label_minimum = (range.min + range.width() * f64::from(stored.offset[0])) as f32;
            source.label_span = (range.width() * f64::from(stored.scale[0])) as f32;
        }
        Ok(Resource::Buffer(gpu.buffer("source", bytes_of(&source), wgpu::BufferUsages::UNIFORM)?))
    }

    fn parameters(&mut self) -> Made {
        let bytes = parameters::bytes(self.pass.shader, self.pass.job.properties, self.range())?;
        Ok(Resource::Buffer(self.context.gpu.buffer("snippet parameters", &bytes, wgpu::BufferUsages::UNIFORM)?))
    }

    fn volume(&mut self) -> Made {
        let (pass, gpu) = (self.pass, &self.context.gpu);
        if pass.reads("prefiltered") {
            let volume = &pass.inputs.volume.volume;
            return Ok(Resource::Texture(self.memory.splines.texture(gpu, volume, pass.plan.channel)?));
        }
        Ok(Resource::Texture(pass.inputs.volume.on_gpu(gpu)?.texture.clone()))
    }

    fn transfer_table(&mut self) -> Made {
        let (gpu, range) = (&self.context.gpu, self.range());
        let function = self.pass.job.properties.transfer_function("transfer_function")?;
        let table = self.memory.table.get((function.clone(), range), || tables::table(gpu, function, range))?;
        Ok(Resource::Texture(table))
    }

    fn transfer_table_2d(&mut self) -> Made {
        let (gpu, range) = (&self.context.gpu, self.range());
        let function = self.pass.job.properties.transfer_function_2d("transfer_function_2d")?;
        let table = self.memory.table_2d.get((function.clone(), range), || tables::table_2d(gpu, function, range))?;
        Ok(Resource::Texture(table))
    }

    fn preintegrated(&mut self) -> Made {
        let (gpu, range) = (&self.context.gpu, self.range());
        let function = self.pass.job.properties.transfer_function("transfer_function")?;
        let length = self.pass.reads("preintegration_full").then_some(f64::from(self.frame.step));
        let key = (function.clone(), range, length);
        let make = || tables::preintegrated(gpu, function, range, length);
        Ok(Resource::Texture(self.memory.preintegrated.get(key, make)?))
    }

    fn label_table(&mut self) -> Made {
        let (gpu, range) = (&self.context.gpu, self.range());
        let table = self.pass.job.properties.labels("label_table")?;
        let table = self.memory.labels.get((table.clone(), range), || tables::labels(gpu, table, range))?;
        Ok(Resource::Texture(table))
    }

    fn skip_map(&mut self) -> Made {
        let question = self.pass.plan.skipping.as_ref().ok_or_else(|| unknown("skip_map"))?;
        let (skipping, splines) = (&mut self.memory.skipping, &mut self.memory.splines);
        Ok(Resource::Texture(question.texture(&self.context.gpu, skipping, splines)?))
    }

    fn gap_map(&mut self) -> Made {
        let volume = &self.pass.inputs.volume.volume;
        let gaps = self.memory.gaps.texture(&self.context.gpu, volume, self.pass.plan.channel)?;
        Ok(Resource::Texture(gaps.ok_or_else(|| unknown("gap_map"))?))
    }

    fn output(&self, name: &str) -> Made {
        if name == "sample_map" {
            return self.targets.samples.clone().map(Resource::Texture).ok_or_else(|| unknown(name));
        }
        let found = (0..OUTPORTS.len()).zip(&self.targets.outputs).find_map(|(index, target)| {
            let target = target.as_ref()?;
            match name.strip_prefix(&format!("out{}_", index + 1))? {
                "color" => Some(target.color.clone()),
                "depth" => Some(target.depth.clone()),
                _ => None,
            }
        });
        found.map(Resource::Texture).ok_or_else(|| unknown(name))
    }
}

fn linear_sampler(making: &Making<'_>) -> wgpu::Sampler {
    making.context.gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("linear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}
