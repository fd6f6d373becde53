//! I4: early termination costs what was allowed. I10: a camera far away is a parallel one. I11: denser is more opaque.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_tests::{Workbench, tolerances::*};
use serde_json::json;

use crate::axes::thing;
use crate::{SIZE, assert_shows, difference, function};

const FOCUS: DVec3 = DVec3::new(1.0, 0.0, -1.0);

fn bench() -> (Workbench, rayloom_tests::VolumeFile) {
    let file = thing([24, 20, 28]).save();
    let mut bench = Workbench::of_file(file.path());
    bench.look(&Camera::perspective(DVec3::new(30.0, -17.0, 22.0), FOCUS, 45.0)).classify(&function(&[
        (0.1, [0.1, 0.3, 0.9], 0.0),
        (0.5, [0.9, 0.8, 0.2], 0.2),
        (1.0, [1.0, 1.0, 1.0], 0.6),
    ]));
    (bench, file)
}

#[test]
fn i4_early_termination_costs_no_more_than_allowed() {
    let (mut bench, _file) = bench();
    for classification in ["transfer_function", "preintegrated_full"] {
        for skipping in ["none", "distance"] {
            bench.put("traversal.classification", json!(classification)).put("traversal.skipping", json!(skipping));
            let whole = bench.put("traversal.termination_error", json!(0)).render(SIZE);
            assert_shows(&whole, "the thing");
            for error in [0.3, 0.1, 0.01, 0.002] {
                let found = bench.put("traversal.termination_error", json!(error)).render(SIZE);
                let most = difference(&whole, &found);
                println!("I4, {classification}, {skipping}, {error} allowed: largest difference {most:.2e}");
                assert!(most <= error + TERMINATION, "{classification}, {skipping}, {error}: {most}");
                // It must have happened, and must only have left something out.
                assert!(most > 0.01 * error, "{classification}, {skipping}, {error}: {most}");
                let pairs = whole.color.iter().zip(&found.color);
                assert!(pairs.clone().all(|(whole, found)| f64::from(found[3] - whole[3]) <= TERMINATION));
            }
        }
    }
}

#[test]
fn i10_far_cameras_come_to_parallel_ones_with_their_distance() {
    let (mut bench, _file) = bench();
    let (direction, height) = (DVec3::new(0.8, -0.45, 0.39).normalize(), 26.0_f64);
    let parallel = bench.look(&Camera::orthographic(FOCUS + 100.0 * direction, FOCUS, height)).render(SIZE);
    assert_shows(&parallel, "the thing");
    let departures = [1e3, 1e4, 1e5].map(|distance: f64| {
        let fov = 2.0 * (0.5 * height / distance).atan();
        let found =
            bench.look(&Camera::perspective(FOCUS + distance * direction, FOCUS, fov.to_degrees())).render(SIZE);
        // The mean: at the outline of the box single pixels may jump.
        let pairs = parallel.color.iter().flatten().zip(found.color.iter().flatten());
        pairs.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / (4 * parallel.color.len()) as f64
    });
    println!("I10: mean differences {departures:?} at distances of 1e3, 1e4 and 1e5 voxels");
    let orders = departures.windows(2).map(|pair| (pair[0] / pair[1]).log10());
    let orders: Vec<f64> = orders.collect();
    assert!(orders.iter().all(|order| FIRST_ORDER.contains(order)), "{orders:?}");
}

#[test]
fn i11_denser_material_is_nowhere_less_opaque() {
    let (mut bench, _file) = bench();
    for classification in ["transfer_function", "preintegrated_fast", "preintegrated_full"] {
        bench.put("traversal.classification", json!(classification));
        let mut before: Option<Vec<f32>> = None;
        for density in [0.001, 0.1, 0.5, 0.99, 1.0, 1.01, 2.0, 30.0] {
            let picture = bench.put("traversal.reference_length", json!(1.0 / density)).render(SIZE);
            let opacities: Vec<f32> = picture.color.iter().map(|pixel| pixel[3]).collect();
            if let Some(before) = before {
                let less = opacities.iter().zip(&before).filter(|(now, before)| f64::from(**before - **now) > FURNACE);
                assert_eq!(less.count(), 0, "{classification}, density {density}");
                assert!(opacities.iter().zip(&before).any(|(now, before)| now > before));
            }
            before = Some(opacities);
        }
    }
}
