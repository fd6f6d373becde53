//! E5, E11 to E17, E46 to E49: where volumes lie and how large they are.

use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::homogeneous_opacity;
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{chords, homogeneous};
use rayloom_tests::{Grid, VolumeFile, Workbench, tolerances::*};
use serde_json::json;

use crate::{SIZE, assert_sound, difference, outside, ramp, same_bits, shown, thing_grid};

const LOOKS: [&[(&str, &str)]; 3] = [
    &[("shading", "blinn_phong")],
    &[("compositing", "mip")],
    &[
        ("compositing", "isosurface"),
        ("shading", "diffuse"),
        ("refinement", "secant"),
        ("compositing.isovalue", "0.45"),
    ],
];

/// The field x / `length` on 0..`length`, clipped to its voxel centres: `length` + 1 voxels of edge 1.
pub fn ramp_from_0_to_1(length: u32) -> (Workbench, AxisBox, VolumeFile) {
    let file =
        Grid::of_index([length + 1, 1, 1], DAffine3::IDENTITY, |[i, _, _]| f64::from(i) / f64::from(length)).save();
    let mut bench = Workbench::of_file(file.path());
    let ends = [0.5, f64::from(length) + 0.5];
    bench.put("proxy.clip_x", json!(ends));
    let [low, high] = ends.map(|end| end / f64::from(length + 1));
    (bench, AxisBox { min: DVec3::X * low, max: DVec3::new(high, 1.0, 1.0) }, file)
}

/// I7: the same picture whatever the unit of length is, with the reference length that the program chooses.
#[test]
fn e5_e13_e14_e46_worlds_of_any_size() {
    let view = |scale: f64, look: &[(&str, &str)]| {
        let file = thing_grid(DAffine3::from_scale(DVec3::splat(scale))).save();
        let mut bench = Workbench::of_file(file.path());
        bench.put("traversal.reference_length", json!(0));
        shown(&mut bench, &outside(scale * DVec3::new(6.5, 5.5, 4.5), 14.0 * scale), &ramp(0.0, 1.0), look)
    };
    for look in LOOKS {
        let expected = view(1.0, look);
        assert_sound(&expected, "1");
        for scale in [1e-36, 1e-20, 1e-9, 1e-3, 1e3, 1e9, 1e12, 1e20, 1e35] {
            let found = view(scale, look);
            let d = difference(&expected, &found);
            println!("I7, {look:?}, scale {scale:e}: largest difference {d:.2e}");
            assert!(d <= WORLDS, "{look:?}, {scale:e}: {d}");
        }
    }
}

/// I7: far from the world's origin, as geographic coordinates are.
#[test]
fn e15_worlds_far_from_the_origin() {
    let view = |shift: DVec3, look: &[(&str, &str)]| {
        let file = thing_grid(DAffine3::from_translation(shift)).save();
        let mut bench = Workbench::of_file(file.path());
        shown(&mut bench, &outside(shift + DVec3::new(6.5, 5.5, 4.5), 14.0), &ramp(0.0, 1.0), look)
    };
    for look in LOOKS {
        let expected = view(DVec3::ZERO, look);
        for shift in [DVec3::new(6.2e6, -4.5e5, 1e6), DVec3::splat(1e8)] {
            let d = difference(&expected, &view(shift, look));
            println!("I7, {look:?}, shifted by {shift}: largest difference {d:.2e}");
            assert!(d <= WORLDS, "{look:?}, {shift}: {d}");
        }
    }
}

/// A sheared, mirrored and stretched grid: chords of a homogeneous medium, and one normal of a plane field, which borders do
/// not change.
#[test]
fn e11_e16_e47_e48_sheared_and_stretched_grids() {
    let up = DVec3::new(0.36, 0.48, 0.8);
    let shear = DMat3::from_cols(DVec3::NEG_X, DVec3::new(0.4, 1.2, 0.0), DVec3::new(0.2, -0.3, 0.9));
    let stretch = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 10.0));
    for (name, matrix) in [("sheared", shear), ("1:1:10", stretch), ("sheared 1:1:10", shear * stretch)] {
        let to_world = DAffine3::from_mat3(matrix);
        let file = Grid::of_world([9, 8, 7], to_world, |p| up.dot(p)).save();
        let mut bench = Workbench::of_file(file.path());
        let volume = bench.volume();
        let corner = |u: f64| volume.texture_to_world().transform_point3(DVec3::splat(u));
        let (center, extent) = (corner(0.5), corner(0.5).distance(corner(1.0)));
        let tau = 1.0 / extent;
        bench.classify(&homogeneous(tau, [1.0; 3])).put("traversal.sampling", json!("trilinear"));
        for camera in [
            outside(center, 1.6 * extent),
            Camera::orthographic(center + DVec3::new(0.3, -9.0, 2.0) * extent, center, extent),
        ] {
            let picture = bench.put("traversal.compositing", json!("dvr")).look(&camera).render(SIZE);
            let mut met = 0;
            for (chord, pixel) in chords(&camera, SIZE, &volume, &AxisBox::UNIT).iter().zip(&picture.color) {
                let Some(chord) = chord.as_ref().filter(|chord| chord.length > 0.2 * extent) else { continue };
                let error = (f64::from(pixel[3]) - homogeneous_opacity(tau, chord.length)).abs();
                assert!(error <= 1e-5, "{name}: {error:e}");
                met += 1;
            }
            assert!(met > 40, "{name}: only {met} rays are long");
            bench.put("traversal.compositing", json!("first_hit_normal"));
            for gradient in ["forward", "backward", "central", "central4", "sobel"] {
                let picture = bench.put("traversal.gradient", json!(gradient)).render(SIZE);
                let hits: Vec<_> = picture.color.iter().filter(|pixel| pixel[3] > 0.0).collect();
                let normal =
                    |p: &[f32; 4]| -(DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])) * 2.0 - 1.0);
                let worst = hits.iter().map(|p| (normal(p) - up).length()).fold(0.0, f64::max);
                println!("E48 {name}, {gradient}: {} normals, largest error {worst:.2e}", hits.len());
                assert!(hits.len() > 40 && worst <= STRETCHED_NORMAL, "{name}, {gradient}: {worst}");
            }
        }
    }
}

