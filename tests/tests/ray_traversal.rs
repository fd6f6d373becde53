//! The ray traversal as a user meets it: edits cost what they must and no more, mistakes are told and mended, every device
//! gives the same picture.

use rayloom_gpu::{Gpu, GpuOptions, Hidden};
use rayloom_network::{Level, Network, Outcome, Report, Request, Sinks};
use rayloom_tests::{Picture, Workbench, root, types};
use serde_json::json;

const SIZE: [u32; 2] = [64, 64];

/// A small scene: a Gaussian blob, shaded.
const SCENE: &str = r#"{
  "rayloom": 1,
  "processors": [
    {"id": "source", "type": "volume_generator", "properties": {"field": "gaussian_blob", "sigma": 0.5, "dims": [32, 32, 32], "extent": [2, 2, 2]}},
    {"id": "proxy", "type": "cube_proxy"},
    {"id": "view", "type": "entry_exit_points", "properties": {
      "camera": {"position": [3, -4, 2.5], "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 30}}},
    {"id": "traversal", "type": "ray_traversal", "properties": {
      "reference_length": 0.1, "shading": "blinn_phong",
      "transfer_function": {"knots": [{"at": 0.2, "color": [1, 0.2, 0.1], "opacity": 0}, {"at": 0.9, "color": [1, 1, 0.5], "opacity": 0.6}]}}},
    {"id": "canvas", "type": "canvas"}
  ],
  "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry", "source.volume -> traversal.volume",
    "view.entry -> traversal.entry", "view.exit -> traversal.exit", "traversal.image -> canvas.image"]
}"#;

fn scene() -> Network {
    Network::from_text(SCENE, &root().join("tests/scene.json"), &types())
        .unwrap_or_else(|error| panic!("{error}"))
        .network
}

fn evaluate(bench: &mut Workbench) -> Report {
    let request = Request { sinks: Sinks::All, size: Some(SIZE), ..Request::default() };
    bench.evaluate(&request)
}

/// Evaluates and returns why the traversal ran, if it did, with its level.
fn why(bench: &mut Workbench) -> Option<(Level, String)> {
    let report = evaluate(bench);
    assert!(report.is_complete(), "{report:?}");
    report.runs.iter().find(|run| run.processor == "traversal").map(|run| (run.level, run.why()))
}

fn failure(bench: &mut Workbench) -> String {
    let report = evaluate(bench);
    let failed = report.runs.iter().find_map(|run| match &run.outcome {
        Outcome::Failed(error) => Some(error.clone()),
        Outcome::Done => None,
    });
    failed.unwrap_or_else(|| panic!("must fail: {report:?}")).to_string()
}

fn difference(a: &Picture, b: &Picture) -> f32 {
    let pairs = a.color.iter().flatten().zip(b.color.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Share of pixels that show anything: a comparison of blank pictures proves nothing.
fn coverage(picture: &Picture) -> f64 {
    picture.color.iter().filter(|pixel| pixel[3] > 0.01).count() as f64 / picture.color.len() as f64
}

#[test]
fn numbers_assemble_nothing_and_earlier_choices_are_found_again() {
    let mut bench = Workbench::new(scene());
    assert_eq!(why(&mut bench), Some((Level::Ports, "first run".into())));
    let compiled = |bench: &Workbench| bench.runner.context.pipelines.counts().misses;
    let first = compiled(&bench);

    bench.set("traversal.shading.shininess", "64").set("traversal.sampling_rate", "2");
    assert_eq!(why(&mut bench).map(|found| found.0), Some(Level::Result));
    bench.set("view.camera", r#"{"position": [0, -5, 1]}"#);
    let (level, reason) = why(&mut bench).expect("a new camera");
    assert_eq!(level, Level::Result);
    assert!(reason.contains("entry"), "{reason}");
    assert_eq!(compiled(&bench), first);

    bench.set("traversal.shading", r#""toon""#);
    let (level, reason) = why(&mut bench).expect("another snippet");
    assert!(level == Level::Shader && reason.contains("traversal.shading changed"), "{level} {reason}");
    assert_eq!(compiled(&bench), first + 1);
    bench.set("traversal.shading", r#""blinn_phong""#);
    assert!(why(&mut bench).is_some());
    assert_eq!(compiled(&bench), first + 1);
    assert_eq!(why(&mut bench), None);
}

#[test]
fn unused_outputs_are_not_compiled() {
    let mut bench = Workbench::new(scene());
    assert!(why(&mut bench).is_some());
    let text = |bench: &mut Workbench| {
        bench.runner.assembled("traversal").map(|shader| shader.text.clone()).unwrap_or_default()
    };
    assert!(!text(&mut bench).contains("out2_"));
    let normals = bench.picture("traversal", "image3", SIZE);
    assert!(text(&mut bench).contains("out3_") && !text(&mut bench).contains("out2_"));
    // At the middle of the picture the blob faces the viewer.
    let [x, y, z, a] = normals.at(32, 32);
    let toward = glam::Vec3::new(3.0, -4.0, 2.5).normalize();
    assert_eq!(a, 1.0);
    assert!((2.0 * glam::Vec3::new(x, y, z) - 1.0).distance(toward) < 0.08, "{x} {y} {z}");
}

#[test]
fn an_edited_snippet_works_and_a_broken_one_is_told_and_mended() {
    let mut bench = Workbench::new(scene());
    let before = bench.picture("traversal", "image", SIZE);
    assert!(coverage(&before) > 0.2);
    let flat = "//! slot: shading\n//! help: One colour.\n//! param level: f32 = 1 [0, 1] -- brightness\nfn shade(medium: vec4f, surface: Surface) -> vec4f { return vec4f(medium.rgb * params.level, medium.w); }\n";
    bench.put("traversal.shading.text", flat.into()).set("traversal.shading.level", "0.5");
    let half = bench.picture("traversal", "image", SIZE);
    bench.set("traversal.shading.level", "1");
    let full = bench.picture("traversal", "image", SIZE);
    for (half, full) in half.color.iter().zip(&full.color) {
        assert!((0..3).all(|c| (half[c] - 0.5 * full[c]).abs() < 1e-6) && half[3] == full[3], "{half:?} {full:?}");
    }
    bench.put("traversal.shading.text", flat.replace("params.level, medium", "params.level * light, medium").into());
    let message = failure(&mut bench);
    assert!(message.contains("edited/shading.wgsl:4:95: no definition in scope for identifier: `light`"), "{message}");
    bench.put("traversal.shading.text", "".into());
    assert_eq!(difference(&bench.picture("traversal", "image", SIZE), &before), 0.0);
}

#[test]
fn edited_text_survives_saving_and_loading() {
    let mut bench = Workbench::new(scene());
    let text = "//! slot: gradient\n//! help: Points along x.\nfn gradient_at(p: vec3f, voxel: vec4f) -> vec3f { return vec3f(1.0, 0.0, 0.0); }\n";
    bench.put("traversal.gradient.text", text.into());
    let before = bench.picture("traversal", "image", SIZE);
    let saved = bench.network.to_text(None);
    let loaded = Network::from_text(&saved, &root().join("tests/scene.json"), &types())
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(difference(&Workbench::new(loaded.network).picture("traversal", "image", SIZE), &before), 0.0);
}

#[test]
fn combinations_and_inputs_that_do_not_fit_are_told() {
    let mut bench = Workbench::new(scene());
    bench.set("traversal.compositing", r#""mip""#).set("traversal.skipping", r#""distance""#);
    assert!(failure(&mut bench).contains("needs every sample of the ray"));
    bench.set("traversal.skipping", r#""auto""#).set("traversal.gradient", r#""precomputed""#);
    assert!(failure(&mut bench).contains("insert a gradient volume"));
    bench.set("traversal.gradient", r#""none""#);
    assert!(failure(&mut bench).contains("choose a gradient operator"));
    bench.set("traversal.shading", r#""none""#).set("traversal.channel", "2");
    assert!(failure(&mut bench).contains("channel 2 was chosen"));
    bench.set("traversal.channel", "0").set("traversal.sampling", r#""linear""#);
    assert!(failure(&mut bench).contains("there are bspline"));
    bench.set("traversal.sampling", r#""nearest""#);
    assert!(why(&mut bench).is_some());
}

#[test]
fn a_device_that_cannot_filter_floats_draws_the_same_picture() {
    let picture = |hidden| {
        let gpu = Gpu::new(&GpuOptions { hidden, ..GpuOptions::default() }).unwrap_or_else(|error| panic!("{error}"));
        let mut bench = Workbench::on(scene(), gpu);
        let picture = bench.picture("traversal", "image", SIZE);
        let notes = bench.evaluator.last_run("traversal").map(|run| run.notes.join(" ")).unwrap_or_default();
        (picture, notes)
    };
    let (filtered, notes) = picture(Hidden::default());
    assert!(coverage(&filtered) > 0.2 && notes.is_empty(), "{notes}");
    let (interpolated, notes) = picture(Hidden { float32_filterable: true, timestamps: true, norm16: true });
    assert!(notes.contains("cannot filter"), "{notes}");
    assert!(difference(&filtered, &interpolated) < 1e-4, "{}", difference(&filtered, &interpolated));
}

#[test]
fn samples_are_counted() {
    let mut bench = Workbench::new(scene());
    bench.runner.count_samples(true);
    bench.set("traversal.skipping", r#""none""#).set("traversal.termination_error", "0");
    let report = evaluate(&mut bench);
    let run = report.runs.iter().find(|run| run.processor == "traversal").expect("it ran");
    let count = |name: &str| run.statistics.get(name).and_then(|count| count.as_u64()).unwrap_or_default();
    let entry = bench.picture("view", "entry", SIZE);
    let exit = bench.picture("view", "exit", SIZE);
    let chord = |(entry, exit): (&[f32; 4], &[f32; 4])| {
        (0..3).map(|i| ((exit[i] - entry[i]) * 32.0).powi(2)).sum::<f32>().sqrt()
    };
    let hits = entry.color.iter().filter(|point| point[3] > 0.5).count() as u64;
    let samples: u64 = entry
        .color
        .iter()
        .zip(&exit.color)
        .filter(|(entry, _)| entry[3] > 0.5)
        .map(|pair| (chord(pair) - 1e-4).ceil().max(1.0) as u64)
        .sum();
    assert_eq!(count("rays"), hits);
    assert!(count("samples").abs_diff(samples) <= 4, "{} {samples}", count("samples"));
    assert!(count("contributing") > 0 && count("contributing") < count("samples"));
}

/// A shading snippet that spends some rounds of a loop.
fn looping(head: &str) -> serde_json::Value {
    json!(format!(
        "//! slot: shading\nfn shade(medium: vec4f, surface: Surface) -> vec4f {{\n    var rounds = 0.0;\n    {head} {{\n        rounds += 1.0;\n    }}\n    return medium * (rounds / 100.0);\n}}\n"
    ))
}

#[test]
fn a_loop_without_an_end_is_told_and_can_be_mended() {
    let mut bench = Workbench::new(scene());
    let mut errors = |text: serde_json::Value| {
        bench.put("traversal.shading.text", text);
        let watch = vec![("traversal", "image").into()];
        let report = bench.evaluate(&Request { watch, size: Some([16, 16]), ..Request::default() });
        report.failed.get("traversal").cloned()
    };
    assert_eq!(errors(looping("for (var i = 0u; i < 100u; i++)")), None);
    for endless in ["loop", "while rounds >= 0.0", "for (;;)"] {
        let error = errors(looping(endless)).unwrap_or_else(|| panic!("`{endless}` was taken"));
        let mark = error.marks.first().expect("a mark");
        assert_eq!((mark.source.as_str(), mark.line, mark.column), ("edited/shading.wgsl", 4, 5), "{error}");
        assert!(error.message.contains("did not end"), "{error}");
    }
    assert_eq!(errors(looping("while rounds < 100.0")), None);
}

/// What a snippet makes of nothing is told with the snippet, by the bits of the picture.
#[test]
fn pixels_that_are_not_finite_are_counted_and_the_snippet_is_named() {
    let mut bench = Workbench::new(scene());
    let mut notes = |red: &str| {
        let text = format!(
            "//! slot: shading\nfn shade(medium: vec4f, surface: Surface) -> vec4f {{\n    return vec4f({red}, medium.gba);\n}}\n"
        );
        bench.put("traversal.shading.text", text.into());
        let picture = bench.picture("traversal", "image", SIZE);
        let bad = picture.color.iter().filter(|pixel| pixel.iter().any(|channel| !channel.is_finite())).count();
        (bad, bench.evaluator.last_run("traversal").map(|run| run.notes.join("\n")).unwrap_or_default())
    };
    assert_eq!(notes("medium.r"), (0, String::new()));
    for (red, bits) in [("nothing", "0x7fc00000u"), ("infinity", "0x7f800000u")] {
        // Constants of this kind are refused; the device does not know that alpha is no larger than 10000.
        let (bad, note) = notes(&format!("bitcast<f32>({bits} | u32(medium.a > 10000.0))"));
        assert!(bad > 100, "{red}: {bad}");
        assert!(note.starts_with(&format!("{bad} of 4096 pixels of `image` are not finite numbers")), "{note}");
        assert!(note.contains("your snippet `edited/shading.wgsl`"), "{note}");
    }
}

#[test]
fn a_lost_device_is_replaced_and_the_picture_computed_again() {
    let gpu = Gpu::new(&GpuOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    let mut bench = Workbench::on(scene(), gpu);
    let before = bench.picture("traversal", "image", SIZE);
    assert!(!bench.runner.context.gpu.is_lost());
    bench.runner.context.gpu.device.destroy();
    assert!(bench.runner.context.gpu.is_lost());
    let after = bench.picture("traversal", "image", SIZE);
    assert!(coverage(&after) > 0.2 && difference(&before, &after) == 0.0);
    let report = evaluate(&mut bench);
    assert!(report.runs.iter().all(|run| run.notes.is_empty()), "once is enough: {report:?}");

    // Lost in the middle of an evaluation: when the first processor starts.
    let device = bench.runner.context.gpu.device.clone();
    bench.runner.context.progress = None;
    bench.runner.context.interrupt = Some(Box::new(move || {
        device.destroy();
        false
    }));
    bench.set("traversal.sampling_rate", "2").set("traversal.jitter", "false");
    let report = evaluate(&mut bench);
    assert!(report.is_complete(), "{report:?}");
    let notes = report.runs.iter().flat_map(|run| run.notes.iter());
    assert_eq!(notes.filter(|note| note.contains("device was lost")).count(), 1, "{report:?}");
}
