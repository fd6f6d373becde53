//! T19 a checkerboard of voxels: what interpolation before and after classification, and none at all, make of it.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::homogeneous_opacity;
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{chords, tabulated};
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::largest;

/// Voxels along an edge of the unit cube; values 0 and 1 in turns.
const VOXELS: u32 = 16;
const SIZE: [u32; 2] = [48, 48];

/// Along x a trilinear field runs up and down between this value and 1 less it, y and z in voxels.
fn higher(y: f64, z: f64) -> f64 {
    let fraction = |x: f64| (x - 0.5).rem_euclid(1.0);
    0.5 + 0.5 * ((1.0 - 2.0 * fraction(y)) * (1.0 - 2.0 * fraction(z))).abs()
}

/// Length along x on which a trilinear field lies above `threshold`, in voxels: a part of each rise and fall, and of the two
/// constant half voxels at the ends the one that is high.
fn length_above(threshold: f64, higher: f64) -> f64 {
    let share = ((higher - threshold) / (2.0 * higher - 1.0)).max(0.0);
    f64::from(VOXELS - 1) * share + if higher > threshold { 0.5 } else { 0.0 }
}

/// Largest error of the opacity of a ray along x, whose exact optical depth is a function of y and z in voxels.
fn error(bench: &mut Workbench, depth: impl Fn(f64, f64) -> f64) -> f64 {
    let camera = Camera::orthographic(DVec3::X * -3.0, DVec3::ZERO, 0.83);
    let volume = bench.volume();
    let picture = bench.look(&camera).render(SIZE);
    let pixels = chords(&camera, SIZE, &volume, &AxisBox::UNIT).into_iter().zip(picture.color);
    let errors = pixels.filter_map(|(chord, pixel)| {
        let place = (chord?.middle() + 0.5) * f64::from(VOXELS);
        Some((f64::from(pixel[3]) - homogeneous_opacity(depth(place.y, place.z), 1.0)).abs())
    });
    largest(&errors.collect::<Vec<_>>())
}

#[test]
fn t19_a_checkerboard_of_voxels() {
    let (tau, threshold) = (3.0, 0.75);
    let mut bench = Workbench::of_generator(
        &json!({"field": "checkerboard", "cells": VOXELS, "dims": [VOXELS, VOXELS, VOXELS], "extent": [1.0, 1.0, 1.0]}),
    );
    let range = bench.volume().ranges()[0];
    bench.classify(&tabulated(range, |s| tau * s, |_| [1.0; 3]));
    for sampling in ["nearest", "filtered", "trilinear"] {
        for rate in [1.0, 2.0, 6.0] {
            bench.put("traversal.sampling", json!(sampling)).put("traversal.sampling_rate", json!(rate));
            let found = error(&mut bench, |_, _| 0.5 * tau);
            println!("T19, linear, {sampling}, rate {rate}: largest error {found:.2e}");
            assert!(found <= OPACITY, "{sampling}, rate {rate}: {found}");
        }
    }
    let step = Knot::split(threshold, ([1.0; 3], 0.0), ([1.0; 3], 1.0 - (-tau).exp()));
    bench.classify(&TransferFunction::new(vec![step]).expect("one knot")).put("traversal.sampling", json!("nearest"));
    let found = error(&mut bench, |_, _| 0.5 * tau);
    println!("T19, step, nearest: largest error {found:.2e}");
    assert!(found <= OPACITY, "nearest: {found}");
    let voxel = 1.0 / f64::from(VOXELS);
    let post = |y, z| tau * voxel * length_above(threshold, higher(y, z));
    bench.put("traversal.sampling", json!("trilinear"));
    for rate in [7.3, 31.7, 130.3] {
        let found = error(bench.put("traversal.sampling_rate", json!(rate)), post);
        // At each of the crossings half a step, of a field that takes two voxels from 0 to 1.
        let bound = tau * f64::from(VOXELS) * voxel * (0.5 / rate + STEP_PLACE);
        println!("T19, step, trilinear, rate {rate}: largest error {found:.2e}, bound {bound:.2e}");
        assert!(found <= bound, "rate {rate}: {found}");
    }
}
