//! I8: the front half over the back half is the whole. I12: transparent voxels around a volume do not show.

use glam::{DAffine3, DVec3};
use rayloom_network::Value;
use rayloom_reference::Camera;
use rayloom_tests::rays::homogeneous;
use rayloom_tests::{Grid, Picture, Workbench, root, tolerances::*};
use rayloom_volume::TransferFunction;
use serde_json::json;

use crate::{SIZE, assert_shows, difference, function};

/// Cuts the volume of a chain across x at an edge between voxels and puts the picture of the lower part over that of the
/// upper.
fn front_over_back(bench: &mut Workbench, camera: &Camera, cut: u32, settings: &[(&str, Value)]) -> Picture {
    bench.add_traversal("2", "source.volume").look_from("view2", camera);
    for (property, value) in settings {
        bench.assign("traversal2", property, value.clone());
    }
    bench.put("proxy.clip_x", json!([0, cut])).put("proxy2.clip_x", json!([cut, 65536]));
    bench.add("compositor", "compositor").put("compositor.mode", json!("over"));
    bench.join("traversal.image", "compositor.first").join("traversal2.image", "compositor.second");
    let front = bench.picture("traversal", "image", SIZE);
    let back = bench.picture("traversal2", "image", SIZE);
    assert_shows(&front, "the front half");
    assert_shows(&back, "the back half");
    bench.picture("compositor", "image", SIZE)
}

/// The picture of the whole against that of its halves.
fn halves_differ_by(bench: &mut Workbench, camera: &Camera, cut: u32, settings: &[(&str, Value)]) -> f64 {
    for (property, value) in settings {
        bench.assign("traversal", property, value.clone());
    }
    let whole = bench.look(camera).render(SIZE);
    let halves = front_over_back(bench, camera, cut, settings);
    difference(&whole, &halves)
}

/// A chain on a head and a parallel view along its x axis, towards larger indices: a pixel's ray takes whole steps to every
/// edge between voxels.
fn head_along_x() -> (Workbench, Camera) {
    let mut bench = Workbench::of_file(&root().join("data/ch2.nii.gz"));
    let to_world = bench.volume().texture_to_world();
    let [eye, focus] = [-1.0, 0.5].map(|x| to_world.transform_point3(DVec3::new(x, 0.43, 0.57)));
    (bench, Camera { up: DVec3::Z, ..Camera::orthographic(eye, focus, 230.0) })
}

fn skin_and_bone() -> TransferFunction {
    function(&[(30.0, [0.4, 0.2, 0.1], 0.0), (110.0, [0.9, 0.8, 0.7], 0.02), (200.0, [1.0; 3], 0.2)])
}

#[test]
fn i8_halves_of_data_cut_between_steps() {
    for classification in ["transfer_function", "preintegrated_full"] {
        let (mut bench, camera) = head_along_x();
        let settings = [
            ("transfer_function", Value::TransferFunction(skin_and_bone())),
            ("classification", Value::Text(classification.into())),
        ];
        let found = halves_differ_by(&mut bench, &camera, 77, &settings);
        println!("I8, {classification}: largest difference {found:.2e}");
        assert!(found <= HALVES, "{classification}: {found}");
    }
}

#[test]
fn i8_halves_of_a_homogeneous_medium_seen_from_anywhere() {
    for camera in [
        Camera::perspective(DVec3::new(-14.0, 11.0, 9.0), DVec3::ZERO, 50.0),
        Camera::perspective(DVec3::new(-3.0, 1.0, 2.0), DVec3::new(2.0, 0.5, 0.0), 70.0),
        Camera::orthographic(DVec3::new(-9.0, -5.0, 4.0), DVec3::ZERO, 16.0),
    ] {
        let mut bench =
            Workbench::of_generator(&json!({"field": "constant", "dims": [12, 9, 10], "extent": [10.0, 9.0, 8.0]}));
        let settings = [("transfer_function", Value::TransferFunction(homogeneous(0.11, [0.9, 0.5, 0.2])))];
        let found = halves_differ_by(&mut bench, &camera, 5, &settings);
        println!("I8, homogeneous: largest difference {found:.2e}");
        assert!(found <= HALVES, "{found}");
    }
}

