//! Binds what the assembled shader uses and runs it.

use std::mem::offset_of;
use std::sync::Arc;

use bytemuck::bytes_of;
use rayloom_gpu::wgpu::{self, TextureFormat};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_network::{Job, ProcessError};
use rayloom_volume::ValueRange;
use rayloom_wgsl::{Diagnostic, Validated};
use serde_json::{Map, json};

use super::bands::Pace;
use super::choose::Plan;
use super::explain::purpose;
use super::frame::{Frame, reference_length};
use super::memory::Memory;
use super::snippets::shader_error;
use super::{Inputs, OUTPORTS, parameters, tables};
use crate::explain::{Explanation, Role, texture};
use crate::{Context, Data};

/// Side of a workgroup; the skeleton says `@workgroup_size(8, 8)`.
const GROUP: u32 = 8;

/// One run of the shader.
pub(super) struct Pass<'a> {
    pub job: &'a Job<'a, Data>,
    pub inputs: &'a Inputs<'a>,
    pub plan: &'a Plan<'a>,
    pub shader: &'a Validated,
}

/// What an output is drawn into.
pub(super) struct Target {
    pub color: Arc<Texture>,
    pub depth: Arc<Texture>,
}

/// The targets of the outputs, `None` for those that nothing uses.
pub(super) type Targets = [Option<Target>; OUTPORTS.len()];

/// What a run leaves behind.
pub(super) struct Drawn {
    pub targets: Targets,
    /// Samples of every ray, when they are wanted.
    pub samples: Option<Arc<Texture>>,
    /// What the shader read, by the names of its global variables.
    pub inputs: Vec<(String, Resource)>,
    /// Rays, samples and contributing samples, when they were counted, and how many samples a ray may take.
    pub counted: Option<Map<String, serde_json::Value>>,
}

/// A resource with what keeps it alive.
#[derive(Clone)]
pub(super) enum Resource {
    Texture(Arc<Texture>),
    Buffer(wgpu::Buffer),
    Sampler(wgpu::Sampler),
}

impl Resource {
    /// What is bound to a global variable of the shader, and what for.
    fn explanation(&self, name: &str) -> Explanation {
        let bound = |what: &str| Explanation::new(Role::Bound, format!("{name}: {what}"), purpose(name));
        match self {
            // Render targets tell their memory where they are taken.
            Self::Texture(target) if name.starts_with("out") => bound(&texture(target)),
            Self::Texture(read) => bound(&texture(read)).bytes(read.bytes()),
            Self::Buffer(buffer) => bound("buffer").bytes(buffer.size()),
            Self::Sampler(_) => bound("linear filter"),
        }
    }

    fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Texture(texture) => wgpu::BindingResource::TextureView(&texture.view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

impl Pass<'_> {
    pub fn run(&self, context: &mut Context, memory: &mut Memory) -> Result<Drawn, ProcessError> {
        let targets = self.targets(context)?;
        let counters = self.counters(&context.gpu)?;
        let samples = self.samples(context)?;
        // The number of a loop of the user's that ran for too long.
        let overrun = self.reads("bounded").then(|| context.gpu.storage("overrun", &[0u32; 4])).transpose()?;
        let frame = self.frame(&context.gpu)?;
        let bindings = &self.shader.interface.bindings;
        let mut resources = bindings
            .iter()
            .map(|field| {
                let resource = match (field.name.as_str(), &counters, &samples, &overrun) {
                    ("counters", Some(counters), ..) => Resource::Buffer(counters.clone()),
                    ("overrun", _, _, Some(overrun)) => Resource::Buffer(overrun.clone()),
                    ("sample_map", _, Some(samples), _) => Resource::Texture(samples.clone()),
                    (name, ..) => self.resource(name, context, memory, &frame, &targets)?,
                };
                context.ledger.record(|| resource.explanation(&field.name));
                Ok((field.name.clone(), resource))
            })
            .collect::<Result<Vec<_>, ProcessError>>()?;
        self.traverse(context, &resources, &mut memory.pace)?;
        if context.ledger.is_enabled() {
            context.ledger.extend(self.explanations()?);
        }
        if let Some(overrun) = overrun.filter(|_| bindings.iter().any(|field| field.name == "overrun")) {
            self.check_loops(&context.gpu, &overrun)?;
        }
        let counted = counters.map(|counters| counts(&context.gpu, &counters, frame.max_samples)).transpose()?;
        // Targets go back to the pool when nobody shows them any more.
        resources.retain(|(name, _)| name != "counters" && name != "sample_map" && !name.starts_with("out"));
        Ok(Drawn { targets, samples, inputs: resources, counted })
    }

    /// Runs the shader on the whole picture, band by band.
    fn traverse(
        &self,
        context: &mut Context,
        resources: &[(String, Resource)],
        pace: &mut Pace,
    ) -> Result<(), ProcessError> {
        let label = format!("ray traversal `{}`", self.job.id);
        let bound = Bound::new(context, &label, self.shader, resources)?;
        let frame = resources.iter().find_map(|(name, resource)| match resource {
            Resource::Buffer(buffer) if name == "frame" => Some(buffer),
            _ => None,
        });
        let [width, _] = self.inputs.view.size;
        pace.in_bands(self.inputs.view.size, GROUP, |rows| {
            if context.interrupted() {
                return Err(ProcessError::new("interrupted"));
            }
            if let Some(frame) = frame {
                let place = offset_of!(Frame, first_row) as u64;
                context.gpu.queue.write_buffer(frame, place, bytes_of(&rows.start));
            }
            let groups = [width, rows.len() as u32].map(|pixels| pixels.div_ceil(GROUP));
            bound.submit(&context.gpu, groups, context.timer.compute_pass())?;
            Ok(context.gpu.wait(&label)?)
        })
    }

    /// Fails when a loop of the user's own snippets did not end. Waits for the device, which is why it is asked of no others.
    fn check_loops(&self, gpu: &Gpu, overrun: &wgpu::Buffer) -> Result<(), ProcessError> {
        let bytes = gpu.read_buffer(overrun)?;
        let number = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let assembled = &self.shader.assembled;
        let Some((file, line, column)) = (number as usize).checked_sub(1).and_then(|at| assembled.loops.get(at)) else {
            return Ok(());
        };
        Err(shader_error(vec![Diagnostic {
            file: file.to_string(),
            line: *line,
            column: *column,
            message: "this loop did not end: it took more than 32768 rounds at once, or all loops of a ray more than 1048576; \
                      give it a bound that it reaches"
                .into(),
            excerpt: String::new(),
        }]))
    }

    /// Colour and depth textures of the outputs in use.
    fn targets(&self, context: &mut Context) -> Result<Targets, ProcessError> {
        let format =
            if self.plan.choice.half_targets { TextureFormat::Rgba16Float } else { TextureFormat::Rgba32Float };
        let mut targets = Targets::default();
        let used = self.plan.choice.outputs.iter().flatten().count() as u32;
        let most = context.gpu.limits.max_storage_textures_per_shader_stage;
        let needed = 2 * used + u32::from(self.plan.choice.sample_map);
        if needed > most {
            return Err(ProcessError::new(format!(
                "the outputs in use need {needed} storage textures, but this device allows {most} (maxStorageTexturesPerShaderStage); use fewer outputs of this ray traversal"
            )));
        }
        for (index, target) in targets.iter_mut().enumerate() {
            if self.plan.choice.outputs[index].is_some() {
                let color = context.target(OUTPORTS[index], self.inputs.view.size, format)?;
                let depth = context.depth_target("view depth", self.inputs.view.size)?;
                *target = Some(Target { color, depth });
            }
        }
        Ok(targets)
    }

    fn counters(&self, gpu: &Gpu) -> Result<Option<wgpu::Buffer>, GpuError> {
        self.plan.choice.statistics.then(|| gpu.storage("sample counters", &[0u32; 6])).transpose()
    }

    fn samples(&self, context: &mut Context) -> Result<Option<Arc<Texture>>, GpuError> {
        let size = self.inputs.view.size;
        self.plan.choice.sample_map.then(|| context.color_target(super::SAMPLES, size)).transpose()
    }

    fn range(&self) -> ValueRange {
        self.inputs.volume.volume.ranges()[self.plan.channel as usize]
    }

    fn reads(&self, word: &str) -> bool {
        self.shader.assembled.features.has(word)
    }

    fn frame(&self, gpu: &Gpu) -> Result<Frame, ProcessError> {
        let volume = &self.inputs.volume.volume;
        let mut frame = Frame::new(self.inputs.view, volume, self.range(), self.job.properties)?;
        if !self.reads("prefiltered") {
            let stored = self.inputs.volume.on_gpu(gpu)?;
            (frame.texel_scale, frame.texel_offset) = (stored.scale, stored.offset);
        }
        frame.max_samples = frame.max_samples.min(self.plan.most_samples.unwrap_or(u32::MAX));
        if let Some(question) = &self.plan.skipping {
            frame.brick_scale = question.brick_scale();
        }
        if self.reads("labels") {
            let labels = self.inputs.labels.unwrap_or(self.inputs.volume);
            let (stored, range) = (labels.on_gpu(gpu)?, labels.volume.ranges()[0]);
            frame.label_minimum = (range.min + range.width() * f64::from(stored.offset[0])) as f32;
            frame.label_span = (range.width() * f64::from(stored.scale[0])) as f32;
        }
        Ok(frame)
    }

    /// The resource behind a global variable of the shader.
    fn resource(
        &self,
        name: &str,
        context: &Context,
        memory: &mut Memory,
        frame: &Frame,
        targets: &Targets,
    ) -> Result<Resource, ProcessError> {
        let gpu = &context.gpu;
        let properties = self.job.properties;
        let range = self.range();
        let function = properties.transfer_function("transfer_function")?;
        Ok(match name {
            "frame" => Resource::Buffer(gpu.buffer("frame", bytes_of(frame), wgpu::BufferUsages::UNIFORM)?),
            "params" => {
                let bytes = parameters::bytes(self.shader, properties, range)?;
                Resource::Buffer(gpu.buffer("snippet parameters", &bytes, wgpu::BufferUsages::UNIFORM)?)
            }
            "volume" if self.reads("prefiltered") => {
                Resource::Texture(memory.splines.texture(gpu, &self.inputs.volume.volume, self.plan.channel)?)
            }
            "volume" => Resource::Texture(self.inputs.volume.on_gpu(gpu)?.texture.clone()),
            "linear_sampler" => Resource::Sampler(linear_sampler(gpu)),
            "entry_points" => Resource::Texture(self.inputs.entry.color.clone()),
            "exit_points" => Resource::Texture(self.inputs.exit.color.clone()),
            "transfer_table" => {
                Resource::Texture(memory.table.get((function.clone(), range), || tables::table(gpu, function, range))?)
            }
            "transfer_table_2d" => {
                let function = properties.transfer_function_2d("transfer_function_2d")?;
                Resource::Texture(
                    memory.table_2d.get((function.clone(), range), || tables::table_2d(gpu, function, range))?,
                )
            }
            "preintegrated_table" => {
                let length = self.reads("preintegration_full").then(|| self.segment_length()).transpose()?;
                let key = (function.clone(), range, length);
                Resource::Texture(
                    memory.preintegrated.get(key, || tables::preintegrated(gpu, function, range, length))?,
                )
            }
            "label_volume" => {
                let labels = self.inputs.labels.unwrap_or(self.inputs.volume);
                Resource::Texture(labels.on_gpu(gpu)?.texture.clone())
            }
            "label_table" => {
                let table = properties.labels("label_table")?;
                Resource::Texture(memory.labels.get((table.clone(), range), || tables::labels(gpu, table, range))?)
            }
            "skip_map" => match &self.plan.skipping {
                Some(question) => {
                    Resource::Texture(question.texture(gpu, &mut memory.skipping, &mut memory.splines)?)
                }
                None => return Err(unknown(name)),
            },
            "gap_map" => {
                let volume = &self.inputs.volume.volume;
                let gaps = memory.gaps.texture(gpu, volume, self.plan.channel)?;
                Resource::Texture(gaps.ok_or_else(|| unknown(name))?)
            }
            _ => self.output(name, targets)?,
        })
    }

    fn output(&self, name: &str, targets: &Targets) -> Result<Resource, ProcessError> {
        let found = (0..).zip(targets).find_map(|(index, target)| {
            let target = target.as_ref()?;
            match name.strip_prefix(&format!("out{}_", index + 1))? {
                "color" => Some(target.color.clone()),
                "depth" => Some(target.depth.clone()),
                _ => None,
            }
        });
        found.map(Resource::Texture).ok_or_else(|| unknown(name))
    }

    /// Length of one step in reference lengths; along the mean direction where the voxels are not cubes.
    fn segment_length(&self) -> Result<f64, ProcessError> {
        let volume = &self.inputs.volume.volume;
        let rate = self.job.properties.f64("sampling_rate")?;
        Ok(super::frame::mean_spacing(volume) / rate / reference_length(volume, self.job.properties)?)
    }
}

/// A shader with everything that it reads and writes.
pub(super) struct Bound<'a> {
    label: &'a str,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

impl<'a> Bound<'a> {
    /// Binds resources given by the names of the shader's global variables.
    ///
    /// # Errors
    /// The shader binds something that is not among them; the device refuses.
    pub fn new(
        context: &mut Context,
        label: &'a str,
        shader: &Validated,
        resources: &[(String, Resource)],
    ) -> Result<Self, ProcessError> {
        let entries = shader.interface.bindings.iter().map(|field| {
            let (_, resource) =
                resources.iter().find(|(name, _)| *name == field.name).ok_or_else(|| unknown(&field.name))?;
            Ok(wgpu::BindGroupEntry { binding: field.binding, resource: resource.binding() })
        });
        let entries = entries.collect::<Result<Vec<_>, ProcessError>>()?;
        let pipeline = context.pipelines.compute(&context.gpu, label, &shader.assembled.text, "traverse")?;
        let group = context.gpu.guarded(label, || {
            context.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(label),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            })
        })?;
        Ok(Self { label, pipeline, group })
    }

    /// Submits one run of so many workgroups.
    ///
    /// # Errors
    /// The device refuses.
    pub fn submit(
        &self,
        gpu: &Gpu,
        groups: [u32; 2],
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) -> Result<(), GpuError> {
        gpu.guarded(self.label, || {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(self.label), timestamp_writes });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(groups[0], groups[1], 1);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        })
    }
}

fn unknown(name: &str) -> ProcessError {
    ProcessError::new(format!(
        "the shader binds `{name}`, which the ray traversal does not provide; a snippet may bind only what its `reads` name"
    ))
}

fn linear_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("linear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

fn counts(gpu: &Gpu, counters: &wgpu::Buffer, most: u32) -> Result<Map<String, serde_json::Value>, GpuError> {
    let bytes = gpu.read_buffer(counters)?;
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
    let wide = |slot: usize| u64::from(words[slot]) | u64::from(words[slot + 1]) << 32;
    let named = [("rays", wide(0)), ("samples", wide(2)), ("contributing", wide(4)), ("most_samples", most.into())];
    Ok(named.into_iter().map(|(name, count)| (name.to_owned(), json!(count))).collect())
}
