//! Every saved network, held to its golden image.
//!
//! A golden image says that a picture is as it was; that it is right is for the other tests to say. After a change that is
//! meant to alter pictures run this test with `RAYLOOM_UPDATE_GOLDEN=1` (`cargo xtask golden`) and look at what changed.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use rayloom_network::{Network, Request};
use rayloom_processors::{Data, Picture, read_picture, write_png};
use rayloom_reference::Comparison;
use rayloom_tests::tolerances::golden::{DEFAULT, EXCEPTIONS, PIXEL, Tolerance};
use rayloom_tests::{Workbench, root, types};

/// Width and height of golden images: enough to see what is wrong, few enough bytes to keep.
const SIZE: [u32; 2] = [160, 160];
/// Largest golden image, bytes.
const LIMIT: u64 = 64 * 1024;
/// With this variable in the environment the golden images are written anew.
const UPDATE: &str = "RAYLOOM_UPDATE_GOLDEN";

fn golden_folder() -> PathBuf {
    root().join("tests/golden")
}

/// The files of a folder that have an extension, by their names without it.
fn names(folder: &Path, extension: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a readable folder").path());
    let stem = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    paths
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .filter_map(|path| stem(&path))
        .collect()
}

fn networks() -> BTreeSet<String> {
    names(&root().join("networks"), "json")
}

fn updating() -> bool {
    std::env::var_os(UPDATE).is_some_and(|value| value == "1")
}

/// What the canvas of a network shows, after checks that hold for every shipped network.
fn render(name: &str) -> Result<Picture, String> {
    let file = root().join("networks").join(format!("{name}.json"));
    let loaded = Network::load(&file, &types()).map_err(|error| error.to_string())?;
    if !loaded.warnings.is_empty() {
        return Err(format!("{name}: {:?}", loaded.warnings));
    }
    let mut bench = Workbench::new(loaded.network);
    let network = &bench.network;
    if network.name.is_empty() || network.description.is_empty() {
        return Err(format!("{name}: give the network a name and a description"));
    }
    if let Some(id) = ["source", "view", "traversal", "canvas"].iter().find(|&id| network.processor(id).is_none()) {
        return Err(format!("{name}: no processor `{id}`; `--set` relies on these names"));
    }
    let report = bench.evaluate(&Request { size: Some(SIZE), ..Request::default() });
    if !report.is_complete() {
        return Err(format!("{name}: failed: {:?}, not ready: {:?}", report.failed, report.not_ready));
    }
    let gpu = &bench.runner.context.gpu;
    let image = |processor: &str, outport: &str| match bench.evaluator.output(processor, outport) {
        Some(Data::Image(image)) => Ok(rayloom_tests::Picture::of(image, gpu)),
        other => Err(format!("{name}: {processor}.{outport} holds no image but {other:?}")),
    };
    let (traversed, shown) = (image("traversal", "image")?, image("canvas", "shown")?);
    check_contents(&traversed.color, &shown.color).map_err(|problem| format!("{name}: {problem}"))?;
    let in_gamut = |pixel: &[f32; 4]| pixel.map(|value| value.clamp(0.0, 1.0));
    Ok(Picture { size: shown.size, pixels: shown.color.iter().map(in_gamut).collect(), depth: None })
}

/// A picture of nothing is no example: rays meet something, and there are many colours on an opaque background.
fn check_contents(traversed: &[[f32; 4]], shown: &[[f32; 4]]) -> Result<(), String> {
    let hit = traversed.iter().filter(|pixel| pixel[3] > 0.0).count();
    if hit * 10 < traversed.len() {
        return Err(format!("the rays met something in only {hit} of {} pixels", traversed.len()));
    }
    if !shown.iter().all(|pixel| (pixel[3] - 1.0).abs() < 1e-5) {
        return Err("the picture is not opaque; give it a background".into());
    }
    let colors: BTreeSet<_> = shown.iter().map(|pixel| pixel.map(|value| (value * 255.0) as u8)).collect();
    if colors.len() < 64 { Err(format!("a picture of {} colours shows nothing", colors.len())) } else { Ok(()) }
}

/// What of a network differs from its golden image, if it is too much.
fn compare(name: &str, picture: &Picture) -> Result<(), String> {
    let golden = read_picture(&golden_folder().join(format!("{name}.png"))).map_err(|error| error.to_string())?;
    if golden.size != picture.size {
        return Err(format!("{name}: the golden image has {:?} pixels, expected {SIZE:?}", golden.size));
    }
    let comparison = Comparison::new(&picture.pixels, &golden.pixels).map_err(|error| error.to_string())?;
    let differing = 1.0 - comparison.share_within(PIXEL);
    let tolerance = EXCEPTIONS.iter().find(|exception| exception.network == name).unwrap_or(&DEFAULT);
    println!(
        "{name}: {:.3} % of the pixels differ (allowed {:.3} %), at most by {:.2} codes",
        100.0 * differing,
        100.0 * tolerance.share,
        255.0 * comparison.pixels.max
    );
    if differing <= tolerance.share {
        return Ok(());
    }
    let folder = write_evidence(name, picture, &comparison);
    Err(format!(
        "{name}: {:.3} % of the pixels differ from the golden image, {:.3} % may; look at {}",
        100.0 * differing,
        100.0 * tolerance.share,
        folder.display()
    ))
}

/// Writes the picture and where it differs; returns the folder.
fn write_evidence(name: &str, picture: &Picture, comparison: &Comparison) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    // White where a pixel is off by eight codes or more.
    let gray = |&error: &f64| {
        let level = (error * 255.0 / 8.0).min(1.0) as f32;
        [level, level, level, 1.0]
    };
    let difference = Picture { size: SIZE, pixels: comparison.pixel_errors.iter().map(gray).collect(), depth: None };
    for (suffix, image) in [("actual", picture), ("difference", &difference)] {
        write_png(&folder.join(format!("{name}.{suffix}.png")), image).unwrap_or_else(|error| panic!("{error}"));
    }
    folder
}

fn update(name: &str, picture: &Picture) {
    write_png(&golden_folder().join(format!("{name}.png")), picture).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn every_network_looks_as_it_did() {
    let judge = |name: &String| {
        let picture = render(name)?;
        if updating() {
            update(name, &picture);
        }
        compare(name, &picture)
    };
    let failures: Vec<String> = networks().iter().filter_map(|name| judge(name).err()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn golden_images_and_networks_belong_together() {
    let (networks, golden) = (networks(), names(&golden_folder(), "png"));
    let missing: Vec<_> = networks.difference(&golden).collect();
    assert!(missing.is_empty() || updating(), "no golden image for {missing:?}; make it with {UPDATE}=1");
    let surplus: Vec<_> = golden.difference(&networks).collect();
    assert!(surplus.is_empty(), "golden images without a network: {surplus:?}; delete them");
    for exception in EXCEPTIONS {
        let Tolerance { network, reason, .. } = exception;
        assert!(networks.contains(*network), "there is a tolerance for `{network}`, but no such network");
        assert!(!reason.is_empty(), "the tolerance for `{network}` needs a reason");
    }
    for name in &golden {
        let file = golden_folder().join(format!("{name}.png"));
        let bytes = fs::metadata(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display())).len();
        assert!(bytes <= LIMIT, "{}: {bytes} bytes; at most {LIMIT} are kept", file.display());
    }
}
