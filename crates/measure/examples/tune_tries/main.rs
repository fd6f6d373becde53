//! How often tuning keeps its word: random volumes, transfer functions, looks and targets, judged from views that it never saw.
//!
//!     cargo run --release -p rayloom-measure --example tune_tries [TRIES] [SEED] [ONLY]
//!
//! Prints a row a try as Markdown, and at the end how many met the target. A try that says that it missed counts as missed.
//! `ONLY` is the number of the one try to do.

mod looks;
mod random;
mod volumes;

use std::error::Error;
use std::ops::ControlFlow;
use std::time::Instant;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::{Goal, MeasureError, Tuned, Verdict, draw, picture_error, silent, tune};
use rayloom_network::{Address, Camera, Evaluator, Network, Request, Value};
use rayloom_processors::{Data, Runner};
use rayloom_reference::{Cache, Reference};
use serde_json::json;

use crate::random::Random;

/// Views that each choice is judged by.
const JUDGED: usize = 5;
const SIZE: [u32; 2] = [64, 64];
/// Samples a voxel of the picture that judges what the float64 reference cannot draw.
const FINE: f64 = 512.0;

/// A view from anywhere, nearer or farther than the saved one.
fn anywhere(random: &mut Random, saved: &Camera) -> Camera {
    let mut camera = *saved;
    camera.orbit(random.number(-3.2, 3.2), 0.0);
    camera.orbit(0.0, random.number(-1.4, 1.4));
    camera.orbit(random.number(-3.2, 3.2), 0.0);
    camera.zoom(random.number(0.7, 1.4));
    camera
}

fn picture(network: &Network, gpu: &Gpu) -> Result<Vec<[f32; 4]>, Box<dyn Error>> {
    let (mut runner, mut evaluator) = (Runner::new(gpu.clone())?, Evaluator::new());
    let watch = vec![Address::new("traversal", "image")];
    evaluator.evaluate(network, &mut runner, &Request { watch, size: Some(SIZE), ..Request::default() });
    match evaluator.output("traversal", "image") {
        Some(Data::Image(image)) => Ok(image.read_back(&runner.context)?.pixels),
        _ => Err("no picture".into()),
    }
}

/// The error of a network as it is, seen by a camera.
fn error(network: &Network, camera: &Camera, gpu: &Gpu, cache: &Cache, meant: &Network) -> Result<f64, Box<dyn Error>> {
    let looking = |network: &Network| {
        let mut network = network.clone();
        network.set_property("view", "camera", Value::Camera(*camera)).map(|_| network)
    };
    let found = picture(&looking(network)?, gpu)?;
    let meant = looking(meant)?;
    let expected = match draw(&meant, None, Reference::Exact, SIZE, gpu.clone(), cache, &silent) {
        Ok((exact, _)) => exact.pixels,
        Err(MeasureError::Refusal(_)) => picture(&finest(meant)?, gpu)?,
        Err(other) => return Err(other.into()),
    };
    Ok(picture_error(&found, &expected)?)
}

/// The network with every knob at its finest.
fn finest(mut network: Network) -> Result<Network, Box<dyn Error>> {
    for (id, value) in [("sampling_rate", json!(FINE)), ("termination_error", json!(0.0)), ("target", json!("32-bit"))]
    {
        network.set_from_json("traversal", id, &value)?;
    }
    if network.value("traversal", "sampling") == Some(Value::Text("filtered".into())) {
        network.set_from_json("traversal", "sampling", &json!("trilinear"))?;
    }
    network.set_from_json("source", "precision", &json!("32-bit"))?;
    Ok(network)
}

/// How a try came out.
struct Tried {
    row: String,
    /// Whether the target was said to be met, and whether it was.
    says: bool,
    is: bool,
}

fn attempt(seed: u64, index: usize, gpu: &Gpu, cache: &Cache) -> Result<Tried, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let mut random = Random::new(seed, index);
    let (name, kind, source) = volumes::source(&mut random, folder.path())?;
    let (network, look) = looks::network(&mut random, kind, source, gpu)?;
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
    let tuned = tune(&network, &goal, gpu.clone(), cache, &|_, _| ControlFlow::Continue(()))?;
    let seconds = start.elapsed().as_secs_f64();
    let mut set = network.clone();
    tuned.preset.apply(&mut set)?;
    let Some(Value::Camera(saved)) = network.value("view", "camera") else { return Err("no camera".into()) };
    let mut judged: f64 = 0.0;
    for _ in 0..JUDGED {
        judged = judged.max(error(&set, &anywhere(&mut random, &saved), gpu, cache, &network)?);
    }
    let (says, is) = (tuned.verdict == Verdict::Met, judged <= target);
    let Tuned { setting, seen, unseen, .. } = &tuned;
    let worst = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let row = format!(
        "| {index} | {name} | {look} | {target:.4} | {} | {:.5} | {:.5} | {judged:.5} | {seconds:.0} | {} |",
        setting.name,
        worst(seen),
        worst(unseen),
        match (says, is) {
            (true, true) => "met",
            (true, false) => "**broken**",
            (false, true) => "met, but said to be missed",
            (false, false) => "said to be missed",
        }
    );
    Ok(Tried { row, says, is })
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let tries: usize = arguments.next().map_or(Ok(24), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let only: Option<usize> = arguments.next().map(|text| text.parse()).transpose()?;
    let gpu = Gpu::new(&GpuOptions::default())?;
    let cache = Cache::new(rayloom_measure::user_cache());
    let (mut met, mut kept, mut said_met, mut done) = (0, 0, 0, 0);
    println!("| | volume | look | target | setting | chosen by | unseen | judged | seconds | |");
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for index in (0..tries).filter(|index| only.is_none_or(|only| only == *index)) {
        match attempt(seed, index, &gpu, &cache) {
            Ok(Tried { row, says, is }) => {
                println!("{row}");
                done += 1;
                met += usize::from(is);
                said_met += usize::from(says);
                kept += usize::from(says && is);
            }
            Err(error) => println!("| {index} | could not be tried: {error} |"),
        }
    }
    println!("\n{met} of {done} met the target; {kept} of the {said_met} that it was promised for.");
    Ok(())
}
