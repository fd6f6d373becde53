//! E45, E50, E54, E61: samples, gradients and surfaces on data that leave no room.

use glam::{DAffine3, DVec3};
use rayloom_reference::Camera;
use rayloom_tests::rays::homogeneous;
use rayloom_tests::{Grid, Workbench, tolerances::*};
use serde_json::json;

use crate::{assert_sound, difference, function, outside, ramp, same_bits, shown};

/// Where the gradient is zero there is no surface to light: every shading gives the unlit medium.
#[test]
fn e45_without_gradient_there_is_no_light() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [6, 6, 6], "extent": [6, 6, 6]}));
    let camera = outside(DVec3::ZERO, 7.0);
    let medium = homogeneous(0.3, [0.2, 0.5, 0.9]);
    let unlit = shown(&mut bench, &camera, &medium, &[]);
    assert_sound(&unlit, "unlit");
    for shading in ["diffuse", "phong", "blinn_phong", "cook_torrance", "oren_nayar", "specular", "toon", "ward"] {
        for gradient in ["central", "central4", "sobel", "filtered", "forward"] {
            let lit = shown(&mut bench, &camera, &medium, &[("shading", shading), ("gradient", gradient)]);
            assert!(difference(&unlit, &lit) <= OPACITY, "{shading}, {gradient}: {}", difference(&unlit, &lit));
        }
    }
}

/// One voxel fills the view: float interpolation shows as many values as there are pixels, and no stairs.
#[test]
fn e50_magnified_voxels_are_smooth() {
    let file = Grid::of_index([2, 1, 1], DAffine3::IDENTITY, |[i, _, _]| f64::from(i)).save();
    let mut bench = Workbench::of_file(file.path());
    let camera = Camera { up: DVec3::X, ..Camera::orthographic(DVec3::new(0.5, 0.0, -9.0), DVec3::X * 0.5, 1.0) };
    bench.look(&camera).classify(&function(&[(0.0, [0.0; 3], 0.5), (1.0, [1.0; 3], 0.5)]));
    bench.put("traversal.compositing", json!("mip")).put("traversal.sampling", json!("trilinear"));
    let picture = bench.render([1, 2000]);
    let values: Vec<f32> = picture.color.iter().map(|[r, _, _, a]| r / a).collect();
    assert!(values.windows(2).all(|pair| pair[1] < pair[0]), "two pixels of 2000 show one value");
    let worst = (0..2000).map(|y| (f64::from(values[y]) - (1.0 - (y as f64 + 0.5) / 2000.0)).abs()).fold(0.0, f64::max);
    println!("E50: largest error of 2000 values in a voxel {worst:.2e}");
    assert!(worst <= PROJECTION, "{worst}");
}

/// Plateaus of 0 and 1 along x under isovalues on, between and beside them: one surface where the value first is not below the
/// isovalue, or where it first is, for rays that begin inside.
#[test]
fn e54_plateaus_on_the_isovalue_are_one_surface() {
    let values = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
    let file = Grid::of_index([6, 2, 2], DAffine3::IDENTITY, |[i, _, _]| values[i as usize]).save();
    let mut bench = Workbench::of_file(file.path());
    bench
        .look(&Camera::orthographic(DVec3::new(-10.0, 0.5, 0.5), DVec3::new(2.5, 0.5, 0.5), 1.0))
        .classify(&ramp(0.0, 1.0));
    bench.put("traversal.sampling", json!("trilinear")).put("traversal.compositing", json!("isosurface"));
    // Depths from the eye at x = -10, voxel centres at whole numbers; 0 and all below is inside everywhere.
    for (isovalue, x) in
        [(0.5, Some(1.5)), (1.0, Some(2.0)), (0.25, Some(1.25)), (0.0, None), (-1.0, None), (1.0 + 1e-6, None)]
    {
        for refinement in ["none", "linear", "bisection", "secant"] {
            for rate in [0.9, 1.0, 2.0, 7.3] {
                bench.put("traversal.refinement", json!(refinement)).put("traversal.sampling_rate", json!(rate));
                if refinement == "secant" {
                    bench.put("traversal.refinement.steps", json!(10));
                }
                let picture = bench.put("traversal.compositing.isovalue", json!(isovalue)).render([4, 4]);
                let depth = picture.depth[5];
                let name = format!("isovalue {isovalue}, {refinement}, rate {rate}");
                match x {
                    None => assert!(depth > 2.9e38, "{name}: hit at {depth}"),
                    Some(x) => {
                        // A surface that touches a plateau is found no later than a step behind it.
                        let (found, step) = (f64::from(depth) - 10.0, 1.0 / rate);
                        let exact = refinement == "secant" || refinement == "bisection";
                        let allowed = if exact && isovalue < 1.0 { 0.01 * step + 1e-5 } else { step };
                        assert!((found - x).abs() <= allowed + 1e-5, "{name}: {found} for {x}");
                    }
                }
            }
        }
    }
}

/// One visible voxel at every place within and at the edges of bricks: skipping changes no bit.
#[test]
fn e19_e61_single_voxels_at_every_place_of_a_brick() {
    let places = |n: u32| [0, 3, 4, n - 1];
    let dims = [11, 9, 13];
    let camera = outside(DVec3::new(5.0, 4.0, 6.0), 12.0);
    let mut seen = 0;
    for i in places(dims[0]) {
        for j in places(dims[1]) {
            for k in places(dims[2]) {
                let file =
                    Grid::of_index(dims, DAffine3::IDENTITY, |index| f64::from(u8::from(index == [i, j, k]))).save();
                let mut bench = Workbench::of_file(file.path());
                let mut with = |skipping: &str| {
                    shown(
                        &mut bench,
                        &camera,
                        &function(&[(0.0, [1.0; 3], 0.0), (1.0, [1.0; 3], 0.9)]),
                        &[("skipping", skipping)],
                    )
                };
                let plain = with("none");
                seen += u32::from(plain.color.iter().any(|pixel| pixel[3] > 0.01));
                for skipping in ["occupancy", "distance"] {
                    assert!(same_bits(&plain, &with(skipping)), "voxel {i} {j} {k}, {skipping}");
                }
            }
        }
    }
    assert_eq!(seen, 64, "some voxels were not seen at all");
}
