//! T18 extreme and mean values along rays.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{gaussian_blob_maximum, linear_projection};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::chords;
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction, ValueRange};
use serde_json::json;

use crate::blobs::impact;
use crate::{largest, linear_slab, orders, rms, scientific, slab_cameras};

const SIZE: [u32; 2] = [32, 32];

/// Shows a value as opaque grey, black to white over 0 to 1.
fn shown_as_grey() -> TransferFunction {
    TransferFunction::new(vec![Knot::new(0.0, [0.0; 3], 1.0), Knot::new(1.0, [1.0; 3], 1.0)]).expect("two knots")
}

#[test]
fn t18_projections_of_a_linear_field() {
    let (mut bench, clip, _file) = linear_slab(13, 1.0, |x| x);
    let volume = bench.volume();
    assert_eq!(volume.ranges()[0], ValueRange::new(0.0, 1.0));
    bench.classify(&shown_as_grey());
    for camera in slab_cameras(1.0) {
        let chords = chords(&camera, SIZE, &volume, &clip);
        let mut mip_errors = Vec::new();
        // An even number of samples per voxel: the slab, which begins half a voxel inside of the box, begins with a whole step.
        for rate in [2.0, 4.0, 8.0, 16.0] {
            bench.put("traversal.sampling_rate", json!(rate));
            for method in ["mip", "minip", "mean"] {
                let picture = bench.put("traversal.compositing", json!(method)).look(&camera).render(SIZE);
                let pixels =
                    chords.iter().zip(&picture.color).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
                let shortfalls: Vec<[f64; 2]> = pixels
                    .map(|(chord, pixel)| {
                        let [from, to] = [chord.segment.from, chord.segment.to].map(|t| chord.ray.at(t).x);
                        let exact = linear_projection(from, to);
                        let value = f64::from(pixel[0]);
                        assert_eq!(pixel[3], 1.0, "{method}");
                        // Half a step, which is 1 / (13 rate) long, short of the end.
                        let half_step = (to - from).abs() / chord.length * 0.5 / (13.0 * rate);
                        match method {
                            "mip" => [exact.maximum - value, half_step],
                            "minip" => [value - exact.minimum, half_step],
                            _ => [(value - exact.mean).abs(), 0.0],
                        }
                    })
                    .collect();
                for [shortfall, allowed] in &shortfalls {
                    let rounding = PROJECTION + CHORD;
                    assert!(
                        (-rounding..=allowed + rounding).contains(shortfall),
                        "{method}, rate {rate}: {shortfall}, allowed {allowed}"
                    );
                }
                let worst = largest(&shortfalls.iter().map(|s| s[0].abs()).collect::<Vec<_>>());
                println!("T18 {method}, rate {rate:.2}: largest error {worst:.2e}");
                if method == "mip" {
                    mip_errors.push(rms(&shortfalls.iter().map(|s| s[0]).collect::<Vec<_>>()));
                }
            }
        }
        let order = (mip_errors[0] / mip_errors[3]).log2() / 3.0;
        println!("T18 mip: rms errors {}, mean order {order:.3}", scientific(&mip_errors));
        assert!(FIRST_ORDER.contains(&order), "{order}");
    }
}

#[test]
fn t18_the_maximum_of_a_gaussian_blob() {
    let (sigma, half) = (0.1, 0.6);
    let camera = Camera::orthographic(DVec3::new(-2.0, 1.37, 1.11), DVec3::ZERO, 0.8);
    let errors = |voxels: u32, rate: f64| -> Vec<f64> {
        let mut bench = Workbench::of_generator(&json!({
            "field": "gaussian_blob", "sigma": sigma / half,
            "dims": [voxels, voxels, voxels], "extent": [2.0 * half, 2.0 * half, 2.0 * half],
        }));
        bench.classify(&shown_as_grey()).put("traversal.compositing", json!("mip"));
        let volume = bench.volume();
        let picture = bench.put("traversal.sampling_rate", json!(rate)).look(&camera).render(SIZE);
        let chords = chords(&camera, SIZE, &volume, &AxisBox::UNIT);
        let judged = chords.iter().flatten().map(impact).zip(&picture.color).filter(|(b, _)| *b < 0.3);
        judged.map(|(b, pixel)| f64::from(pixel[0]) - gaussian_blob_maximum(1.0, sigma, b)).collect()
    };
    let found = [24, 48, 96].map(|voxels| rms(&errors(voxels, 1.0)));
    let found_orders = orders(&found);
    println!("T18 blob: rms errors {}, orders {found_orders:.3?}", scientific(&found));
    assert!(found_orders.iter().all(|order| SECOND_ORDER_IRREGULAR.contains(order)), "{found_orders:?}");
    // Between voxels a grid overestimates where the field is convex: by h^2 / 8 of its second derivatives, of which at most
    // two are positive and 2 exp(-3/2) / sigma^2 at most.
    let h = 2.0 * half / 96.0;
    let convex = h * h / 8.0 * 2.0 * 2.0 * (-1.5_f64).exp() / (sigma * sigma);
    for rate in [0.5, 1.0, 4.0] {
        let most = errors(96, rate).into_iter().fold(f64::NEG_INFINITY, f64::max);
        println!("T18 blob, rate {rate}: above the true maximum by {most:.2e} at most, {convex:.2e} allowed");
        assert!(most <= convex + PROJECTION, "{rate}: {most}");
    }
}
