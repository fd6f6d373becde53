//! T1 homogeneous slabs, T2 the white furnace, T3 one colour.

use glam::{DAffine3, DVec3};
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{constant_color_residual, furnace_residual, homogeneous_opacity};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{chords, homogeneous};
use rayloom_tests::{Grid, Picture, Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::largest;

const SIZE: [u32; 2] = [24, 24];

/// Largest error of the opacities of a homogeneous box of extinction `tau`, over all pixels that meet it.
fn opacity_error(bench: &mut Workbench, camera: &Camera, tau: f64) -> f64 {
    let volume = bench.volume();
    let picture = bench.look(camera).render(SIZE);
    let chords = chords(camera, SIZE, &volume, &AxisBox::UNIT);
    let met = chords.iter().zip(&picture.color).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
    largest(&met.map(|(c, pixel)| (f64::from(pixel[3]) - homogeneous_opacity(tau, c.length)).abs()).collect::<Vec<_>>())
}

#[test]
fn t1_a_homogeneous_slab_has_one_opacity_at_every_step() {
    let mut worst = [0.0_f64; 2];
    for (tau, length) in [(1.0, 1.0), (0.5, 2.0), (10.0, 1.0)] {
        let mut bench = Workbench::of_generator(
            &json!({"field": "constant", "dims": [10, 10, 10], "extent": [length, length, length]}),
        );
        let along = Camera::orthographic(DVec3::X * -3.0, DVec3::ZERO, 0.9 * length);
        let askew = Camera::perspective(DVec3::new(-1.4, 0.9, 1.1) * length, DVec3::ZERO, 40.0);
        for rate in [0.13, 0.37, 1.0, 2.3, 7.77, 61.0] {
            bench.put("traversal.sampling_rate", json!(rate));
            for (reference_length, jitter) in [(1.0, false), (0.3, false), (1.0, true)] {
                bench.put("traversal.reference_length", json!(reference_length)).put("traversal.jitter", json!(jitter));
                bench.classify(&homogeneous(tau * reference_length, [1.0; 3]));
                for (camera, worst) in [&along, &askew].into_iter().zip(&mut worst) {
                    let error = opacity_error(&mut bench, camera, tau);
                    assert!(error <= OPACITY + tau * length * CHORD, "tau {tau}, rate {rate}: {error}");
                    *worst = worst.max(error);
                }
            }
        }
        let center = bench.look(&along).render([1, 1]).at(0, 0)[3];
        assert!((f64::from(center) - homogeneous_opacity(tau, length)).abs() < OPACITY, "tau {tau}: {center}");
    }
    println!("T1: largest error {:.2e} along an axis, {:.2e} askew", worst[0], worst[1]);
}

#[test]
fn t1_faint_material_adds_up_over_many_steps() {
    let mut bench =
        Workbench::of_generator(&json!({"field": "constant", "dims": [25, 1, 1], "extent": [25.0, 1.0, 1.0]}));
    let camera = Camera::orthographic(DVec3::X * -30.0, DVec3::ZERO, 0.9);
    // The software driver Mesa ends all loops of a shader after 65535 rounds; longer rays would be its test.
    for (rate, steps) in [(400.0, 1e4), (2400.0, 6e4)] {
        // Opacity 1e-8 a step, so far below the smallest difference that 1 - a could hold in f32.
        let tau = 1e-8 * steps / 25.0;
        bench.put("traversal.sampling_rate", json!(rate)).classify(&homogeneous(tau, [1.0; 3]));
        let found = f64::from(bench.look(&camera).render([4, 4]).at(1, 1)[3]);
        let error = found / homogeneous_opacity(tau, 25.0) - 1.0;
        println!("T1, {steps} steps: relative error {error:.2e}");
        assert!(error.abs() <= FAINT, "{found}: {error}");
    }
}

/// A function of many opacities in one colour.
fn uneven(color: [f64; 3]) -> TransferFunction {
    let knots = [(0.0, 0.0), (0.1, 0.0), (0.3, 0.4), (0.5, 0.02), (0.8, 0.9), (1.0, 0.2)];
    TransferFunction::new(knots.map(|(at, opacity)| Knot::new(at, color, opacity)).to_vec()).expect("sorted knots")
}

fn widened(picture: &Picture) -> impl Iterator<Item = [f64; 4]> {
    picture.color.iter().map(|pixel| pixel.map(f64::from))
}

/// Whether a picture has clear, translucent and opaque parts.
fn assert_varied(picture: &Picture) {
    let share = |low: f64, high: f64| {
        widened(picture).filter(|p| (low..=high).contains(&p[3])).count() as f64 / picture.color.len() as f64
    };
    assert!(share(0.1, 0.9) > 0.1 && share(0.5, 1.0) > 0.1, "the picture shows too little to judge");
}

#[test]
fn t2_white_in_a_white_furnace_is_white() {
    let mut bench =
        Workbench::of_generator(&json!({"field": "marschner_lobb", "dims": [30, 24, 20], "extent": [3.0, 2.4, 4.0]}));
    bench.add("background", "background").join("traversal.image", "background.front");
    bench.put("background.mode", json!("color")).put("background.first", json!([1, 1, 1, 1]));
    bench.look(&Camera::perspective(DVec3::new(-4.0, 3.0, 5.0), DVec3::ZERO, 45.0)).classify(&uneven([1.0; 3]));
    let mut worst: f64 = 0.0;
    for classification in ["transfer_function", "preintegrated_fast", "preintegrated_full"] {
        bench.put("traversal.classification", json!(classification));
        for skipping in ["none", "distance"] {
            bench.put("traversal.skipping", json!(skipping));
            for (rate, jitter) in [(0.3, false), (1.0, false), (1.0, true), (3.7, true)] {
                bench.put("traversal.sampling_rate", json!(rate)).put("traversal.jitter", json!(jitter));
                let front = bench.render([64, 64]);
                assert_varied(&front);
                for [r, g, b, a] in &front.color {
                    let bits = [r, g, b].map(|c| c.to_bits());
                    assert_eq!(bits, [a.to_bits(); 3], "{classification}, {skipping}, rate {rate}, jitter {jitter}");
                }
                let residual = widened(&front).map(furnace_residual).fold(0.0, f64::max);
                assert_eq!(residual, 0.0);
                let whole = bench.picture("background", "image", [64, 64]);
                worst = widened(&whole).flatten().map(|c| (c - 1.0).abs()).fold(worst, f64::max);
            }
        }
    }
    println!("T2: largest error {worst:.2e}");
    assert!(worst <= FURNACE, "{worst}");
}

#[test]
fn t3_one_colour_stays_one_colour() {
    let noise = |[i, j, k]: [u32; 3]| {
        let hash = (i.wrapping_mul(73_856_093) ^ j.wrapping_mul(19_349_663) ^ k.wrapping_mul(83_492_791))
            .wrapping_mul(2_654_435_761);
        f64::from(hash >> 8) / f64::from(1 << 24)
    };
    let file = Grid::of_index([16, 16, 16], DAffine3::IDENTITY, noise).save();
    let mut bench = Workbench::of_file(file.path());
    let color = [0.9, 0.37, 0.013];
    let center = DVec3::splat(7.5);
    bench.look(&Camera::perspective(DVec3::new(-20.0, 30.0, 40.0), center, 40.0)).classify(&uneven(color));
    for classification in ["transfer_function", "preintegrated_full"] {
        let picture = bench.put("traversal.classification", json!(classification)).render([64, 64]);
        assert_varied(&picture);
        let worst = widened(&picture)
            .map(|pixel| constant_color_residual(pixel, color) / pixel[3].max(1e-9))
            .fold(0.0, f64::max);
        println!("T3, {classification}: largest relative error {worst:.2e}");
        assert!(worst <= ONE_COLOR, "{worst}");
    }
}
