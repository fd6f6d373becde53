//! How often tuning keeps its word: random transfer functions, volumes and targets, judged from views that it never saw.
//!
//!     cargo run --release -p rayloom-measure --example tune_tries [TRIES] [SEED]
//!
//! Prints a row a try as Markdown, and at the end how many met the target. A try that says that it missed counts as missed.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::{Goal, Verdict, draw, picture_error, silent, tune};
use rayloom_network::{Address, Camera, Evaluator, Network, Registry, Request, Value};
use rayloom_processors::{Data, Runner};
use rayloom_reference::{Cache, Reference};
use rayloom_volume::Volume;
use serde_json::{Value as Json, json};

/// Views that each choice is judged by.
const JUDGED: usize = 5;
const SIZE: [u32; 2] = [64, 64];

/// Random numbers: a linear congruential generator (Knuth's MMIX), its high bits.
struct Random(u64);

impl Random {
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 33) as f64 / (1u64 << 31) as f64)
    }

    fn of<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[(self.number(0.0, choices.len() as f64) as usize).min(choices.len() - 1)]
    }
}

/// A source of a volume and what it is called.
fn source(random: &mut Random, index: usize) -> (String, Json) {
    const FIELDS: [&str; 7] =
        ["bucky_ball", "hydrogen_2p", "hydrogen_3d", "marschner_lobb", "gaussian_blob", "sphere_distance", "shells"];
    if index % 4 == 3 {
        let name = *random.of(&["ch2.nii.gz", "ch2better.nii.gz", "brainsmall.volume.json"]);
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name);
        return (name.into(), json!({"id": "source", "type": "volume_source", "properties": {"file": file}}));
    }
    let field = *random.of(&FIELDS);
    let dims = [0; 3].map(|_| random.number(24.0, 80.0).round());
    let extent = dims.map(|side| side * random.number(0.7, 1.4));
    let properties = json!({"field": field, "dims": dims, "extent": extent});
    let name = format!("{field} {}x{}x{}", dims[0], dims[1], dims[2]);
    (name, json!({"id": "source", "type": "volume_generator", "properties": properties}))
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

/// A network that shows a source in some way, and what that is called.
fn network(random: &mut Random, source: Json, gpu: &Gpu) -> Result<(Network, String), Box<dyn Error>> {
    let looks: [(&str, Json); 6] = [
        ("unshaded", json!({})),
        ("unshaded, fine", json!({"sampling_rate": 2})),
        ("unshaded, coarse", json!({"sampling_rate": 0.5, "termination_error": 0.02})),
        ("shaded", json!({"shading": "blinn_phong"})),
        ("maximum", json!({"compositing": "mip"})),
        ("isosurface", json!({"compositing": "isosurface", "shading": "diffuse"})),
    ];
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
    let (look, changes) = random.of(&looks);
    network.set_from_json("traversal", "transfer_function", &function(random, [range.min, range.max]))?;
    for (id, value) in changes.as_object().into_iter().flatten() {
        network.set_from_json("traversal", id, value)?;
    }
    if *look == "isosurface" {
        let isovalue = range.denormalise(random.number(0.25, 0.6));
        network.set_from_json("traversal", "compositing.isovalue", &json!(isovalue))?;
    }
    Ok((network, (*look).to_owned()))
}

/// A view from anywhere, nearer or farther than the saved one.
fn anywhere(random: &mut Random, saved: &Camera) -> Camera {
    let mut camera = *saved;
    camera.orbit(random.number(-3.2, 3.2), 0.0);
    camera.orbit(0.0, random.number(-1.4, 1.4));
    camera.orbit(random.number(-3.2, 3.2), 0.0);
    camera.zoom(random.number(0.7, 1.4));
    camera
}

/// The error of a network as it is, seen by a camera.
fn error(network: &Network, camera: &Camera, gpu: &Gpu, cache: &Cache, meant: &Network) -> Result<f64, Box<dyn Error>> {
    let looking = |network: &Network| {
        let mut network = network.clone();
        network.set_property("view", "camera", Value::Camera(*camera)).map(|_| network)
    };
    let (mut runner, mut evaluator) = (Runner::new(gpu.clone())?, Evaluator::new());
    let watch = vec![Address::new("traversal", "image")];
    let shown = looking(network)?;
    evaluator.evaluate(&shown, &mut runner, &Request { watch, size: Some(SIZE), ..Request::default() });
    let Some(Data::Image(image)) = evaluator.output("traversal", "image") else { return Err("no picture".into()) };
    let found = image.read_back(&runner.context)?;
    let (expected, _) = draw(&looking(meant)?, None, Reference::Exact, SIZE, gpu.clone(), cache, &silent)?;
    Ok(picture_error(&found.pixels, &expected.pixels)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let tries: usize = arguments.next().map_or(Ok(24), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let gpu = Gpu::new(&GpuOptions::default())?;
    let cache = Cache::new(rayloom_measure::user_cache());
    let mut random = Random(seed);
    let (mut met, mut kept, mut said_met) = (0, 0, 0);
    println!("| volume | look | target | setting | chosen by | unseen | judged | seconds | |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for index in 0..tries {
        let (name, source) = source(&mut random, index);
        let (network, look) = network(&mut random, source, &gpu)?;
        let target = *random.of(&[0.02, 0.01, 1.0 / 255.0, 0.002]);
        let goal = Goal {
            port: None,
            max_error: Some(target),
            budget_ms: None,
            size: SIZE,
            picture: SIZE,
            views: 6,
            unseen: 4,
            standard: None,
        };
        let start = Instant::now();
        let tuned = tune(&network, &goal, gpu.clone(), &cache, &|_, _| ControlFlow::Continue(()))?;
        let seconds = start.elapsed().as_secs_f64();
        let mut set = network.clone();
        tuned.preset.apply(&mut set)?;
        let Some(Value::Camera(saved)) = network.value("view", "camera") else { return Err("no camera".into()) };
        let mut judged: f64 = 0.0;
        for _ in 0..JUDGED {
            judged = judged.max(error(&set, &anywhere(&mut random, &saved), &gpu, &cache, &network)?);
        }
        let (says, is) = (tuned.verdict == Verdict::Met, judged <= target);
        met += usize::from(is);
        said_met += usize::from(says);
        kept += usize::from(says && is);
        let worst = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
        println!(
            "| {name} | {look} | {target:.4} | {} | {:.5} | {:.5} | {judged:.5} | {seconds:.0} | {} |",
            tuned.setting.name,
            worst(&tuned.seen),
            worst(&tuned.unseen),
            match (says, is) {
                (true, true) => "met",
                (true, false) => "**broken**",
                (false, true) => "met, but said to be missed",
                (false, false) => "said to be missed",
            }
        );
    }
    println!("\n{met} of {tries} met the target; {kept} of the {said_met} that it was promised for.");
    Ok(())
}
