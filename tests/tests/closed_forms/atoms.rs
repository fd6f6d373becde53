//! T17 line integrals through hydrogen atoms.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{hydrogen_1s_projection, hydrogen_2pz_projection};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::chords;
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::blobs::impact;
use crate::{rms, scientific};

const SIZE: [u32; 2] = [40, 40];

/// Errors of the line integrals, as shares of that through the nucleus.
fn errors(field: &str, bohr: f64, voxels: u32, camera: &Camera, exact: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut bench = Workbench::of_generator(
        &json!({"field": field, "bohr": bohr, "dims": [voxels, voxels, voxels], "extent": [2.0, 2.0, 2.0]}),
    );
    let volume = bench.volume();
    let range = volume.ranges()[0];
    let grey = vec![Knot::new(range.min, [0.0; 3], 1.0), Knot::new(range.max, [1.0; 3], 1.0)];
    bench.classify(&TransferFunction::new(grey).expect("two knots"));
    bench.put("traversal.compositing", json!("mean")).put("traversal.sampling_rate", json!(4));
    let picture = bench.look(camera).render(SIZE);
    let chords = chords(camera, SIZE, &volume, &AxisBox::UNIT);
    let met = chords.iter().zip(&picture.color).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
    // The density has a cusp at the nucleus, where a grid is of first order only.
    let judged = met.filter(|(chord, _)| impact(chord) > bohr);
    let error = judged.map(|(chord, pixel)| {
        let integral = range.denormalise(f64::from(pixel[0])) * chord.length;
        (integral - exact(impact(chord))) / exact(0.0)
    });
    error.collect()
}

#[test]
fn t17_hydrogen_converges_with_the_square_of_the_voxel() {
    let askew = Camera::orthographic(DVec3::new(2.0, 1.37, 1.11), DVec3::ZERO, 1.2);
    // A height that spreads the pixels evenly over the voxels, along the axis where all rays pass them alike.
    let along = Camera { up: DVec3::Y, ..Camera::orthographic(DVec3::Z * 3.0, DVec3::ZERO, 1.07) };
    type Exact = fn(f64, f64) -> f64;
    let cases: [(&str, f64, Camera, Exact); 2] =
        [("hydrogen_1s", 0.12, askew, hydrogen_1s_projection), ("hydrogen_2p", 0.06, along, hydrogen_2pz_projection)];
    for (field, bohr, camera, exact) in cases {
        let found = [32, 64, 128].map(|voxels| rms(&errors(field, bohr, voxels, &camera, |b| exact(bohr, b))));
        let order = (found[0] / found[2]).log2() / 2.0;
        println!("T17, {field}: rms errors {}, mean order {order:.3}", scientific(&found));
        assert!(SECOND_ORDER.contains(&order), "{field}: {order}");
    }
}
