//! Binds what the assembled shader uses and runs it.

use std::mem::offset_of;
use std::sync::Arc;

use bytemuck::bytes_of;
use rayloom_gpu::wgpu::{self, TextureFormat};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_network::{Job, ProcessError};
use rayloom_wgsl::{Diagnostic, Validated};
use serde_json::{Map, json};

use super::bands::Pace;
use super::choose::Plan;
use super::frame::Frame;
use super::memory::Memory;
use super::resources::{Making, Resource, is_output, unknown};
use super::snippets::shader_error;
use super::{Inputs, OUTPORTS};
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

/// What is drawn into, `None` for what nothing uses.
pub(super) struct Targets {
    pub outputs: [Option<Target>; OUTPORTS.len()],
    /// Samples of every ray.
    pub samples: Option<Arc<Texture>>,
}

/// What the shader notes in place of a loop's number where a ray was left before its end.
const CUT_RAY: u32 = u32::MAX;

/// What a run leaves behind.
pub(super) struct Drawn {
    pub targets: Targets,
    /// What the shader read, by the names of its global variables.
    pub inputs: Vec<(String, Resource)>,
    /// Rays, samples and contributing samples, when they were counted, and how many samples a ray may take.
    pub counted: Option<Map<String, serde_json::Value>>,
}

impl Pass<'_> {
    pub fn run(&self, context: &mut Context, memory: &mut Memory) -> Result<Drawn, ProcessError> {
        let targets = self.targets(context)?;
        let frame = self.frame()?;
        let bindings = &self.shader.interface.bindings;
        let mut resources = Vec::new();
        for field in bindings {
            let mut making = Making { pass: self, context, memory: &mut *memory, frame: &frame, targets: &targets };
            let resource = making.resource(&field.name)?;
            context.ledger.record(|| resource.explanation(&field.name));
            resources.push((field.name.clone(), resource));
        }
        self.traverse(context, &resources, &mut memory.pace)?;
        if context.ledger.is_enabled() {
            context.ledger.extend(self.explanations()?);
        }
        let buffer = |wanted: &str| {
            resources.iter().find_map(|(name, resource)| match resource {
                Resource::Buffer(buffer) if name == wanted => Some(buffer.clone()),
                _ => None,
            })
        };
        if let Some(overrun) = buffer("overrun") {
            self.check_loops(&context.gpu, &overrun)?;
        }
        let most = self.most_samples()?;
        let counted = buffer("counters").map(|counters| counts(&context.gpu, &counters, most)).transpose()?;
        // Targets go back to the pool when nobody shows them any more.
        resources.retain(|(name, _)| !is_output(name));
        Ok(Drawn { targets, inputs: resources, counted })
    }

    /// How many samples a ray may take.
    fn most_samples(&self) -> Result<u32, ProcessError> {
        let chosen = self.job.properties.int("max_samples")?.clamp(1, super::declare::MOST_SAMPLES) as u32;
        Ok(chosen.min(self.plan.most_samples.unwrap_or(u32::MAX)))
    }

    fn frame(&self) -> Result<Frame, ProcessError> {
        Frame::new(self.inputs.view, &self.inputs.volume.volume, self.job.properties, self.most_samples()?)
    }

    /// Whether a word of the declarations is read.
    pub fn reads(&self, word: &str) -> bool {
        self.shader.assembled.features.has(word)
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
        let at = match number {
            CUT_RAY => 0,
            0 => return Ok(()),
            number => number as usize - 1,
        };
        let Some((file, line, column)) = assembled.loops.get(at) else { return Ok(()) };
        let message = match number {
            CUT_RAY => {
                "the driver ended rays before they had come to their end, since all loops of a ray together took too many \
                 rounds; give this loop fewer rounds, or the rays longer steps (sampling rate)"
            }
            _ => {
                "this loop did not end: it took more than 32768 rounds at once, or all loops of a ray more than 1048576; \
                 give it a bound that it reaches"
            }
        };
        Err(shader_error(vec![Diagnostic {
            file: file.to_string(),
            line: *line,
            column: *column,
            message: message.into(),
            excerpt: String::new(),
        }]))
    }

    /// Colour and depth textures of the outputs in use.
    fn targets(&self, context: &mut Context) -> Result<Targets, ProcessError> {
        let format =
            if self.plan.choice.half_targets { TextureFormat::Rgba16Float } else { TextureFormat::Rgba32Float };
        let mut outputs: [Option<Target>; OUTPORTS.len()] = Default::default();
        let used = self.plan.choice.outputs.iter().flatten().count() as u32;
        let most = context.gpu.limits.max_storage_textures_per_shader_stage;
        let needed = 2 * used + u32::from(self.plan.choice.sample_map);
        if needed > most {
            return Err(ProcessError::new(format!(
                "the outputs in use need {needed} storage textures, but this device allows {most} (maxStorageTexturesPerShaderStage); use fewer outputs of this ray traversal"
            )));
        }
        for (index, target) in outputs.iter_mut().enumerate() {
            if self.plan.choice.outputs[index].is_some() {
                let color = context.target(OUTPORTS[index], self.inputs.view.size, format)?;
                let depth = context.depth_target("view depth", self.inputs.view.size)?;
                *target = Some(Target { color, depth });
            }
        }
        let samples = self.plan.choice.sample_map.then(|| context.color_target(super::SAMPLES, self.inputs.view.size));
        Ok(Targets { outputs, samples: samples.transpose()? })
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

fn counts(gpu: &Gpu, counters: &wgpu::Buffer, most: u32) -> Result<Map<String, serde_json::Value>, GpuError> {
    let bytes = gpu.read_buffer(counters)?;
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
    let wide = |slot: usize| u64::from(words[slot]) | u64::from(words[slot + 1]) << 32;
    let named = [("rays", wide(0)), ("samples", wide(2)), ("contributing", wide(4)), ("most_samples", most.into())];
    Ok(named.into_iter().map(|(name, count)| (name.to_owned(), json!(count))).collect())
}
