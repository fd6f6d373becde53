//! Shaders with open places.

use crate::slot::Slot;

/// How often a slot is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// Once for each volume that the rays pass through.
    Source,
    /// Once for all: what a ray needs but one of.
    Ray,
    /// Once for each output in use.
    Output,
}

/// A shader with slots, as a value: a file of the library and what may be put in. The file's head states the slots' contracts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skeleton {
    /// Path inside the library.
    pub path: &'static str,
    /// The slots, each with how often it is filled.
    pub slots: &'static [(Slot, Scope)],
}

/// The slots of everything that walks along rays.
const RAY_SLOTS: &[(Slot, Scope)] = &[
    (Slot::Sampling, Scope::Source),
    (Slot::Gradient, Scope::Source),
    (Slot::Classification, Scope::Source),
    (Slot::Skipping, Scope::Source),
    (Slot::Gaps, Scope::Source),
    (Slot::Slope, Scope::Source),
    (Slot::Lighting, Scope::Source),
    (Slot::Shading, Scope::Ray),
    (Slot::Refinement, Scope::Ray),
    (Slot::Lattice, Scope::Ray),
    (Slot::Stepping, Scope::Ray),
    (Slot::Endings, Scope::Ray),
    (Slot::Statistics, Scope::Ray),
    (Slot::SampleMap, Scope::Ray),
    (Slot::Compositing, Scope::Output),
];

impl Skeleton {
    /// The ray traversal.
    pub const TRAVERSAL: Skeleton = Skeleton { path: "traversal/traversal.wgsl", slots: RAY_SLOTS };
    /// The ray probe: one ray of a traversal, with a note of every sample.
    pub const PROBE: Skeleton = Skeleton { path: "traversal/probe.wgsl", slots: RAY_SLOTS };
    /// A plane through a volume.
    pub const SLICE: Skeleton = Skeleton {
        path: "slice/slice.wgsl",
        slots: &[(Slot::Sampling, Scope::Source), (Slot::Gaps, Scope::Source), (Slot::Classification, Scope::Source)],
    };

    /// A shader without slots, such as an image pass.
    pub const fn plain(path: &'static str) -> Self {
        Self { path, slots: &[] }
    }

    /// How often a slot is filled; `None` for one that the skeleton does not have.
    pub fn scope(&self, slot: Slot) -> Option<Scope> {
        self.slots.iter().find(|(known, _)| *known == slot).map(|(_, scope)| *scope)
    }
}
