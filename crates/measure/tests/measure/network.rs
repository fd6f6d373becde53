//! A small network: four shells of a generated volume.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Network, Registry};
use serde_json::Value as Json;

const TEXT: &str = r#"{"rayloom": 1, "name": "Shells", "processors": [
    {"id": "source", "type": "volume_generator",
     "properties": {"field": "bucky_ball", "dims": [24, 20, 16], "extent": [24, 22, 24]}},
    {"id": "proxy", "type": "cube_proxy"},
    {"id": "clip", "type": "clipped_proxy", "properties": {"enabled": false, "normal": [1, 1, 0]}},
    {"id": "view", "type": "entry_exit_points",
     "properties": {"camera": {"position": [-30, -50, 25], "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 35}}},
    {"id": "traversal", "type": "ray_traversal", "properties": {"reference_length": 1, "transfer_function": {"knots": [
        {"at": 0.1, "color": [0.2, 0.4, 1], "opacity": 0},
        {"at": 0.4, "color": [0.9, 0.9, 0.2], "opacity": 0.15},
        {"at": 0.9, "color": [1, 0.3, 0.1], "opacity": 0.6}]}}}],
    "connections": ["source.volume -> proxy.volume", "proxy.geometry -> clip.geometry", "clip.clipped -> view.geometry",
    "source.volume -> traversal.volume", "view.entry -> traversal.entry", "view.exit -> traversal.exit"]}"#;

/// The network with some properties set, `PROCESSOR.PROPERTY` each.
pub fn network(set: &[(&str, Json)]) -> Network {
    static TYPES: OnceLock<Arc<Registry>> = OnceLock::new();
    let types = TYPES.get_or_init(|| Arc::new(rayloom_processors::registry()));
    let loaded = Network::from_text(TEXT, Path::new("shells.json"), types).expect("a sound network");
    let mut network = loaded.network;
    for (property, value) in set {
        let (processor, property) = property.split_once('.').expect("PROCESSOR.PROPERTY");
        network.set_from_json(processor, property, value).unwrap_or_else(|error| panic!("{error}"));
    }
    network
}

/// The device, shared: drivers take their time to start.
pub fn gpu() -> Gpu {
    static DEVICE: OnceLock<Gpu> = OnceLock::new();
    DEVICE.get_or_init(|| Gpu::new(&GpuOptions::default()).expect("a device")).clone()
}
