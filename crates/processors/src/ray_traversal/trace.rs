//! The ray probe: one ray of the last run again, with a note of every sample.
//!
//! The very snippets, parameters and textures of the picture are used; only the shader's text has the notes added.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable, bytes_of, pod_read_unaligned};
use glam::{DAffine3, DVec3, Vec3};
use rayloom_gpu::wgpu::BufferUsages;
use rayloom_network::{Job, ProcessError};
use rayloom_volume::ValueRange;
use rayloom_wgsl::{Checked, Choice, Library, Skeleton};

use super::choose::Plan;
use super::dispatch::Bound;
use super::frame::reference_length;
use super::long_rays::most_steps;
use super::memory::{Memory, shader};
use super::resources::Resource;
use super::{Inputs, OUTPORTS};
use crate::Data;
use crate::process::Runner;

/// Samples noted at most: 3.5 MiB of them.
const CAPACITY: u32 = 1 << 15;

/// One ray as a traversal walked it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Column and row of its pixel, from the upper left.
    pub pixel: [u32; 2],
    /// Size of the picture, pixels.
    pub size: [u32; 2],
    /// Length of the ray between entry and exit, world units; 0 when it misses the volume.
    pub length: f64,
    /// Samples on the whole ray, taken or not.
    pub count: u32,
    /// Samples taken: fewer where some were skipped or the ray was left early.
    pub taken: u32,
    /// Whether the ray was left because nothing further could matter.
    pub stopped: bool,
    /// The samples taken, in their order; not more than 32768 of them.
    pub samples: Vec<TraceSample>,
    /// The outputs in use.
    pub outputs: Vec<TraceOutput>,
    /// Values that 0 and 1 stand for in the shader.
    pub range: ValueRange,
    /// The length to which extinctions refer, world units.
    pub reference_length: f64,
}

/// One sample of a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceSample {
    /// Its number on the ray, from 0; gaps are samples that were skipped.
    pub index: u32,
    /// Distance from the entry point, world units.
    pub distance: f64,
    /// Where its segment begins, distance from the entry point in world units.
    pub start: f64,
    /// Length of its segment, world units.
    pub length: f64,
    /// World coordinates.
    pub position: [f64; 3],
    /// The value, in the volume's own unit.
    pub value: f64,
    /// Magnitude of the gradient, value a world unit, when the shader reads gradients.
    pub gradient: Option<f64>,
    /// (colour times extinction, extinction a reference length), when anything classifies samples.
    pub classified: Option<[f32; 4]>,
    /// The same with the light on it, when there is shading.
    pub shaded: Option<[f32; 4]>,
    /// What each output in use would be if the ray ended behind this sample: premultiplied colour.
    pub accumulated: Vec<[f32; 4]>,
}

/// What a ray came to.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceOutput {
    /// The outport.
    pub outport: &'static str,
    /// The pixel: premultiplied colour.
    pub color: [f32; 4],
    /// Distance from the entry point to the place whose depth the pixel has, world units, if any.
    pub place: Option<f64>,
}

impl Trace {
    /// Why there are no samples to see, when there are none.
    pub fn absence(&self) -> Option<&'static str> {
        match (self.count, self.taken) {
            (0, _) => Some("The ray of this pixel misses the volume, or what clipping leaves of it."),
            (_, 0) => Some("Every sample of this ray was skipped: nothing on it can be visible."),
            _ => None,
        }
    }

    /// Samples that were taken but not noted, for want of room.
    pub fn truncated(&self) -> u32 {
        self.taken - self.samples.len() as u32
    }
}

/// What a run rendered, for looking at one of its rays later.
pub(super) struct LastRun {
    library: Arc<Library>,
    checked: Checked,
    used: [bool; OUTPORTS.len()],
    resources: Vec<(String, Resource)>,
    size: [u32; 2],
    texture_to_world: DAffine3,
    range: ValueRange,
    spacing: f64,
    reference_length: f64,
    /// Samples that the longest ray takes.
    longest: u32,
}

impl LastRun {
    pub fn new(
        job: &Job<'_, Data>,
        inputs: &Inputs<'_>,
        plan: Plan<'_>,
        resources: Vec<(String, Resource)>,
    ) -> Result<Self, ProcessError> {
        let volume = &inputs.volume.volume;
        let longest = most_steps(inputs.view, volume, job.properties)?;
        let used = plan.choice.outputs.each_ref().map(Option::is_some);
        // Every sample is noted, not only those that a search finds.
        let choice = Choice { statistics: false, sample_map: false, search: false, ..plan.choice };
        let checked = choice.check(&plan.library).map_err(|problems| {
            ProcessError::new(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
        })?;
        Ok(Self {
            library: plan.library,
            checked,
            used,
            resources,
            size: inputs.view.size,
            texture_to_world: volume.texture_to_world(),
            range: volume.ranges()[plan.channel as usize],
            spacing: volume.mean_spacing(),
            reference_length: reference_length(volume, job.properties)?,
            longest: longest.ceil().clamp(1.0, f64::from(CAPACITY)) as u32 + 1,
        })
    }

    fn used_outports(&self) -> impl Iterator<Item = (usize, &'static str)> {
        OUTPORTS.into_iter().enumerate().filter(|(index, _)| self.used[*index])
    }
}

/// Mirrors the head of `Trace` in `shaders/traversal/trace.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
struct Head {
    pixel: [u32; 2],
    taken: u32,
    stopped: u32,
    origin: [f32; 3],
    first: u32,
    direction: [f32; 3],
    last: u32,
    begin: f32,
    end: f32,
    step: f32,
    shift: f32,
    results: [[f32; 4]; 3],
    places: [f32; 4],
}

/// Mirrors `Traced` in `shaders/traversal/trace.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
struct Traced {
    index: u32,
    distance: f32,
    length: f32,
    value: f32,
    gradient: [f32; 4],
    classified: [f32; 4],
    shaded: [f32; 4],
    accumulated: [[f32; 4]; 3],
}

impl Runner {
    /// The ray of a pixel (column and row, from the upper left) as the ray traversal with this id walked it in its last run.
    ///
    /// Waits for the device.
    ///
    /// # Errors
    /// The traversal has not run, or its last run failed; the pixel is outside of its picture; the device refuses.
    pub fn trace(&mut self, id: &str, pixel: [u32; 2]) -> Result<Trace, ProcessError> {
        let mut memory: Memory = self.context.take_state(id);
        let Some(run) = memory.last_run.take() else {
            self.context.put_state(id, memory);
            return Err(ProcessError::new(format!(
                "`{id}` has no picture whose rays could be looked at: it is no ray traversal, was not needed, or failed"
            )));
        };
        let result = self.follow(&run, &mut memory, pixel);
        memory.last_run = Some(run);
        self.context.put_state(id, memory);
        result
    }

