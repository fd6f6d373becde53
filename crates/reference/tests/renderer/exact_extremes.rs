//! The exact renderer where geometry and material are extreme.

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::closed_forms::*;
use rayloom_reference::shading::Shading;
use rayloom_reference::{Camera, MISS, Method, Refinement, Scene, exact, same_samples};
use rayloom_volume::{Knot, TransferFunction, Volume, Voxels};

const ALL: [Method; 6] = [
    Method::Dvr,
    Method::Mip,
    Method::MinIp,
    Method::Mean,
    Method::Sum,
    Method::Isosurface { value: 0.5, refinement: Refinement::Linear },
];

fn pixel(scene: &Scene<'_>) -> [f64; 4] {
    exact::render(scene).expect("the scene makes sense").pixel(0, 0)
}

fn cube(values: &[f64], dims: [u32; 3]) -> Volume {
    let to_world = filling(dims, DVec3::ZERO, DVec3::ONE);
    Volume::new("cube", dims, 1, Voxels::F64(values.to_vec()), to_world).expect("a volume")
}

#[test]
fn single_voxels() {
    let volume = cube(&[0.6], [1; 3]);
    let knots = vec![Knot::new(0.2, [0.0; 3], 0.0), Knot::new(1.0, [1.0; 3], 0.8)];
    let mut scene = Scene::new(&volume, TransferFunction { knots }, along_x(0.4, 0.3), [1, 1]);
    assert!((pixel(&scene)[3] - 0.4).abs() < 1e-15 && (pixel(&scene)[0] - 0.5 * 0.4).abs() < 1e-15);
    for method in [Method::Mip, Method::MinIp, Method::Mean] {
        scene.method = method;
        assert!((pixel(&scene)[3] - 0.4).abs() < 1e-15);
    }
    // No range, so no normalised value but zero.
    scene.method = Method::Sum;
    assert!((pixel(&scene)[3] - 0.4).abs() < 1e-15);
    scene.method = ALL[5];
    assert_eq!(pixel(&scene), [0.0; 4]);
    // Lit, a field without gradient is unlit.
    (scene.method, scene.shading) = (Method::Dvr, Some(Shading::default()));
    assert!((pixel(&scene)[0] - 0.5 * 0.4).abs() < 1e-15);
}

#[test]
fn slabs_of_one_voxel() {
    let volume = volume([8, 8, 1], filling([8, 8, 1], DVec3::NEG_ONE, DVec3::new(1.0, 1.0, 0.1)), |p| p.x);
    let mut scene = Scene::new(&volume, uniform([1.0; 3], 2.0), along_x(0.1, -0.3), [1, 1]);
    scene.camera = Camera::orthographic(DVec3::new(1.0, 0.0, 5.0), DVec3::ZERO, 1.0);
    let expected = homogeneous_opacity(2.0, 1.1 * DVec3::new(1.0, 0.0, 5.0).length() / 5.0);
    assert!((pixel(&scene)[3] - expected).abs() < 1e-14);
}

#[test]
fn opaque_material() {
    let volume = volume([5, 3, 3], filling([5, 3, 3], DVec3::ZERO, DVec3::ONE), |p| p.x);
    // Reached at a single value, reached and kept, and everywhere.
    let rising = [Knot::new(0.2, [0.0; 3], 0.0), Knot::new(0.6, [1.0; 3], 1.0)];
    let kept = [rising[0], rising[1], Knot::new(0.9, [1.0; 3], 1.0)];
    let everywhere = [Knot::new(0.0, [0.3; 3], 1.0)];
    for knots in [rising.to_vec(), kept.to_vec(), everywhere.to_vec()] {
        let mut scene = Scene::new(&volume, TransferFunction { knots }, along_x(0.4, 0.3), [1, 1]);
        for reference_length in [1e-6, 1.0, 1e3] {
            scene.reference_length = reference_length;
            let found = pixel(&scene);
            assert_eq!(found[3], 1.0);
            assert!(found[0] > 0.0 && found[0] <= 1.0, "{found:?}");
        }
    }
    // The peak of a tent that just reaches opacity 1 is finite: two poles of the logarithm.
    let tent = vec![Knot::new(0.3, [1.0; 3], 0.0), Knot::new(0.5, [1.0; 3], 1.0), Knot::new(0.7, [1.0; 3], 0.0)];
    let scene = Scene::new(&volume, TransferFunction { knots: tent }, along_x(0.4, 0.3), [1, 1]);
    let expected = homogeneous_opacity(2.0 * 0.2 * linear_opacity_depth(1.0, 1.0), 1.0);
    assert!((pixel(&scene)[3] - expected).abs() < 1e-12, "{} {expected}", pixel(&scene)[3]);
    // Behind an opaque front only the colour at the front shows, up to what a millionth of a reference length lets through.
    let wall = vec![Knot::split(0.4, ([1.0; 3], 0.0), ([0.25, 0.5, 1.0], 1.0)), Knot::new(0.9, [1.0, 0.0, 0.0], 1.0)];
    let mut scene = Scene::new(&volume, TransferFunction { knots: wall }, along_x(0.4, 0.3), [1, 1]);
    let found = pixel(&scene);
    assert!((found[0] - 0.25 - 0.75 / 0.5 / 1e6).abs() < 1e-11 && found[3] == 1.0, "{found:?}");
    // And its light is that of the front.
    scene.shading = Some(Shading { diffuse: 0.0, specular: 0.0, ambient: 0.5, ..Shading::default() });
    assert!((pixel(&scene)[0] - 0.5 * found[0]).abs() < 1e-11);
}

