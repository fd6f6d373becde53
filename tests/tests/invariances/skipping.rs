//! I1: skipping what is empty changes no bit of a picture.

use std::sync::Arc;

use glam::DVec3;
use rayloom_network::Value;
use rayloom_processors::snippet_library;
use rayloom_reference::Camera;
use rayloom_tests::{Picture, Workbench, root};
use rayloom_wgsl::{Library, Slot};
use serde_json::{Value as Json, json};

use crate::{SIZE, assert_shows, difference, function};

/// Snippets and their parameters on top of the defaults.
type Settings<'a> = &'a [(&'a str, Json)];

/// A chain of which only a part of the volume shows, with its isovalue.
fn subjects() -> Vec<(&'static str, Workbench, f64)> {
    let mut head = Workbench::of_file(&root().join("data/ch2.nii.gz"));
    // The outer table of the skull and the skin.
    head.classify(&function(&[(88.0, [0.9, 0.6, 0.4], 0.0), (120.0, [1.0, 0.9, 0.8], 0.3), (160.0, [1.0; 3], 0.0)]));
    head.look(&Camera {
        up: DVec3::Z,
        ..Camera::perspective(DVec3::new(-150.0, 260.0, 120.0), DVec3::new(0.0, -15.0, 5.0), 40.0)
    });
    let mut ball =
        Workbench::of_generator(&json!({"field": "bucky_ball", "dims": [45, 38, 61], "extent": [40.0, 50.0, 60.0]}));
    ball.classify(&function(&[(0.3, [0.2, 0.4, 1.0], 0.0), (0.6, [1.0, 0.3, 0.1], 0.6)]));
    ball.look(&Camera::perspective(DVec3::new(31.0, 13.0, -29.0), DVec3::new(2.0, 1.0, -3.0), 60.0));
    let mut small = ball_of_one_brick();
    small.look(&Camera::orthographic(DVec3::new(3.0, 5.0, -9.0), DVec3::ZERO, 8.0));
    vec![("head", head, 110.5), ("ball", ball, 0.45), ("small ball", small, 0.5)]
}

/// So few voxels that borders matter to every brick.
fn ball_of_one_brick() -> Workbench {
    let mut bench =
        Workbench::of_generator(&json!({"field": "gaussian_blob", "dims": [13, 11, 7], "extent": [10.0, 10.0, 10.0]}));
    bench.classify(&function(&[(0.4, [0.2, 0.4, 1.0], 0.0), (0.6, [1.0, 0.3, 0.1], 0.6)]));
    bench
}

/// Renders with every kind of skipping and demands one picture, bit by bit.
fn assert_neutral(bench: &mut Workbench, name: &str, settings: Settings<'_>) {
    for (property, value) in settings {
        bench.put(&format!("traversal.{property}"), value.clone());
    }
    bench.put("traversal.skipping", json!("none"));
    let plain = bench.render(SIZE);
    assert_shows(&plain, name);
    for skipping in ["occupancy", "distance"] {
        for brick in ["4", "8"] {
            bench.put("traversal.skipping", json!(skipping)).put("traversal.brick_size", json!(brick));
            let skipped = bench.render(SIZE);
            let bits = |picture: &Picture| -> (Vec<[u32; 4]>, Vec<u32>) {
                let depth = picture.depth.iter().map(|depth| depth.to_bits()).collect();
                (picture.color.iter().map(|pixel| pixel.map(f32::to_bits)).collect(), depth)
            };
            if bits(&plain) != bits(&skipped) {
                let pixel = (0..plain.color.len())
                    .find(|&i| plain.color[i] != skipped.color[i] || plain.depth[i] != skipped.depth[i]);
                let pixel = pixel.unwrap_or_default();
                panic!(
                    "{name}, {skipping} in bricks of {brick}: the picture differs by {:e}, first at pixel {pixel}: {:?} at {} for {:?} at {}",
                    difference(&plain, &skipped),
                    skipped.color[pixel],
                    skipped.depth[pixel],
                    plain.color[pixel],
                    plain.depth[pixel]
                );
            }
        }
    }
}

/// The snippets of a slot that take part in skipping, by what they declare.
fn candidates(library: &Library, slot: Slot) -> Vec<String> {
    let able = library.snippets(slot).filter(|(_, declaration)| match slot {
        Slot::Compositing => declaration.emptiness.is_some(),
        Slot::Sampling => declaration.kernel.is_some(),
        _ => !declaration.absent,
    });
    able.map(|(path, _)| Library::id(path).to_owned()).collect()
}

fn isovalues(compositing: &str, isovalue: f64) -> Vec<(String, Json)> {
    let names: &[(&str, f64)] = match compositing {
        "isosurface" | "isosurface_dvr" => &[("isovalue", 1.0)],
        "isosurfaces" => &[("isovalue_a", 0.8), ("isovalue_b", 1.0), ("isovalue_c", 1.3)],
        _ => &[],
    };
    names.iter().map(|(name, factor)| (format!("compositing.{name}"), json!(factor * isovalue))).collect()
}

#[test]
fn i1_changes_no_bit_in_any_compositing_and_sampling() {
    let library: Arc<Library> = snippet_library().0;
    let compositings = candidates(&library, Slot::Compositing);
    assert!(compositings.len() >= 8, "{compositings:?}");
    let mut cases = 0;
    for (subject, mut bench, isovalue) in subjects() {
        // All of them on the small volumes; the head takes its time.
        let few = |id: &String| subject != "head" || id == "filtered" || id == "catmull_rom";
        for sampling in candidates(&library, Slot::Sampling).into_iter().filter(few) {
            for compositing in &compositings {
                bench.put("traversal.sampling", json!(sampling)).put("traversal.compositing", json!(compositing));
                let values = isovalues(compositing, isovalue);
                let settings: Vec<(&str, Json)> =
                    values.iter().map(|(id, value)| (id.as_str(), value.clone())).collect();
                assert_neutral(&mut bench, &format!("{subject}, {sampling}, {compositing}"), &settings);
                cases += 1;
            }
        }
    }
    println!("I1: {cases} combinations of data, sampling and compositing, four kinds of skipping each");
}

#[test]
fn i1_changes_no_bit_in_any_classification() {
    for (subject, mut bench, isovalue) in subjects() {
        let range = bench.volume().ranges()[0];
        let plane = json!({"primitives": [{"shape": {"rectangle": {"value": [isovalue, range.max], "gradient": [0.0, 1e3]}}, "color": [1, 0.8, 0.6], "opacity": 0.2}]});
        if let Ok(function) = serde_json::from_value(plane) {
            bench.assign("traversal", "transfer_function_2d", Value::TransferFunction2D(function));
        }
        for classification in ["preintegrated_fast", "preintegrated_full"] {
            // The lowest takes steps of several bricks.
            for rate in [0.25, 0.6, 2.5] {
                let name = format!("{subject}, {classification}, rate {rate}");
                assert_neutral(
                    &mut bench,
                    &name,
                    &[("classification", json!(classification)), ("sampling_rate", json!(rate))],
                );
            }
        }
        let jittered = [("classification", json!("transfer_function")), ("jitter", json!(true))];
        assert_neutral(&mut bench, &format!("{subject}, jitter"), &jittered);
        bench.put("traversal.jitter", json!(false));
        assert_neutral(
            &mut bench,
            &format!("{subject}, threshold"),
            &[
                ("classification", json!("threshold")),
                ("classification.lower", json!(isovalue)),
                ("sampling_rate", json!(1)),
            ],
        );
        for shading in ["none", "blinn_phong"] {
            assert_neutral(
                &mut bench,
                &format!("{subject}, 2-D, {shading}"),
                &[("classification", json!("transfer_function_2d")), ("shading", json!(shading))],
            );
        }
        for termination in [0.002, 0.3] {
            assert_neutral(
                &mut bench,
                &format!("{subject}, shaded, termination error {termination}"),
                &[("classification", json!("transfer_function")), ("termination_error", json!(termination))],
            );
        }
    }
}

#[test]
fn i1_skips_many_samples_of_sparse_data() {
    let (_, mut bench, _) = subjects().swap_remove(1);
    bench.runner.count_samples(true);
    let mut samples = |skipping: &str| {
        bench.put("traversal.skipping", json!(skipping)).render(SIZE);
        let run = bench.evaluator.last_run("traversal").expect("it ran");
        ["rays", "samples", "contributing"].map(|name| run.statistics[name].as_u64().expect("a count"))
    };
    let [none, occupancy, distance] = ["none", "occupancy", "distance"].map(&mut samples);
    println!("I1: rays, samples, contributing: {none:?}, occupancy {occupancy:?}, distance {distance:?}");
    assert!(
        none[0] == occupancy[0] && none[2] == occupancy[2] && none[2] == distance[2],
        "{none:?} {occupancy:?} {distance:?}"
    );
    assert!(3 * occupancy[1] < 2 * none[1] && distance[1] <= occupancy[1], "{none:?} {occupancy:?} {distance:?}");
}
