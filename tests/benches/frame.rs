//! Time of a frame on a real scan, by scene, with and without empty-space skipping, interleaved in one run; then wall time
//! and peak memory of the whole command. Prints medians, ratios and sample counts; asserts nothing.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rayloom_tests::timing::{Summary, samples, time_again};
use rayloom_tests::{Workbench, root};

const SIZE: [u32; 2] = [512, 512];
const ROUNDS: usize = 7;

/// A scene: name and what to set on the flagship network.
type Scene = (&'static str, &'static [(&'static str, &'static str)]);

const SCENES: [Scene; 6] = [
    ("unshaded DVR", &[("shading", r#""none""#)]),
    ("shaded DVR, central differences", &[("shading", r#""blinn_phong""#)]),
    ("shaded DVR, no early termination", &[("shading", r#""blinn_phong""#), ("termination_error", "0")]),
    (
        "isosurface, shaded",
        &[("shading", r#""blinn_phong""#), ("compositing", r#""isosurface""#), ("compositing.isovalue", "60")],
    ),
    ("MIP", &[("shading", r#""none""#), ("compositing", r#""mip""#)]),
    ("pre-integrated DVR", &[("shading", r#""none""#), ("classification", r#""preintegrated_fast""#)]),
];

const SKIPPING: [(&str, &str); 4] = [("none", "4"), ("occupancy", "8"), ("distance", "8"), ("distance", "4")];

fn main() {
    for volume in ["ch2.nii.gz", "ch2better.nii.gz"] {
        println!("{volume} at {} x {}, one sample a voxel; GPU time of the traversal, ms", SIZE[0], SIZE[1]);
        for scene in SCENES {
            measure(volume, scene);
        }
    }
    command();
}

fn measure(volume: &str, (name, settings): Scene) {
    let mut benches: Vec<_> = SKIPPING
        .iter()
        .filter(|(skipping, _)| *skipping == "none" || name != "MIP")
        .map(|(skipping, brick)| {
            let mut bench = Workbench::load("networks/brain.json");
            bench.set("source.file", &format!("{:?}", root().join("data").join(volume)));
            for (property, value) in settings {
                bench.set(&format!("traversal.{property}"), value);
            }
            bench
                .set("traversal.skipping", &format!("{skipping:?}"))
                .set("traversal.brick_size", &format!("{brick:?}"));
            bench.runner.measure(true);
            let count = samples(&mut bench, SIZE);
            time_again(&mut bench, "traversal", "image", SIZE);
            (format!("{skipping} {brick}"), bench, count, Vec::new())
        })
        .collect();
    for _ in 0..ROUNDS {
        for (_, bench, _, times) in &mut benches {
            times.push(time_again(bench, "traversal", "image", SIZE));
        }
    }
    println!("  {name}");
    let plain = benches[0].3.clone();
    for (skipping, _, count, times) in &benches {
        let ratio = Summary::of_ratios(times, &plain);
        println!(
            "    {skipping:<12} {:>9.1} ms   ratio {:.2}   {:.2} M samples",
            Summary::of(times).median,
            ratio.median,
            *count as f64 * 1e-6
        );
    }
}

fn command() {
    let program = root().join("target/release/rayloom");
    if !program.exists() {
        println!("the whole command was not measured: build it with `cargo build --release -p rayloom`");
        return;
    }
    let folder = std::env::temp_dir();
    let output = folder.join(format!("rayloom-bench-{}.png", std::process::id()));
    let runs: Vec<_> = (0..3).filter_map(|_| run(&program, &output)).collect();
    let _ = std::fs::remove_file(&output);
    let seconds: Vec<f64> = runs.iter().map(|(time, _)| time.as_secs_f64()).collect();
    let memory = runs.iter().map(|(_, kilobytes)| *kilobytes).max().unwrap_or(0) / 1024;
    if !seconds.is_empty() {
        println!("`rayloom render networks/brain.json`: {} s, peak memory {memory} MiB", Summary::of(&seconds));
    }
}

/// Wall time of the command and the most memory it held, KiB (where `/proc` tells).
fn run(program: &Path, output: &Path) -> Option<(Duration, u64)> {
    let start = Instant::now();
    let mut child = Command::new(program)
        .arg("render")
        .arg(root().join("networks/brain.json"))
        .arg("-o")
        .arg(output)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    while child.try_wait().ok()?.is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        peak = peak.max(line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0));
        std::thread::sleep(Duration::from_millis(5));
    }
    Some((start.elapsed(), peak))
}