#[test]
fn faint_material() {
    let volume = volume([9, 3, 3], filling([9, 3, 3], DVec3::ZERO, DVec3::ONE), |p| p.x);
    let knots = vec![Knot::new(0.0, [1.0; 3], 1e-8), Knot::new(1.0, [1.0; 3], 1e-8 * (1.0 + 1e-9))];
    let scene = Scene::new(&volume, TransferFunction { knots }, along_x(0.4, 0.3), [1, 1]);
    assert!((pixel(&scene)[3] / 1e-8 - 1.0).abs() < 1e-8);
}

#[test]
fn knots_on_the_very_values_of_voxels() {
    // Right-continuous at 100, whatever the weights round to, in a plateau and on the way to it.
    let volume = volume([9, 4, 4], filling([9, 4, 4], DVec3::ZERO, DVec3::new(9.0, 4.0, 4.0)), |p| {
        if p.x < 4.0 { 0.1 } else { 0.3 }
    });
    let camera = Camera::perspective(DVec3::new(-7.3, 2.9, 1.1), DVec3::new(4.0, 2.1, 1.9), 1.0);
    let scene = Scene::new(&volume, step(0.3, 1.0), camera, [1, 1]);
    let direction = (camera.focus - camera.eye).normalize();
    let found = pixel(&scene)[3];
    assert!((found - homogeneous_opacity(1.0, 4.5 / direction.x)).abs() < 1e-12, "{found}");
    let below = Scene::new(&volume, step(0.3_f64.next_up(), 1.0), camera, [1, 1]);
    assert_eq!(pixel(&below), [0.0; 4]);
}

#[test]
fn surfaces_on_plateaus() {
    let to_world = filling([10, 4, 4], DVec3::ZERO, DVec3::new(10.0, 4.0, 4.0));
    let plateau = volume([10, 4, 4], to_world, |p| if (4.0..7.0).contains(&p.x) { 0.7 } else { 0.1 });
    let camera = Camera::perspective(DVec3::new(-5.0, 2.3, 1.2), DVec3::new(5.0, 1.9, 2.1), 1.0);
    let mut scene = Scene::new(&plateau, uniform([1.0; 3], 1.0), camera, [1, 1]);
    let mut hit = |value| {
        scene.method = Method::Isosurface { value, refinement: Refinement::None };
        exact::Renderer::new(&scene).expect("the scene makes sense").surface(0, 0)
    };
    // The voxel centre at 4.5 is where the plateau begins: it belongs to the inside.
    let at_top = hit(0.7).expect("the plateau is met");
    assert!((at_top.world.x - 4.5).abs() < 1e-12, "{at_top:?}");
    assert!((hit(0.4).expect("the slope is met").world.x - 4.0).abs() < 1e-12);
    assert_eq!(hit(0.7 + 1e-9), None);
    // All is inside 0.1: there is nothing to cross.
    assert_eq!(hit(0.1), None);
}

#[test]
fn rays_along_faces_edges_and_centers() {
    let dims = [4, 4, 4];
    let volume = volume(dims, filling(dims, DVec3::ZERO, DVec3::splat(4.0)), noise);
    let exact_and_sampled = |y: f64, z: f64| {
        let mut scene = Scene::new(&volume, colorful(), along_x(y, z), [1, 1]);
        (scene.step, scene.reference_length) = (scene.step / 4000.0, 2.0);
        let sampled = same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0);
        (pixel(&scene), sampled)
    };
    // Voxel centres lie at halves, so faces of cells do; the box ends at whole numbers.
    for (y, z) in [(0.0, 0.0), (0.0, 1.3), (0.5, 0.5), (0.5, 1.7), (2.5, 3.5), (4.0, 2.0), (4.0, 4.0), (1.0, 3.9)] {
        let (found, expected) = exact_and_sampled(y, z);
        assert!(found[3] > 0.0);
        assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-6), "{y} {z}: {found:?} {expected:?}");
    }
    // Along the diagonal, through voxel centres and corners of cells only.
    let camera = Camera::orthographic(DVec3::splat(-2.0), DVec3::splat(4.0), 1.0);
    let mut scene = Scene::new(&volume, colorful(), camera, [1, 1]);
    scene.reference_length = 2.0;
    let found = pixel(&scene);
    scene.step /= 4000.0;
    let expected = same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0);
    assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-6), "{found:?} {expected:?}");
}

