//! Networks that show a volume in some way.

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use rayloom_gpu::Gpu;
use rayloom_network::{Address, Evaluator, Network, Registry, Request};
use rayloom_processors::{Data, Runner};
use rayloom_volume::{ValueRange, Volume};
use serde_json::{Value as Json, json};

use crate::random::Random;
use crate::volumes::Kind;

/// Two to five peaks, ramps or steps over the range.
fn function(random: &mut Random, [low, high]: [f64; 2]) -> Json {
    let mut at = random.number(0.1, 0.35);
    let mut knots = vec![json!({"at": low + at * (high - low), "color": [0.5, 0.5, 0.5], "opacity": 0.0})];
    for _ in 0..random.number(2.0, 5.0) as usize {
        at += *random.of(&[0.002, 0.02, 0.08, 0.2]) * random.number(0.5, 1.5);
        let color = [0; 3].map(|_| random.number(0.0, 1.0));
        let opacity = *random.of(&[0.0, 0.03, 0.2, 0.8]) * random.number(0.5, 1.0);
        knots.push(json!({"at": low + at.min(0.99) * (high - low), "color": color, "opacity": opacity}));
        at = at.min(0.98) + 0.001;
    }
    json!({"knots": knots})
}

/// What a volume of values is shown by: its name, and what is set.
fn look(random: &mut Random, range: ValueRange) -> (&'static str, Json) {
    let mut iso = || range.denormalise(random.number(0.2, 0.65));
    let looks = [
        ("unshaded", json!({})),
        ("unshaded, fine", json!({"sampling_rate": 2})),
        ("unshaded, coarse", json!({"sampling_rate": 0.5, "termination_error": 0.02})),
        ("shaded", json!({"shading": "blinn_phong"})),
        ("diffuse", json!({"shading": "diffuse", "gradient": "central4"})),
        ("toon", json!({"shading": "toon", "gradient": "sobel"})),
        ("maximum", json!({"compositing": "mip"})),
        ("minimum", json!({"compositing": "minip"})),
        ("mean", json!({"compositing": "mean"})),
        ("sum", json!({"compositing": "sum"})),
        ("MIDA", json!({"compositing": "mida"})),
        ("attenuated", json!({"compositing": "attenuated_mip"})),
        ("nearest", json!({"sampling": "nearest"})),
        ("cubic", json!({"sampling": "catmull_rom"})),
        ("isosurface", json!({"compositing": "isosurface", "compositing.isovalue": iso()})),
        (
            "shaded isosurface",
            json!({"compositing": "isosurface", "compositing.isovalue": iso(), "shading": "diffuse"}),
        ),
        ("glossy isosurface", json!({"compositing": "isosurface", "compositing.isovalue": iso(), "shading": "phong"})),
        (
            "two surfaces",
            json!({"compositing": "isosurfaces", "compositing.isovalue_a": iso(), "compositing.isovalue_b": iso(),
                "shading": "diffuse"}),
        ),
        (
            "surface in fog",
            json!({"compositing": "isosurface_dvr", "compositing.isovalue": iso(), "shading": "diffuse"}),
        ),
    ];
    random.of(&looks).clone()
}

/// A network that shows what a source gives, and what that is called.
pub fn network(random: &mut Random, kind: Kind, source: Json, gpu: &Gpu) -> Result<(Network, String), Box<dyn Error>> {
    let text = json!({"rayloom": 1, "processors": [source, {"id": "proxy", "type": "cube_proxy"},
        {"id": "view", "type": "entry_exit_points"}, {"id": "traversal", "type": "ray_traversal"}],
        "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry", "source.volume -> traversal.volume",
            "view.entry -> traversal.entry", "view.exit -> traversal.exit"]});
    let types: Arc<Registry> = Arc::new(rayloom_processors::registry());
    let mut network = Network::from_text(&text.to_string(), Path::new("try.json"), &types)?.network;
    let volume = volume(&network, gpu)?;
    let (range, to_world) = (volume.ranges()[0], volume.texture_to_world());
    let (center, diagonal) =
        (to_world.transform_point3(DVec3::splat(0.5)), to_world.transform_vector3(DVec3::ONE).length());
    let position = center + diagonal * DVec3::new(0.75, -1.2, 0.5);
    let camera =
        json!({"position": position.to_array(), "focus": center.to_array(), "up": [0, 0, 1], "fov_degrees": 32});
    network.set_from_json("view", "camera", &camera)?;
    let range_ends = [range.min, range.max];
    network.set_from_json("traversal", "transfer_function", &function(random, range_ends))?;
    let (look, changes) = match kind {
        Kind::Values => look(random, range),
        Kind::Colors => ("voxel colours", json!({"classification": "voxel_color", "classification.density": 0.1})),
        Kind::Labels => {
            let mut table = serde_json::Map::new();
            for label in 1..=5 {
                let color = [0; 3].map(|_| random.number(0.0, 1.0));
                let knots = json!({"knots": [{"at": 0, "color": color, "opacity": random.number(0.05, 0.9)}]});
                table.insert(label.to_string(), json!({"name": format!("region {label}"), "transfer_function": knots}));
            }
            ("labels", json!({"classification": "labels", "label_table": table}))
        }
    };
    for (id, value) in changes.as_object().into_iter().flatten() {
        network.set_from_json("traversal", id, value)?;
    }
    Ok((network, look.to_owned()))
}

/// The volume of a network's source.
fn volume(network: &Network, gpu: &Gpu) -> Result<Arc<Volume>, Box<dyn Error>> {
    let (mut runner, mut evaluator) = (Runner::new(gpu.clone())?, Evaluator::new());
    let watch = vec![Address::new("source", "volume")];
    let report = evaluator.evaluate(network, &mut runner, &Request { watch, ..Request::default() });
    match evaluator.output("source", "volume") {
        Some(Data::Volume(data)) => Ok(data.volume.clone()),
        _ => Err(format!("{:?}", report.failed).into()),
    }
}
