//! Ready sets of values for the knobs that trade speed for accuracy.

use rayloom_network::{Address, Network};
use serde_json::Value as Json;

use crate::run::setting::{Assignment, Setting, plain};
use crate::subject::chain::Chain;
use crate::subject::lighting::reads_gradient;

/// The processor that a knob belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    Traversal,
    View,
    Source,
    Gradients,
}

/// A property and the values worth trying.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Knob {
    /// What the names of settings call it.
    label: &'static str,
    owner: Owner,
    property: &'static str,
    /// JSON or bare words.
    values: &'static [&'static str],
}

/// A knob with the values worth trying around the network's own setting, or several that move together, rung by rung.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ladder {
    /// What `--ladder` calls it.
    pub name: &'static str,
    /// What it trades.
    pub help: &'static str,
    knobs: &'static [Knob],
}

const fn knob(label: &'static str, owner: Owner, property: &'static str, values: &'static [&'static str]) -> Knob {
    Knob { label, owner, property, values }
}

/// All ladders.
pub const LADDERS: [Ladder; 13] = [
    Ladder {
        name: "quality",
        help: "sampling rate and early termination together, from a preview to a still picture",
        knobs: &[
            knob("rate", Owner::Traversal, "sampling_rate", &["0.5", "2.0", "4.0", "8.0", "16.0"]),
            knob(
                "termination",
                Owner::Traversal,
                "termination_error",
                &["0.01", "0.001", "0.0005", "0.0002", "0.0001"],
            ),
        ],
    },
    Ladder {
        name: "rate",
        help: "samples per voxel",
        knobs: &[knob(
            "rate",
            Owner::Traversal,
            "sampling_rate",
            &["0.125", "0.25", "0.5", "1.0", "2.0", "4.0", "8.0", "16.0"],
        )],
    },
    Ladder {
        name: "jitter",
        help: "noise in place of rings",
        knobs: &[knob("jitter", Owner::Traversal, "jitter", &["false", "true"])],
    },
    Ladder {
        name: "pixel_rate",
        help: "rays per pixel edge",
        knobs: &[knob("pixel rate", Owner::Traversal, "pixel_rate", &["0.25", "0.5", "1.0", "2.0"])],
    },
    Ladder {
        name: "integrator",
        help: "classification of samples, or of the segments between them",
        knobs: &[knob(
            "integrator",
            Owner::Traversal,
            "classification",
            &["transfer_function", "preintegrated_fast", "preintegrated_full"],
        )],
    },
    Ladder {
        name: "sampling",
        help: "interpolation between voxels",
        knobs: &[knob(
            "sampling",
            Owner::Traversal,
            "sampling",
            &["nearest", "filtered", "trilinear", "catmull_rom", "bspline"],
        )],
    },
    Ladder {
        name: "gradient",
        help: "estimate of the gradient",
        knobs: &[knob(
            "gradient",
            Owner::Traversal,
            "gradient",
            &["central", "forward", "backward", "central4", "sobel", "filtered", "precomputed"],
        )],
    },
    Ladder {
        name: "gradients",
        help: "storage of precomputed gradients",
        knobs: &[knob("gradients", Owner::Gradients, "storage", &["32-bit", "16-bit", "8-bit"])],
    },
    Ladder {
        name: "entry",
        help: "storage of entry and exit points",
        knobs: &[knob("entry", Owner::View, "format", &["32-bit", "16-bit", "half", "8-bit"])],
    },
    Ladder {
        name: "volume",
        help: "storage of the voxels",
        knobs: &[knob("volume", Owner::Source, "precision", &["auto", "8-bit", "16-bit", "32-bit"])],
    },
    Ladder {
        name: "target",
        help: "storage of the picture",
        knobs: &[knob("target", Owner::Traversal, "target", &["32-bit", "16-bit"])],
    },
    Ladder {
        name: "termination",
        help: "error allowed to early ray termination",
        knobs: &[knob(
            "termination",
            Owner::Traversal,
            "termination_error",
            &["0.0", "0.0005", "0.002", "0.01", "0.05", "0.1"],
        )],
    },
    Ladder {
        name: "skipping",
        help: "empty-space skipping",
        knobs: &[knob("skipping", Owner::Traversal, "skipping", &["auto", "none", "occupancy", "distance"])],
    },
];

/// The settings of a ladder for a network: its own setting is left out, and so is a knob that nothing reads.
pub fn ladder(ladder: &Ladder, network: &Network, chain: &Chain) -> Vec<Setting> {
    let rungs = ladder.knobs.iter().map(|knob| knob.values.len()).min().unwrap_or(0);
    (0..rungs).filter_map(|rung| setting(ladder, rung, network, chain)).collect()
}

/// A rung of a ladder; `None` if the network has a knob set so already, or has no such knob. (Of knobs that move together
/// one that stays makes the rung one of another ladder.)
fn setting(ladder: &Ladder, rung: usize, network: &Network, chain: &Chain) -> Option<Setting> {
    let (mut names, mut assignments) = (Vec::new(), Vec::new());
    for knob in ladder.knobs {
        let owner = match knob.owner {
            Owner::Traversal => chain.traversal(),
            Owner::View => &chain.view,
            Owner::Source => chain.source.as_deref()?,
            Owner::Gradients => chain.gradients(network)?,
        };
        let processor = network.processor(owner)?;
        let (decl, own) = (processor.property_decl(knob.property)?, processor.value(knob.property)?);
        let value = json(knob.values.get(rung)?);
        let unread = knob.property == "gradient" && !reads_gradient(network, owner);
        if unread || decl.parse(&value).is_ok_and(|value| value == own) {
            return None;
        }
        names.push(format!("{} {}", knob.label, plain(&value)));
        assignments.push(Assignment { property: Address::new(owner, knob.property), value });
    }
    Some(Setting { name: names.join(", "), assignments })
}

fn json(text: &str) -> Json {
    serde_json::from_str(text).unwrap_or_else(|_| Json::from(text))
}