#[test]
fn cameras_inside_and_near_planes() {
    let volume = volume([5; 3], filling([5; 3], DVec3::ZERO, DVec3::ONE), |_| 1.0);
    let camera = Camera::perspective(DVec3::new(0.3, 0.5, 0.5), DVec3::new(2.0, 0.5, 0.5), 1.0);
    let mut scene = Scene::new(&volume, uniform([1.0; 3], 1.7), camera, [1, 1]);
    assert!((pixel(&scene)[3] - homogeneous_opacity(1.7, 0.7)).abs() < 1e-15);
    scene.camera.near = Some(0.2);
    let image = exact::render(&scene).expect("the scene makes sense");
    assert!((image.pixel(0, 0)[3] - homogeneous_opacity(1.7, 0.5)).abs() < 1e-15);
    assert!((image.depth[0] - 0.2).abs() < 1e-15);
    scene.camera.near = Some(0.8);
    assert_eq!(exact::render(&scene).expect("the scene makes sense").depth, [MISS]);
}

#[test]
fn worlds_of_any_size() {
    let dims = [6, 5, 4];
    let original = volume(dims, filling(dims, DVec3::ZERO, DVec3::ONE), noise);
    let eye = DVec3::new(2.0, 1.4, -1.8);
    for method in ALL {
        let render = |scale: f64| {
            let mut scaled = original.clone();
            scaled.index_to_world = DAffine3::from_mat3(DMat3::IDENTITY * scale) * original.index_to_world;
            let camera = Camera::perspective(scale * eye, scale * DVec3::splat(0.5), 30.0);
            let mut scene = Scene::new(&scaled, colorful(), camera, [6, 6]);
            (scene.method, scene.reference_length) = (method, 0.2 * scale);
            scene.shading = Some(Shading::default());
            exact::render(&scene).expect("the scene makes sense")
        };
        let expected = render(1.0);
        for scale in [1e-9, 1e9] {
            let found = render(scale);
            let pairs = found.color.iter().flatten().zip(expected.color.iter().flatten());
            let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-9, "{method:?} {scale}: {worst:e}");
        }
    }
}

/// Along x, the cells at a voxel without value are left out: two of six.
#[test]
fn gaps_are_left_out() {
    let values = [0.25, 0.25, f64::NAN, 0.25, 0.75, 0.75];
    let volume = cube(&values, [6, 1, 1]);
    let mut scene = Scene::new(&volume, uniform([1.0; 3], 2.0), along_x(0.4, 0.3), [1, 1]);
    assert!((pixel(&scene)[3] - homogeneous_opacity(2.0, 4.0 / 6.0)).abs() < 1e-14);
    // Cells cover 0.25 for one and a half voxels, a ramp for one and 0.75 for one and a half.
    let knots = vec![Knot::new(0.0, [0.0; 3], 0.5), Knot::new(1.0, [1.0; 3], 0.5)];
    (scene.method, scene.classification) = (Method::Mean, TransferFunction { knots }.into());
    assert!((pixel(&scene)[0] / pixel(&scene)[3] - 0.5).abs() < 1e-14);
    scene.step /= 6000.0;
    let sampled = same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0);
    assert!((sampled[0] / sampled[3] - 0.5).abs() < 1e-4);
    // No surface is crossed in a gap: the ray meets the one behind.
    scene.method = Method::Isosurface { value: 0.2, refinement: Refinement::Linear };
    assert_eq!(pixel(&scene), [0.0; 4]);
    scene.method = Method::Isosurface { value: 0.5, refinement: Refinement::Linear };
    let depth = exact::render(&scene).expect("the scene makes sense").depth[0];
    assert_eq!(same_samples::render(&scene).expect("the scene makes sense").depth[0] < MISS, depth < MISS);
    let all = cube(&[f64::NAN; 8], [2; 3]);
    for method in ALL {
        let scene = Scene { method, ..Scene::new(&all, uniform([1.0; 3], 2.0), along_x(0.4, 0.3), [1, 1]) };
        assert_eq!(pixel(&scene), [0.0; 4]);
        assert_eq!(same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0), [0.0; 4]);
    }
}

#[test]
fn broken_voxels_and_empty_functions() {
    let values: Vec<f64> =
        (0..27).map(|i| [0.2, f64::NAN, f64::INFINITY, 0.9, f64::NEG_INFINITY, 1e-310][i % 6]).collect();
    let volume = cube(&values, [3; 3]);
    for method in ALL {
        for shading in [None, Some(Shading::default())] {
            let camera = Camera::perspective(DVec3::new(2.0, 1.4, -1.8), DVec3::splat(0.5), 30.0);
            let mut scene = Scene::new(&volume, colorful(), camera, [8, 8]);
            (scene.method, scene.shading) = (method, shading);
            let image = exact::render(&scene).expect("the scene makes sense");
            assert!(image.color.iter().flatten().all(|c| c.is_finite()));
            scene.classification = TransferFunction::default().into();
            let empty = exact::render(&scene).expect("the scene makes sense");
            let surface = matches!(method, Method::Isosurface { .. });
            assert!(surface || empty.color.iter().all(|pixel| *pixel == [0.0; 4]));
        }
    }
}
