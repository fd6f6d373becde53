//! T12 planes and T13 spheres: where rays meet them, and their normals.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{plane_hit, sphere_hit, sphere_normal};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{Chord, chords};
use rayloom_tests::{Grid, Picture, Workbench, tolerances::*};
use serde_json::json;

use crate::{largest, orders, rms, scientific};

const SIZE: [u32; 2] = [48, 48];

fn with_isosurface(bench: &mut Workbench, isovalue: f64, refinement: &str) {
    bench.put("traversal.compositing", json!("isosurface")).put("traversal.compositing.isovalue", json!(isovalue));
    bench.put("traversal.refinement", json!(refinement));
    if refinement == "bisection" {
        bench.put("traversal.refinement.halvings", json!(22));
    }
}

/// The unit normal, towards larger values, that a first-hit normal image holds.
fn normal(pixel: [f32; 4]) -> DVec3 {
    let [x, y, z, _] = pixel.map(f64::from);
    -(DVec3::new(x, y, z) * 2.0 - 1.0)
}

/// Distances along the rays, world units, between the depths of a picture and of a formula; where the formula says that the
/// surface is met well within the box, the picture must have met it.
fn distances(picture: &Picture, chords: &[Option<Chord>], hit: impl Fn(&Chord) -> Option<f64>) -> Vec<f64> {
    let mut found = Vec::new();
    for (chord, depth) in chords.iter().zip(&picture.depth) {
        let Some((chord, t)) = chord.as_ref().and_then(|chord| Some((chord, hit(chord)?))) else { continue };
        let margin = 0.01 * (chord.segment.to - chord.segment.from);
        if t > chord.segment.from + margin && t < chord.segment.to - margin {
            found.push((f64::from(*depth) - t).abs() * chord.ray.direction.length());
        }
    }
    found
}

#[test]
fn t12_a_plane_is_met_exactly_and_has_one_normal() {
    let voxels = 16;
    let up = DVec3::new(0.36, 0.48, 0.8);
    let dims = [voxels; 3];
    // One voxel is one unit.
    let file = Grid::of_world(dims, Grid::centered(dims, DVec3::splat(f64::from(voxels))), |p| up.dot(p)).save();
    let mut bench = Workbench::of_file(file.path());
    let inner = [0.5, f64::from(voxels) - 0.5];
    for axis in ["x", "y", "z"] {
        bench.put(&format!("proxy.clip_{axis}"), json!(inner));
    }
    let [low, high] = inner.map(|edge| edge / f64::from(voxels));
    let clip = AxisBox { min: DVec3::splat(low), max: DVec3::splat(high) };
    let offset = 1.7;
    let near = Camera::perspective(DVec3::new(9.0, 11.0, 13.0), DVec3::ZERO, 50.0);
    let parallel = Camera::orthographic(DVec3::new(5.0, 9.0, 14.0), DVec3::ZERO, 12.0);
    let volume = bench.volume();
    for camera in [near, parallel] {
        let chords = chords(&camera, SIZE, &volume, &clip);
        bench.look(&camera);
        for (sampling, allowed) in [("filtered", PLANE_FILTERED), ("trilinear", PLANE)] {
            for refinement in ["linear", "secant", "bisection"] {
                with_isosurface(&mut bench, offset, refinement);
                let picture = bench.put("traversal.sampling", json!(sampling)).render(SIZE);
                let found = distances(&picture, &chords, |c| plane_hit(c.ray.origin, c.ray.direction, up, offset));
                println!(
                    "T12 {sampling}, {refinement}: {} hits, largest error {:.2e} voxels",
                    found.len(),
                    largest(&found)
                );
                assert!(found.len() > 700, "only {} rays met the plane", found.len());
                assert!(largest(&found) <= allowed, "{sampling}, {refinement}: {}", largest(&found));
            }
        }
        bench
            .put("traversal.compositing", json!("first_hit_normal"))
            .put("traversal.classification", json!("threshold"));
        bench.put("traversal.classification.lower", json!(-100));
        for gradient in ["forward", "backward", "central", "central4", "sobel", "filtered"] {
            let picture = bench.put("traversal.gradient", json!(gradient)).render(SIZE);
            let hits = picture.color.iter().filter(|pixel| pixel[3] > 0.0);
            let worst = largest(&hits.map(|pixel| (normal(*pixel) - up).length()).collect::<Vec<_>>());
            println!("T12 {gradient}: largest error of a normal {worst:.2e}");
            assert!(worst <= PLANE_NORMAL, "{gradient}: {worst}");
        }
        bench.put("traversal.classification", json!("transfer_function"));
    }
}