    fn follow(&mut self, run: &LastRun, memory: &mut Memory, pixel: [u32; 2]) -> Result<Trace, ProcessError> {
        let [width, height] = run.size;
        if pixel[0] >= width || pixel[1] >= height {
            let [x, y] = pixel;
            return Err(ProcessError::new(format!("there is no pixel {x},{y} in a picture of {width} x {height}")));
        }
        let shader = shader(&mut memory.tracing, &run.library, &Skeleton::PROBE, &run.checked)?;
        let head = Head { pixel, ..Head::default() };
        let mut bytes = bytes_of(&head).to_vec();
        bytes.resize(size_of::<Head>() + run.longest.min(CAPACITY) as usize * size_of::<Traced>(), 0);
        let context = &mut self.context;
        let buffer = context.gpu.buffer("ray probe", &bytes, BufferUsages::STORAGE | BufferUsages::COPY_SRC)?;
        let mut resources = run.resources.clone();
        resources.push(("trace".into(), Resource::Buffer(buffer.clone())));
        Bound::new(context, "ray probe", &shader, &resources)?.submit(&context.gpu, [1, 1], None)?;
        let bytes = context.gpu.read_buffer(&buffer)?;
        let (head, rest) = bytes.split_at(size_of::<Head>());
        let head: Head = pod_read_unaligned(head);
        let traced = rest.chunks_exact(size_of::<Traced>()).take(head.taken as usize).map(pod_read_unaligned);
        let features = &shader.assembled.features;
        let classified = ["medium", "medium_at", "classify_value"].iter().any(|flag| features.has(flag));
        let reads = Reads {
            gradient: features.has("gradient"),
            classified,
            shaded: classified && features.has("shading"),
            behind: if features.has("segment_ends") { 1.0 } else { 0.5 },
        };
        Ok(run.trace(&head, traced, reads))
    }
}

/// Which parts of a sample the shader computes.
#[derive(Clone, Copy)]
struct Reads {
    gradient: bool,
    classified: bool,
    shaded: bool,
    /// The share of its segment that lies before a sample.
    behind: f64,
}

impl LastRun {
    /// What the shader noted, in the units of the world and the volume.
    fn trace(&self, head: &Head, traced: impl Iterator<Item = Traced>, reads: Reads) -> Trace {
        let point = |point: [f32; 3]| Vec3::from(point).as_dvec3();
        let (origin, direction) = (point(head.origin), point(head.direction));
        // Distances on the ray, reference lengths, as distances from the entry point, world units.
        let from_entry = |distance: f32| f64::from(distance - head.begin) * self.reference_length;
        let sample = |traced: Traced| {
            let position = self.texture_to_world.transform_point3(origin + direction * f64::from(traced.distance));
            let length = f64::from(traced.length) * self.reference_length;
            let [x, y, z, _] = traced.gradient.map(f64::from);
            TraceSample {
                index: traced.index - head.first,
                distance: from_entry(traced.distance),
                start: from_entry(traced.distance) - length * reads.behind,
                length,
                position: position.into(),
                value: self.range.denormalise(f64::from(traced.value)),
                gradient: reads.gradient.then(|| DVec3::new(x, y, z).length() * self.range.width() / self.spacing),
                classified: reads.classified.then_some(traced.classified),
                shaded: reads.shaded.then_some(traced.shaded),
                accumulated: self.used_outports().map(|(output, _)| traced.accumulated[output]).collect(),
            }
        };
        let output = |(output, outport): (usize, &'static str)| TraceOutput {
            outport,
            color: head.results[output],
            place: (head.places[output] >= 0.0).then(|| from_entry(head.places[output])),
        };
        Trace {
            pixel: head.pixel,
            size: self.size,
            length: if head.last > head.first { from_entry(head.end) } else { 0.0 },
            count: head.last - head.first,
            taken: head.taken,
            stopped: head.stopped != 0,
            samples: traced.map(sample).collect(),
            outputs: self.used_outports().map(output).collect(),
            range: self.range,
            reference_length: self.reference_length,
        }
    }
}
