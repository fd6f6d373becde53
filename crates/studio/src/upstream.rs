//! What flows into a processor.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use rayloom_network::{Address, Network};
use rayloom_processors::Data;
use rayloom_volume::{Volume, VolumeRole};

/// The volume nearest upstream of a processor (or, for a source, its own), as last computed.
pub fn volume(network: &Network, outputs: &BTreeMap<Address, Data>, id: &str) -> Option<Arc<Volume>> {
    let mut queue = VecDeque::from([id]);
    let mut seen = BTreeSet::new();
    while let Some(id) = queue.pop_front() {
        if !seen.insert(id) {
            continue;
        }
        let found = network.inputs(id).find_map(|connection| match outputs.get(&connection.from)? {
            Data::Volume(data) => Some(data.volume.clone()),
            Data::Geometry(mesh) => Some(mesh.volume.volume.clone()),
            Data::Image(_) => None,
        });
        if found.is_some() {
            return found;
        }
        queue.extend(network.inputs(id).map(|connection| connection.from.processor.as_str()));
    }
    None
}

/// The channel of a volume that a processor classifies: the value of a gradient volume, else the one it chooses.
pub fn channel(volume: &Volume, chosen: Option<i64>) -> u32 {
    match volume.role {
        VolumeRole::GradientAndValue => 3,
        VolumeRole::Values => chosen.and_then(|c| u32::try_from(c).ok()).unwrap_or(0),
    }
    .min(volume.channels.saturating_sub(1))
}

/// Centre and radius, world units, of the sphere around a volume's box.
pub fn bounds(volume: &Volume) -> ([f64; 3], f64) {
    let to_world = volume.texture_to_world();
    let half = to_world.matrix3 * 0.5;
    let center = to_world.translation + half.x_axis + half.y_axis + half.z_axis;
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let radius = signs.map(|(y, z)| (half.x_axis + half.y_axis * y + half.z_axis * z).length());
    (center.to_array(), radius.into_iter().fold(0.0, f64::max))
}
