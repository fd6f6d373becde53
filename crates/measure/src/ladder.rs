//! Ready sets of values for the knobs that trade speed for accuracy.

use rayloom_network::{Address, Network, PropertyDecl};
use serde_json::Value as Json;

use crate::chain::Chain;
use crate::setting::{Assignment, Setting, plain};

/// The processor that a knob belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    Traversal,
    View,
    Source,
}

/// A knob with the values worth trying, one at a time around the network's own setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ladder {
    /// What `--ladder` and the names of its settings call it.
    pub name: &'static str,
    /// What it trades.
    pub help: &'static str,
    owner: Owner,
    property: &'static str,
    /// JSON or bare words.
    values: &'static [&'static str],
}

const fn rung(
    name: &'static str,
    owner: Owner,
    property: &'static str,
    values: &'static [&'static str],
    help: &'static str,
) -> Ladder {
    Ladder { name, help, owner, property, values }
}

/// All ladders.
pub const LADDERS: [Ladder; 9] = [
    rung(
        "rate",
        Owner::Traversal,
        "sampling_rate",
        &["0.125", "0.25", "0.5", "1.0", "2.0", "4.0", "8.0", "16.0"],
        "samples per voxel",
    ),
    rung(
        "integrator",
        Owner::Traversal,
        "classification",
        &["transfer_function", "preintegrated_fast", "preintegrated_full"],
        "classification of samples or of the segments between them",
    ),
    rung(
        "sampling",
        Owner::Traversal,
        "sampling",
        &["nearest", "filtered", "trilinear", "catmull_rom", "bspline"],
        "interpolation between voxels",
    ),
    rung(
        "gradient",
        Owner::Traversal,
        "gradient",
        &["central", "forward", "backward", "central4", "sobel", "filtered", "precomputed"],
        "estimate of the gradient",
    ),
    rung("entry", Owner::View, "format", &["32-bit", "16-bit", "half", "8-bit"], "storage of entry and exit points"),
    rung("volume", Owner::Source, "precision", &["auto", "8-bit", "16-bit", "32-bit"], "storage of the voxels"),
    rung("target", Owner::Traversal, "target", &["32-bit", "16-bit"], "storage of the picture"),
    rung(
        "termination",
        Owner::Traversal,
        "termination_error",
        &["0.0", "0.0005", "0.002", "0.01", "0.05", "0.1"],
        "error allowed to early ray termination",
    ),
    rung("skipping", Owner::Traversal, "skipping", &["auto", "none", "occupancy", "distance"], "empty-space skipping"),
];

/// The settings of a ladder for a network: its own value is left out, and so is a knob that nothing reads.
pub fn ladder(ladder: &Ladder, network: &Network, chain: &Chain) -> Vec<Setting> {
    let owner = match ladder.owner {
        Owner::Traversal => Some(chain.traversal()),
        Owner::View => Some(chain.view.as_str()),
        Owner::Source => chain.source.as_deref(),
    };
    let Some(owner) = owner else { return Vec::new() };
    let Some(processor) = network.processor(owner) else { return Vec::new() };
    let (Some(decl), Some(own)) = (processor.property_decl(ladder.property), processor.value(ladder.property)) else {
        return Vec::new();
    };
    if ladder.name == "gradient" && !reads_gradient(network, owner) {
        return Vec::new();
    }
    let differs = |value: &Json| parsed(&decl, value).is_none_or(|value| value != own);
    let setting = |value: Json| Setting {
        name: format!("{} {}", ladder.name, plain(&value).trim_end_matches(".0")),
        assignments: vec![Assignment { property: Address::new(owner, ladder.property), value }],
    };
    ladder.values.iter().map(|text| json(text)).filter(differs).map(setting).collect()
}

fn reads_gradient(network: &Network, traversal: &str) -> bool {
    let is = |property: &str, id: &str| matches!(network.value(traversal, property), Some(rayloom_network::Value::Text(found)) if found == id);
    !is("shading", "none") || is("classification", "transfer_function_2d")
}

fn parsed(decl: &PropertyDecl, value: &Json) -> Option<rayloom_network::Value> {
    decl.parse(value).ok()
}

fn json(text: &str) -> Json {
    serde_json::from_str(text).unwrap_or_else(|_| Json::from(text))
}