/// Planes that cut away all of a volume or nothing, or miss it by far: borders of the volume are visible here.
#[test]
fn e12_clip_planes_beyond_the_box() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [8, 8, 8], "extent": [2, 2, 2]}));
    bench.classify(&homogeneous(1.0, [1.0; 3])).look(&outside(DVec3::ZERO, 2.5));
    let whole = bench.render(SIZE);
    bench.network.disconnect(("proxy", "geometry"), ("view", "geometry"));
    bench.add("clip", "clipped_proxy").join("proxy.geometry", "clip.geometry").join("clip.clipped", "view.geometry");
    bench.put("clip.normal", json!([1, 0, 0]));
    for (distance, invert, expected) in [
        (1.5, false, Some(&whole)),
        (-1.5, true, Some(&whole)),
        (-1.5, false, None),
        (1.5, true, None),
        (-1e9, false, None),
    ] {
        bench.put("clip.distance", json!(distance)).put("clip.invert", json!(invert));
        let found = bench.render(SIZE);
        match expected {
            Some(whole) => assert!(difference(whole, &found) <= OPACITY, "{distance}: {}", difference(whole, &found)),
            None => assert!(found.color.iter().flatten().all(|c| *c == 0.0), "{distance}: something is left"),
        }
    }
    // A sliver of a millionth shows a millionth.
    bench.put("clip.invert", json!(false)).put("clip.distance", json!(-1.0 + 2e-6));
    let sliver = bench.render(SIZE);
    assert!(
        sliver.color.iter().all(|pixel| pixel[3] < 1e-3),
        "{:?}",
        sliver.color.iter().map(|p| p[3]).fold(0.0, f32::max)
    );
}

/// Every voxel lies where it should: seen alone, its centre is the centre of the picture that is centred on it.
#[test]
fn e49_single_voxels_are_where_they_should_be() {
    let to_world =
        DAffine3::from_translation(DVec3::new(10.0, -3.0, 0.5)) * DAffine3::from_scale(DVec3::new(1.0, 2.0, 0.5));
    for marked in [[0, 0, 0], [4, 6, 2], [2, 3, 1], [4, 0, 1]] {
        let file = Grid::of_index([5, 7, 3], to_world, |index| f64::from(u8::from(index == marked))).save();
        let mut bench = Workbench::of_file(file.path());
        let center = to_world.transform_point3(DVec3::from_array(marked.map(f64::from)));
        bench.put("traversal.sampling", json!("nearest")).put("traversal.compositing", json!("first_hit_point"));
        bench
            .classify(&crate::function(&[(0.5, [1.0; 3], 0.0), (1.0, [1.0; 3], 1.0)]))
            .put("traversal.sampling_rate", json!(64));
        for (axis, up, depth, width) in
            [(DVec3::X, DVec3::Y, 1.0, 2.0), (DVec3::Y, DVec3::Z, 2.0, 0.5), (DVec3::Z, DVec3::X, 0.5, 1.0)]
        {
            // The picture is twice as high as the voxel, so the voxel covers its middle half.
            let camera = Camera { up, ..Camera::orthographic(center - 30.0 * axis, center, 2.0 * width) };
            let picture = bench.look(&camera).render([1, 40]);
            let lit: Vec<usize> = (0..40).filter(|&y| picture.color[y][3] > 0.0).collect();
            assert_eq!((lit.first(), lit.last()), (Some(&10), Some(&29)), "{marked:?} along {axis}");
            let hit = f64::from(picture.depth[20]);
            assert!((hit - (30.0 - 0.5 * depth)).abs() <= depth / 64.0, "{marked:?} along {axis}: {hit}");
        }
    }
}

/// Directions of all faces, edges and corners from places on slabs, inside and outside are in `camera`; here the bits: an eye
/// a rounding away from a corner sees the same.
#[test]
fn e2_an_eye_a_rounding_away_from_a_corner() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [8, 8, 8], "extent": [2, 2, 2]}));
    bench.classify(&homogeneous(1.0, [1.0; 3]));
    for place in [DVec3::ONE, DVec3::new(1.0, -1.0, 0.2), DVec3::new(0.3, 1.0, 0.1)] {
        let mut at = |eye: DVec3| {
            let picture =
                bench.look(&Camera { up: DVec3::Z, ..Camera::perspective(eye, -0.3 * place, 60.0) }).render(SIZE);
            assert_sound(&picture, "near a corner");
            picture
        };
        let exact = at(place);
        for rounding in [f64::EPSILON, f64::from(f32::EPSILON)] {
            for sign in [-1.0, 1.0] {
                let d = difference(&exact, &at(place * (1.0 + sign * rounding)));
                assert!(d <= 1e-4, "{place} {rounding:e}: {d}");
            }
        }
    }
    let again = |bench: &mut Workbench| bench.render(SIZE);
    assert!(same_bits(&again(&mut bench), &again(&mut bench)));
}