#[test]
fn t13_a_sphere_converges_with_the_square_of_the_voxel() {
    let radius = 0.35;
    let camera = Camera::orthographic(DVec3::new(1.3, 0.9, 0.77), DVec3::ZERO, 0.8);
    let (mut places, mut normals) = (Vec::new(), Vec::new());
    for voxels in [24, 48, 96] {
        let mut bench = Workbench::of_generator(&json!({
            "field": "sphere_distance", "radius": 2.0 * radius, "dims": [voxels, voxels, voxels], "extent": [1.0, 1.0, 1.0],
        }));
        let volume = bench.volume();
        let chords = chords(&camera, SIZE, &volume, &AxisBox::UNIT);
        with_isosurface(&mut bench, 0.0, "bisection");
        let picture = bench.put("traversal.sampling", json!("trilinear")).look(&camera).render(SIZE);
        // Where the surface is met at less than 26 degrees its place along the ray is all but undefined.
        let hit = |chord: &Chord| {
            let t = sphere_hit(chord.ray.origin, chord.ray.direction, DVec3::ZERO, radius)?;
            (crate::blobs::impact(chord) < 0.9 * radius).then_some(t)
        };
        let found = distances(&picture, &chords, hit);
        assert!(found.len() > 1000, "only {} rays met the sphere", found.len());
        let h = 1.0 / f64::from(voxels);
        // A convex field is overestimated by up to h^2 / 8 of its Laplacian 2 / R, so surfaces shrink by that.
        let bound = h * h / (4.0 * radius) / (1.0_f64 - 0.81).sqrt();
        println!("T13, grid of {voxels}: largest error of a place {:.2e}, bound {bound:.2e}", largest(&found));
        assert!(largest(&found) <= SPHERE * bound, "{voxels}: {}", largest(&found));
        places.push(rms(&found));
        normals.push(rms(&normal_errors(&mut bench, radius)));
    }
    for (what, errors) in [("place", &places), ("normal", &normals)] {
        let orders = orders(errors);
        println!("T13 {what}: rms errors {}, orders {orders:.3?}", scientific(errors));
        assert!(orders.iter().all(|order| SECOND_ORDER.contains(order)), "{what}: {orders:?}");
    }
}

/// Angles, in radians, between the normals of central differences and those of the sphere through the points of first hit.
fn normal_errors(bench: &mut Workbench, radius: f64) -> Vec<f64> {
    bench
        .put("traversal.compositing", json!("first_hit_normal"))
        .put("traversal.compositing2", json!("first_hit_point"));
    bench.put("traversal.classification", json!("threshold")).put("traversal.classification.upper", json!(0));
    bench.put("traversal.classification.lower", json!(-10)).put("traversal.sampling_rate", json!(4));
    let to_world = bench.volume().texture_to_world();
    let normals = bench.render(SIZE);
    let points = bench.picture("traversal", "image2", SIZE);
    let hits = normals.color.iter().zip(&points.color).filter(|(pixel, _)| pixel[3] > 0.0);
    let errors = hits.map(|(pixel, point)| {
        let place = to_world.transform_point3(DVec3::from_array([point[0], point[1], point[2]].map(f64::from)));
        assert!(place.length() < 1.01 * radius, "a hit outside of the sphere: {place}");
        normal(*pixel).angle_between(sphere_normal(place, DVec3::ZERO))
    });
    errors.collect()
}
