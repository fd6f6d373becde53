//! Which ray the user looks at.

use std::collections::{BTreeSet, VecDeque};

use rayloom_network::{Address, Network};
use rayloom_processors::types::RAY_TRAVERSAL;

use crate::pane::Pane;
use crate::session::Session;

/// A ray of a ray traversal.
#[derive(Clone, Debug, PartialEq)]
pub struct Ray {
    /// The traversal.
    pub processor: String,
    /// Its place, to the right of the middle of the picture and below it, in heights of the picture: there it stays the same ray
    /// when the picture changes its size.
    pub at: [f32; 2],
}

impl Ray {
    /// Column and row in a picture of this size; none when it has become too narrow.
    pub fn pixel(&self, size: [u32; 2]) -> Option<[u32; 2]> {
        let [x, y] = [0, 1].map(|axis| (0.5 * size[axis] as f32 + self.at[axis] * size[1] as f32).floor());
        let inside = x >= 0.0 && y >= 0.0 && x < size[0] as f32 && y < size[1] as f32;
        inside.then_some([x as u32, y as u32])
    }
}

/// A sample that panels point at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Its value, in the unit of the volume.
    pub value: f64,
    /// The magnitude of its gradient, value a world unit, if that is known.
    pub gradient: Option<f64>,
}

/// What panels tell each other about the probed ray.
#[derive(Default)]
pub struct Probe {
    /// The ray.
    pub ray: Option<Ray>,
    /// Where it was picked: a canvas, or the outport of an inspector.
    pub picked_in: String,
    /// The sample under the pointer and the processors whose transfer functions it falls into: set for the next frame.
    marker: Option<(Mark, BTreeSet<String>)>,
    shown_marker: Option<(Mark, BTreeSet<String>)>,
}

impl Probe {
    /// To be called at the beginning of every frame.
    pub fn begin_frame(&mut self) {
        self.shown_marker = self.marker.take();
    }

    /// Marks a sample in the transfer functions of these processors, in the next frame; whether that shows anything new.
    pub fn mark(&mut self, sample: Mark, processors: BTreeSet<String>) -> bool {
        let marker = Some((sample, processors));
        let is_new = marker != self.shown_marker;
        self.marker = marker;
        is_new
    }

    /// The sample to mark in the editors of a processor.
    pub fn marker(&self, processor: &str) -> Option<Mark> {
        self.shown_marker.as_ref().filter(|(_, processors)| processors.contains(processor)).map(|(mark, _)| *mark)
    }

    /// Where to mark the ray in a picture: from its middle, in heights of the picture.
    pub fn mark_in(&self, place: &str) -> Option<[f32; 2]> {
        self.ray.as_ref().filter(|_| self.picked_in == place).map(|ray| ray.at)
    }
}

impl Session {
    /// Looks at the ray through a place (from the middle, in heights of the picture) of what a processor shows or gives; whether there is a ray traversal behind it.
    pub fn probe(&mut self, processor: &str, picked_in: impl Into<String>, at: [f32; 2]) -> bool {
        let Some(traversal) = traversals(self.network(), processor).into_iter().next() else { return false };
        self.probe.ray = Some(Ray { processor: traversal, at });
        self.probe.picked_in = picked_in.into();
        self.to_open.push(Pane::RayProbe);
        true
    }
}

/// The ray traversals at or upstream of a processor, the nearest first; beyond a traversal rays have other pixels.
pub fn traversals(network: &Network, processor: &str) -> Vec<String> {
    let mut queue = VecDeque::from([processor.to_owned()]);
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    while let Some(id) = queue.pop_front() {
        let Some(processor) = network.processor(&id).filter(|_| seen.insert(id.clone())) else { continue };
        if processor.type_id() == RAY_TRAVERSAL {
            found.push(id);
        } else {
            queue.extend(network.inputs(&id).map(|connection| connection.from.processor.clone()));
        }
    }
    found
}

/// The traversals that belong to the place where a ray was picked.
pub fn choices(network: &Network, picked_in: &str) -> Vec<String> {
    let outport = picked_in.parse::<Address>().ok();
    traversals(network, outport.as_ref().map_or(picked_in, |outport| &outport.processor))
}
