//! T10 Gaussian blobs and T11 homogeneous balls, seen askew.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{ball_opacity, gaussian_blob_opacity};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{Chord, chords, tabulated};
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::{largest, orders, rms, scientific};

const SIZE: [u32; 2] = [48, 48];
/// Half the edge of the box.
const HALF: f64 = 0.6;

fn camera() -> Camera {
    Camera::orthographic(DVec3::new(-2.0, 1.37, 1.11), DVec3::ZERO, 0.8)
}

/// Smallest distance of a ray from the origin.
pub fn impact(chord: &Chord) -> f64 {
    chord.ray.origin.cross(chord.ray.direction).length() / chord.ray.direction.length()
}

/// Differences from the exact opacity on all rays that come closer to the centre than `within`.
fn errors(bench: &mut Workbench, within: f64, exact: impl Fn(f64) -> f64) -> Vec<f64> {
    let volume = bench.volume();
    let picture = bench.look(&camera()).render(SIZE);
    let chords = chords(&camera(), SIZE, &volume, &AxisBox::UNIT);
    let impacts = chords.iter().map(|chord| chord.as_ref().map_or(f64::INFINITY, impact));
    let judged = impacts.zip(&picture.color).filter(|(b, _)| *b < within);
    judged.map(|(b, pixel)| (f64::from(pixel[3]) - exact(b)).abs()).collect()
}

#[test]
fn t10_a_gaussian_blob_converges_with_the_square_of_the_voxel() {
    let (peak, sigma) = (2.0, 0.1);
    let blob = |voxels: u32, rate: f64| {
        let mut bench = Workbench::of_generator(&json!({
            "field": "gaussian_blob", "sigma": sigma / HALF,
            "dims": [voxels, voxels, voxels], "extent": [2.0 * HALF, 2.0 * HALF, 2.0 * HALF],
        }));
        let range = bench.volume().ranges()[0];
        bench
            .classify(&tabulated(range, |value| peak * value, |_| [1.0; 3]))
            .put("traversal.sampling_rate", json!(rate));
        bench
    };
    let exact = |b: f64| gaussian_blob_opacity(peak, sigma, b);
    assert!((exact(0.0) - 0.394_272_857_9).abs() < 1e-9 && (exact(0.1) - 0.262_190_324_7).abs() < 1e-9);
    let grids = [24, 48, 96, 144];
    let found = grids.map(|voxels| rms(&errors(&mut blob(voxels, 1.0), 0.3, exact)));
    let found_orders = orders(&found[..3]);
    println!("T10: rms errors {} on grids of {grids:?}, orders {found_orders:.3?}", scientific(&found));
    assert!(found_orders.iter().all(|order| SECOND_ORDER.contains(order)), "{found_orders:?}");
    let worst = largest(&errors(&mut blob(144, 2.0), 0.3, exact));
    println!("T10: largest error {worst:.2e} on a grid of 144");
    assert!(worst <= BLOB, "{worst}");
}

#[test]
fn t11_a_homogeneous_ball_converges_with_the_step() {
    let (tau, radius, voxels): (f64, f64, u32) = (2.0, 0.4, 96);
    let mut bench = Workbench::of_generator(&json!({
        "field": "sphere_distance", "radius": radius / HALF,
        "dims": [voxels, voxels, voxels], "extent": [2.0 * HALF, 2.0 * HALF, 2.0 * HALF],
    }));
    let opacity = 1.0 - (-tau).exp();
    let knot = Knot::split(0.0, ([1.0; 3], opacity), ([1.0; 3], 0.0));
    bench.classify(&TransferFunction::new(vec![knot]).expect("one knot"));
    let range = bench.volume().ranges()[0].width() * HALF;
    let h = 2.0 * HALF / f64::from(voxels);
    let exact = |b: f64| ball_opacity(tau, radius, b);
    assert!((exact(0.0) - 0.798_103_482_0).abs() < 1e-9 && (exact(0.3) - 0.652_954_895_9).abs() < 1e-9);
    let mut found = Vec::new();
    for rate in [0.25, 0.5, 1.0, 2.0] {
        bench.put("traversal.sampling_rate", json!(rate));
        let errors = errors(&mut bench, 0.3, exact);
        // Half a step at either wall, and the displaced surface of the grid (met at 49 degrees at most).
        let walls = h / rate + (range * STEP_PLACE + h * h / (2.0 * radius)) / 0.66;
        let worst = largest(&errors);
        println!("T11, rate {rate}: rms {:.2e}, largest {worst:.2e}, bound {:.2e}", rms(&errors), tau * walls);
        assert!(worst <= tau * walls, "{rate}: {worst}");
        found.push(rms(&errors));
    }
    let order = (found[0] / found[3]).log2() / 3.0;
    println!("T11: mean order {order:.3}");
    assert!(FIRST_ORDER.contains(&order), "{order}");
}
