//! Ray traversal: walks the rays between entry and exit points; its shader is assembled from snippets.

mod bands;
mod choose;
mod declare;
mod dispatch;
mod explain;
mod finite;
mod frame;
mod gaps;
mod idle;
mod long_rays;
mod memo;
mod memory;
mod parameters;
mod resample;
mod resources;
mod skipping;
mod snippets;
mod splines;
mod tables;
mod trace;

use std::collections::BTreeSet;
use std::sync::Arc;

use rayloom_network::{Declaration, ImageKind, Job, Outputs, ProcessError, ProcessorType, Properties, PropertyDecl};
use rayloom_wgsl::{Assembled, Validated};

use crate::process::{Process, Runner};
use memory::Memory;

use crate::view::same_box;
use crate::{Context, Data, Image, JobData, View, VolumeData};

pub use snippets::{reload_snippets, save_user_snippet, snippet_library, snippet_revision, user_folder};
pub use trace::{Trace, TraceOutput, TraceSample};

/// Outports, in the order of the shader's outputs.
const OUTPORTS: [&str; 3] = ["image", "image2", "image3"];
/// The outport of the map of samples.
const SAMPLES: &str = "samples";

/// The processor type.
pub struct RayTraversal {
    declaration: Declaration,
}

impl RayTraversal {
    /// A ray traversal that chooses from the built-in and the user's own snippets.
    pub fn new() -> Self {
        Self { declaration: declare::declaration(&snippet_library().0) }
    }
}

impl ProcessorType for RayTraversal {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn snippet_properties(&self, current: &Properties) -> Vec<PropertyDecl> {
        parameters::declarations(&snippet_library().0, current)
    }

    fn idle_properties(&self, current: &Properties, used: &BTreeSet<String>) -> BTreeSet<String> {
        idle::idle(&snippet_library().0, current, used)
    }
}

impl Process for RayTraversal {
    fn process(&self, context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
        let mut memory: Memory = context.take_state(job.id);
        let result = self.traverse(context, job, &mut memory);
        context.put_state(job.id, memory);
        result
    }
}

impl Runner {
    /// The shader that the ray traversal with this id used in its last run.
    pub fn assembled(&mut self, id: &str) -> Option<&Assembled> {
        self.context.state::<Memory>(id).assembled()
    }

    /// The same to keep: the last good shader where the last run failed.
    pub fn shader(&mut self, id: &str) -> Option<Arc<Validated>> {
        self.context.state::<Memory>(id).last_shader()
    }
}

/// What arrives at the inports, checked against each other.
struct Inputs<'a> {
    volume: &'a Arc<VolumeData>,
    labels: Option<&'a Arc<VolumeData>>,
    entry: &'a Arc<Image>,
    exit: &'a Arc<Image>,
    view: &'a View,
}

impl<'a> Inputs<'a> {
    fn of(job: &'a Job<'_, Data>) -> Result<Self, ProcessError> {
        let (volume, entry, exit) = (job.volume("volume")?, job.image("entry")?, job.image("exit")?);
        let labels = match job.input("labels") {
            Some(Data::Volume(labels)) => Some(labels),
            _ => None,
        };
        let view = entry.view.as_ref().ok_or_else(|| {
            ProcessError::new(
                "the entry points do not say which camera saw them; take them from an entry/exit points processor",
            )
        })?;
        if entry.size() != exit.size() || exit.view.as_ref() != Some(view) {
            return Err(ProcessError::new(
                "entry and exit points belong to different views; take both from one entry/exit points processor or link the cameras",
            ));
        }
        let inputs = Self { volume, labels, entry, exit, view };
        inputs.check_boxes()?;
        Ok(inputs)
    }

    /// Everything must be given in the coordinates of one box.
    fn check_boxes(&self) -> Result<(), ProcessError> {
        let own = self.volume.volume.texture_to_world();
        if !same_box(&own, &self.view.texture_to_world) {
            return Err(ProcessError::new(format!(
                "the entry points were made for another box than that of the volume `{}`; connect the same volume to the proxy geometry",
                self.volume.volume.name
            )));
        }
        match self.labels {
            Some(labels) if !same_box(&own, &labels.volume.texture_to_world()) => Err(ProcessError::new(format!(
                "the labels `{}` and the volume `{}` fill different boxes in the world; use labels of the same scan",
                labels.volume.name, self.volume.volume.name
            ))),
            _ => Ok(()),
        }
    }
}

impl RayTraversal {
    fn traverse(
        &self,
        context: &mut Context,
        job: &Job<'_, Data>,
        memory: &mut Memory,
    ) -> Result<Outputs<Data>, ProcessError> {
        memory.last_run = None;
        let inputs = Inputs::of(job)?;
        let mut notes = Vec::new();
        let plan = choose::plan(snippet_library().0, context, job, &inputs, memory, &mut notes)?;
        let shader = memory.shader(&plan.library, &plan.checked)?;
        let pass = dispatch::Pass { job, inputs: &inputs, plan: &plan, shader: &shader };
        let drawn = pass.run(context, memory)?;
        notes.extend(finite::notes(&context.gpu, &plan, &drawn.targets)?);
        memory.last_run = Some(trace::LastRun::new(job, &inputs, plan, drawn.inputs)?);

        let mut outputs = Outputs::new();
        for (outport, target) in OUTPORTS.iter().zip(drawn.targets.outputs) {
            if let Some(target) = target {
                let (dispatch::Target { color, depth }, view) = resample::resample(context, job, target, inputs.view)?;
                let image = Image { color, depth: Some(depth), kind: ImageKind::Color, view: Some(view) };
                outputs = outputs.with(*outport, image.into());
            }
        }
        if let Some(color) = drawn.targets.samples {
            let image = Image { color, depth: None, kind: ImageKind::Data, view: Some(inputs.view.clone()) };
            outputs = outputs.with(SAMPLES, image.into());
        }
        outputs.notes = notes;
        if let Some(counted) = drawn.counted {
            outputs.statistics = counted;
        }
        Ok(outputs)
    }
}
