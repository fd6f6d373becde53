//! `measure`, `tune`, and `render --reference`.

use std::fs;

use rayloom_processors::read_picture;

use crate::program::rayloom;

/// A ray traversal of a small generated volume that fills the picture.
const NETWORK: &str = r#"{"rayloom": 1, "name": "Small", "processors": [
    {"id": "source", "type": "volume_generator", "properties": {"field": "gaussian_blob", "dims": [9, 8, 7], "extent": [9, 8, 7]}},
    {"id": "proxy", "type": "cube_proxy"},
    {"id": "view", "type": "entry_exit_points", "properties": {"camera": {
        "position": [0, -20, 6], "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 25}}},
    {"id": "traversal", "type": "ray_traversal", "properties": {"termination_error": 0}},
    {"id": "canvas", "type": "canvas", "properties": {"size": [30, 20]}}],
    "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry", "source.volume -> traversal.volume",
    "view.entry -> traversal.entry", "view.exit -> traversal.exit", "traversal.image -> canvas.image"]}"#;

/// The network file in a folder of its own, and a function that names files beside it.
fn network() -> (tempfile::TempDir, impl Fn(&str) -> String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().to_owned();
    let within = move |name: &str| path.join(name).to_str().expect("a path in UTF-8").to_owned();
    fs::write(within("network.json"), NETWORK).expect("a file");
    (folder, within)
}

#[test]
fn references_are_drawn_once_and_resemble_the_picture() {
    let (_folder, within) = network();
    let (network, cache) = (within("network.json"), within("cache"));
    let device = within("device.exr");
    rayloom(["render", &network, "-o", &device, "--set", "traversal.sampling_rate=8"]).output();
    for reference in ["exact", "same-samples"] {
        let file = within("reference.exr");
        let arguments = ["render", &network, "--reference", reference, "--cache", &cache, "-o", &file];
        let first = rayloom(arguments).output();
        assert!(first.contains("30 x 20") && first.contains(reference) && !first.contains("before"), "{first}");
        assert!(rayloom(arguments).output().contains("drawn before"));
        let pixels = |file: &str| read_picture(std::path::Path::new(file)).expect("a picture").pixels;
        let (found, expected) = (pixels(&file), pixels(&device));
        let pairs = found.iter().flatten().zip(expected.iter().flatten());
        let mean = pairs.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / (4 * found.len()) as f64;
        assert!(found.iter().any(|pixel| pixel[3] > 0.2) && mean < 2e-3, "{reference}: {mean}");
    }
    let refused = ["render", &network, "--reference", "exact", "--set", "traversal.compositing=mida", "-o", &device];
    let error = rayloom(refused).error();
    assert!(error.contains("cannot draw this: the compositing `mida`"), "{error}");
}

#[test]
fn a_measurement_says_what_to_choose_and_where_the_files_are() {
    let (_folder, within) = network();
    let (network, cache, output) = (within("network.json"), within("cache"), within("measured"));
    let vary = ["--vary", "traversal.sampling_rate=0.5,8", "--vary", "traversal.channel=0,1"];
    let rest = ["--views", "2", "--rounds", "1", "--size", "20x16", "--cache", &cache, "-o", &output];
    let text = rayloom(["measure", &network].into_iter().chain(vary).chain(rest)).output();
    assert!(text.starts_with("Choose \u{201c}"), "{text}");
    assert!(text.contains("refused: sampling_rate 0.5, channel 1: ") && text.contains("report.html"), "{text}");
    let table = fs::read_to_string(within("measured/measurements.csv")).expect("a table");
    assert_eq!(table.lines().count(), 1 + 3 + 2, "{table}");
    let views = fs::read_to_string(within("measured/views.csv")).expect("a table");
    assert_eq!(views.lines().count(), 1 + 3 * 2, "{views}");
    let never = rayloom(["measure", &network, "--vary", "traversal.target=32-bit,9-bit", "-o", &output]).error();
    assert!(never.contains("traversal.target cannot be set: found `9-bit`"), "{never}");
    let unknown = rayloom(["measure", &network, "--ladder", "speed", "-o", &output]).error();
    assert!(unknown.contains("There is no ladder `speed`"), "{unknown}");
    let usage = rayloom(["measure", &network, "--reference", "perfect", "-o", &output]);
    assert!(usage.code == 2 && usage.stderr.contains("choose exact or same-samples or finest"), "{}", usage.stderr);
}

#[test]
fn tuning_writes_a_preset_that_can_be_rendered() {
    let (_folder, within) = network();
    let (network, cache, output) = (within("network.json"), within("cache"), within("tuned.json"));
    let goal = ["--max-error", "1/100", "--views", "2", "--unseen", "1", "--size", "20x16", "--cache", &cache];
    let printed = rayloom(["tune", &network].into_iter().chain(goal)).output();
    assert!(printed.contains("\"traversal.sampling_rate\": ") && printed.contains("within 0.01"), "{printed}");
    let named = ["--name", "Good", "-o", &output];
    let text = rayloom(["tune", &network].into_iter().chain(goal).chain(named)).output();
    assert!(text.contains("tuned.json: preset `Good`"), "{text}");
    let picture = within("picture.png");
    rayloom(["render", &output, "--preset", "Good", "-o", &picture]).output();
    let unknown = rayloom(["render", &output, "--preset", "Bad", "-o", &picture]).error();
    assert!(unknown.contains("there is no preset `Bad`; it has Good"), "{unknown}");
    assert_eq!(rayloom(["tune", &network]).code, 2);
}