/// Voxels of a smooth thing that fades to zero at the border, with `pad` voxels of zero around.
fn padded(pad: u32) -> Grid {
    let dims = [20, 24, 18];
    let shift = DAffine3::from_translation(DVec3::splat(-f64::from(pad)));
    let to_world = Grid::centered(dims, DVec3::new(20.0, 24.0, 27.0)) * shift;
    Grid::of_index(dims.map(|n| n + 2 * pad), to_world, |index| {
        let at = |axis: usize| f64::from(index[axis]) - f64::from(pad);
        let window =
            |axis: usize| (std::f64::consts::PI * (at(axis) / f64::from(dims[axis] - 1)).clamp(0.0, 1.0)).sin();
        let [x, y, z] = [0, 1, 2].map(window);
        (x * y * z * (0.8 + 0.2 * (at(0) - at(1) * 0.7 + at(2)).sin())).max(0.0)
    })
}

#[test]
fn i12_transparent_voxels_around_do_not_show() {
    // Clear up to the second voxel from the border: at the border itself gradients are one-sided, with voxels around they are
    // not.
    let classification =
        function(&[(0.2, [0.2, 0.4, 1.0], 0.0), (0.5, [0.9, 0.9, 0.2], 0.15), (0.9, [1.0, 0.3, 0.1], 0.6)]);
    let center = DVec3::new(0.3, 0.2, -0.1);
    let along = |axis: DVec3, up: DVec3| Camera { up, ..Camera::orthographic(center + 40.0 * axis, center, 28.0) };
    let steps = [along(DVec3::X, DVec3::Z), along(-DVec3::Y, DVec3::Z), along(DVec3::Z, DVec3::Y)];
    let askew = [
        Camera::perspective(DVec3::new(-25.0, 31.0, 19.0), DVec3::ZERO, 45.0),
        Camera::perspective(DVec3::new(3.0, -2.0, 4.0), DVec3::new(-3.0, 5.0, -1.0), 75.0),
        Camera::orthographic(DVec3::new(9.0, 5.0, 14.0), DVec3::ZERO, 30.0),
    ];
    for (looks, compositing, shading) in
        [(0, "dvr", "none"), (1, "dvr", "blinn_phong"), (2, "mip", "none"), (3, "isosurface", "diffuse")]
    {
        let pictures = |pad: u32, camera: &Camera, clipped: bool| {
            let file = padded(pad).save();
            let mut bench = Workbench::of_file(file.path());
            bench.look(camera).classify(&classification).put("traversal.compositing", json!(compositing));
            // Which way a normal that is seen edge-on is turned, rounding would decide.
            bench.put("traversal.two_sided", json!(false));
            bench.put("traversal.shading", json!(shading)).put("traversal.refinement", json!("secant"));
            for (axis, voxels) in ["x", "y", "z"].into_iter().zip([20, 24, 18]).filter(|_| clipped) {
                bench.put(&format!("proxy.clip_{axis}"), json!([pad, pad + voxels]));
            }
            let picture = bench.render(SIZE);
            assert_shows(&picture, compositing);
            picture
        };
        let allowed = if shading == "none" { PADDED } else { PADDED_SHADED };
        for pad in [1, 5] {
            // Rays along an axis enter whole steps earlier.
            for camera in &steps {
                let found = difference(&pictures(0, camera, false), &pictures(pad, camera, false));
                println!("I12, look {looks}, {pad} voxels around, along an axis: largest difference {found:.2e}");
                assert!(found <= allowed, "{compositing}, {shading}: {found}");
            }
            // The others sample elsewhere. But cutting the clear voxels off moves no sample.
            for camera in &askew {
                let [whole, cut] = [false, true].map(|clipped| pictures(pad, camera, clipped));
                let found = difference(&whole, &cut);
                println!("I12, look {looks}, {pad} voxels around, askew and clipped: largest difference {found:.2e}");
                assert_eq!(found, 0.0, "{compositing}, {shading}");
            }
        }
    }
}
