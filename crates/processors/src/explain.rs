//! What a run computed, bound and allocated, and what it left out, each with its reason: recorded where it is decided.

use rayloom_gpu::Texture;
use rayloom_network::{Job, Outputs, Run};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::Data;

/// The name among a run's statistics.
const KEY: &str = "explanations";

/// One thing that a run did or saved itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Explanation {
    /// What became of it.
    pub role: Role,
    /// The thing.
    pub what: String,
    /// The reason.
    pub why: String,
    /// Its memory on the device, bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<u64>,
}

/// What became of a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// It was computed.
    Computed,
    /// A shader reads or writes it.
    Bound,
    /// Memory was taken for it, or taken over.
    Allocated,
    /// It was not needed.
    LeftOut,
}

impl Role {
    /// All of them, in the order of a reader.
    pub const ALL: [Self; 4] = [Self::Computed, Self::Bound, Self::Allocated, Self::LeftOut];

    /// In words.
    pub fn label(self) -> &'static str {
        match self {
            Self::Computed => "computed",
            Self::Bound => "bound",
            Self::Allocated => "allocated",
            Self::LeftOut => "left out",
        }
    }
}

impl Explanation {
    /// Something of a role, without memory of its own.
    pub fn new(role: Role, what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { role, what: what.into(), why: why.into(), bytes: None }
    }

    /// With memory on the device.
    #[must_use]
    pub fn bytes(self, bytes: u64) -> Self {
        Self { bytes: Some(bytes), ..self }
    }

    /// The explanations of a run, if they were asked for with [`crate::Runner::explain`].
    pub fn of(run: &Run) -> Vec<Self> {
        let found = run.statistics.get(KEY).cloned();
        found.and_then(|found| serde_json::from_value(found).ok()).unwrap_or_default()
    }
}

/// Where processors write explanations down; off until someone wants them.
#[derive(Debug, Default)]
pub struct Ledger {
    enabled: bool,
    entries: Vec<Explanation>,
}

impl Ledger {
    /// Switches recording on or off.
    pub fn enable(&mut self, enabled: bool) {
        self.enabled = enabled;
    }

    /// Records an explanation, which is not even made when none are wanted.
    pub fn record(&mut self, explanation: impl FnOnce() -> Explanation) {
        if self.enabled {
            self.entries.push(explanation());
        }
    }

    /// Whether explanations are wanted.
    pub fn is_enabled(&self) -> bool {
        self.enabled
    }

    /// Adds what was explained at once.
    pub fn extend(&mut self, explanations: Vec<Explanation>) {
        self.entries.extend(explanations);
    }

    /// A run begins: what an earlier one that failed left is forgotten.
    pub(crate) fn begin(&mut self) {
        self.entries.clear();
    }

    /// Adds what every processor has, its outputs, and hands all over to the results of the run.
    pub(crate) fn finish(&mut self, job: &Job<'_, Data>, outputs: &mut Outputs<Data>) {
        if !self.enabled {
            return;
        }
        let mut entries = std::mem::take(&mut self.entries);
        for outport in &job.processor_type.declaration().outports {
            let id = &outport.id;
            entries.push(match (outputs.data.get(id), job.wants(id)) {
                (Some(data), true) => computed(id, data, "something uses it"),
                (Some(data), false) => computed(id, data, "comes with the other outputs; nothing uses it"),
                (None, _) => Explanation::new(Role::LeftOut, format!("output `{id}`"), "nothing uses it"),
            });
        }
        entries.sort_by_key(|entry| entry.role);
        outputs.statistics.insert(KEY.into(), json!(entries));
    }
}

fn computed(outport: &str, data: &Data, why: &str) -> Explanation {
    Explanation::new(Role::Computed, format!("output `{outport}`: {}", described(data)), why)
}

/// Data in a few words.
fn described(data: &Data) -> String {
    match data {
        Data::Volume(data) => {
            let [x, y, z] = data.volume.dims;
            let channels = match data.volume.channels {
                1 => String::new(),
                channels => format!(" of {channels} channels"),
            };
            format!("{x} x {y} x {z} voxels{channels}, {}", data.volume.voxels.element_type())
        }
        Data::Image(image) => {
            let depth = if image.depth.is_some() { " with depth" } else { "" };
            format!("{}{depth}", texture(&image.color))
        }
        Data::Geometry(mesh) => format!("{} triangles", mesh.indices.len()),
    }
}

/// Size and format of a texture.
pub fn texture(texture: &Texture) -> String {
    let [width, height, depth] = texture.size;
    let format = format!("{:?}", texture.format).to_lowercase();
    match depth {
        1 => format!("{width} x {height} {format}"),
        _ => format!("{width} x {height} x {depth} {format}"),
    }
}
