//! Isosurfaces of planes and spheres (T12, T13), and lighting.

use crate::scenes::*;
use glam::{DMat3, DVec3};
use rayloom_reference::closed_forms::{plane_hit, sphere_hit, sphere_normal};
use rayloom_reference::same_samples::{Renderer, render};
use rayloom_reference::shading::{Diffuse, Highlight, LightSpace, Shading};
use rayloom_reference::{Camera, MISS, Method, Refinement, Scene, surface_points};
use rayloom_volume::Volume;
use std::f64::consts::PI;

const REFINEMENTS: [Refinement; 4] =
    [Refinement::None, Refinement::Linear, Refinement::Bisection(20), Refinement::Secant(6)];

fn isosurface(volume: &Volume, camera: Camera, value: f64, refinement: Refinement) -> Scene<'_> {
    let mut scene = Scene::new(volume, uniform([0.5, 1.0, 0.25], 0.1), camera, [8, 6]);
    scene.method = Method::Isosurface { value, refinement };
    scene
}

#[test]
fn planes_are_hit_exactly() {
    let dims = [8, 9, 10];
    // Stretched, sheared and mirrored: the normal must still be the one of the world.
    let mut to_world = filling(dims, DVec3::splat(-1.0), DVec3::new(1.0, 2.0, 1.5));
    to_world.matrix3 *= DMat3::from_cols(-DVec3::X, DVec3::new(0.3, 1.0, 0.0), DVec3::Z);
    let normal = DVec3::new(-0.36, 0.48, -0.8);
    let volume = volume(dims, to_world, |p| normal.dot(p));
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    let camera = Camera::perspective(center - 4.0 * normal + DVec3::new(0.3, 0.2, 0.0), center, 6.0);
    let offset = normal.dot(center);
    for (refinement, tolerance) in REFINEMENTS.into_iter().zip([0.5, 1e-12, 1e-6, 1e-12]) {
        let scene = isosurface(&volume, camera, offset, refinement);
        let renderer = Renderer::new(&scene).expect("the scene makes sense");
        let view = camera.view(scene.size).expect("the camera makes sense");
        for (x, y) in [(0, 0), (3, 4), (7, 5)] {
            let hit = renderer.surface(x, y).expect("the plane fills the view");
            let ray = view.ray(x, y);
            let expected = plane_hit(ray.origin, ray.direction, normal, offset).expect("the plane is not parallel");
            assert!((hit.depth - expected).abs() < tolerance, "{refinement:?}: {} {expected}", hit.depth);
            assert!(hit.world.abs_diff_eq(ray.at(hit.depth), 1e-12));
            assert!(hit.normal.abs_diff_eq(-normal, 1e-12), "{}", hit.normal);
            assert_eq!(renderer.pixel(x, y).depth, hit.depth);
            let points = surface_points(&scene, &render(&scene).expect("a picture")).expect("points");
            let point = points[(y * 8 + x) as usize].expect("the plane fills the view");
            assert_eq!(point.distance, hit.depth);
            assert!(point.normal.abs_diff_eq(-normal, 1e-12), "{}", point.normal);
        }
    }
}

#[test]
fn spheres_converge_with_order_two() {
    let radius = 0.61;
    let camera = Camera::perspective(DVec3::new(2.0, 1.0, 3.0), DVec3::ZERO, 9.0);
    let mut depth_errors = vec![];
    let mut normal_errors = vec![];
    for n in [16, 32, 64, 128] {
        let volume = volume([n; 3], filling([n; 3], DVec3::NEG_ONE, DVec3::ONE), |p| -p.length_squared());
        let scene = isosurface(&volume, camera, -radius * radius, Refinement::Secant(8));
        let renderer = Renderer::new(&scene).expect("the scene makes sense");
        let view = camera.view(scene.size).expect("the camera makes sense");
        let mut squares = [0.0, 0.0];
        for y in 0..6 {
            for x in 0..8 {
                let ray = view.ray(x, y);
                let expected =
                    sphere_hit(ray.origin, ray.direction, DVec3::ZERO, radius).expect("the sphere fills the view");
                let hit = renderer.surface(x, y).expect("the sphere fills the view");
                squares[0] += (hit.depth - expected).powi(2);
                squares[1] += (hit.normal - sphere_normal(ray.at(expected), DVec3::ZERO)).length_squared();
            }
        }
        depth_errors.push((squares[0] / 48.0).sqrt());
        normal_errors.push((squares[1] / 48.0).sqrt());
    }
    assert_order(&depth_errors, 2.0, 0.2);
    assert_order(&normal_errors, 2.0, 0.4);
}

#[test]
fn rays_that_miss_are_empty_and_rays_that_start_inside_come_out() {
    let volume = volume([16; 3], filling([16; 3], DVec3::NEG_ONE, DVec3::ONE), |p| 0.5 - p.length());
    let outside = isosurface(&volume, along_x(0.8, 0.0), 0.0, Refinement::Linear);
    let pixel = Renderer::new(&outside).expect("the scene makes sense").pixel(4, 3);
    assert_eq!((pixel.color, pixel.depth), ([0.0; 4], MISS));
    let inside = isosurface(&volume, Camera::perspective(DVec3::ZERO, DVec3::X, 1.0), 0.0, Refinement::Linear);
    let depth = Renderer::new(&inside).expect("the scene makes sense").pixel(4, 3).depth;
    assert!((depth - 0.5).abs() < 0.01);
}

#[test]
fn lighting_of_a_plane_is_the_formula() {
    let volume = volume([8; 3], filling([8; 3], DVec3::NEG_ONE, DVec3::ONE), |p| p.x);
    let mut scene = isosurface(&volume, along_x(0.0, 0.0), 0.0, Refinement::Linear);
    scene.size = [1, 1];
    let shading = Shading {
        ambient: 0.1,
        diffuse: 0.7,
        diffuse_term: Diffuse::Lambert,
        specular: 0.2,
        highlight: Highlight::BlinnPhong { shininess: 3.0 },
        light_direction: DVec3::new(-3.0, 0.0, 4.0),
        light_space: LightSpace::World,
        light_color: [1.0, 0.5, 0.0],
        two_sided: true,
        gradient_fade: 0.0,
    };
    let mut lit = |shading| {
        scene.shading = Some(shading);
        render(&scene).expect("the scene makes sense").pixel(0, 0)
    };
    // The viewer and the normal, which points to smaller values, are at -x: n·l = 0.6, n·h = cos(acos(0.6) / 2).
    let highlight = 0.2 * 0.8_f64.sqrt().powi(3);
    let expected = [0.5 * 0.52 + highlight, 1.0 * 0.31 + 0.5 * highlight, 0.25 * 0.1, 1.0];
    let close = |a: [f64; 4], b: [f64; 4]| (0..4).all(|i| (a[i] - b[i]).abs() < 1e-12);
    assert!(close(lit(shading), expected));
    // The same light fixed to the camera, whose x axis is +z and whose z axis is -x here.
    let camera_light =
        Shading { light_direction: DVec3::new(4.0, 0.0, 3.0), light_space: LightSpace::Camera, ..shading };
    assert!(close(lit(camera_light), expected));
    // The range of two units less a voxel takes seven voxels: a fade of 1/7 lights by half.
    let half = lit(Shading { gradient_fade: 1.0 / 7.0, ..shading });
    let unlit = [0.5, 1.0, 0.25, 1.0];
    assert!(close(half, [0, 1, 2, 3].map(|i| 0.5 * (expected[i] + unlit[i]))));

    // The other terms there, by hand, with a tangent of Ward's along -y and his other one along z.
    let mut terms = |shading: Shading, diffuse: f64, highlight: f64| {
        let light = [0, 1, 2].map(|i| shading.light_color[i] * (unlit[i] * 0.7 * diffuse + 0.2 * highlight));
        let expected = [0, 1, 2].map(|i| 0.1 * unlit[i] + light[i]);
        let found = lit(shading);
        assert!(close(found, [expected[0], expected[1], expected[2], 1.0]), "{shading:?} {found:?} {expected:?}");
    };
    let diffuse = |diffuse_term| Shading { diffuse_term, specular: 0.0, ..shading };
    for (steps, level) in [(1, 1.0), (3, 2.0 / 3.0), (5, 0.6)] {
        terms(diffuse(Diffuse::Toon { steps }), level, 0.0);
    }
    terms(diffuse(Diffuse::OrenNayar { roughness: 0.5 }), 0.6 * (1.0 - 0.125 / 0.58), 0.0);
    let shiny = |highlight| Shading { highlight, ..shading };
    terms(shiny(Highlight::Phong { shininess: 4.0 }), 0.6, 0.6_f64.powi(4));
    let facets = (-0.25 / 0.09_f64).exp() / (PI * 0.09 * 0.64);
    let fresnel = 0.2 + 0.8 * (1.0 - 0.8_f64.sqrt()).powi(5);
    terms(shiny(Highlight::CookTorrance { roughness: 0.3, reflectance: 0.2 }), 0.6, facets * fresnel / 4.0);
    let gauss = (-0.25 / 0.16_f64).exp() / (4.0 * PI * 0.2 * 0.4);
    terms(shiny(Highlight::Ward { along: 0.2, across: 0.4 }), 0.6, gauss * 0.6_f64.sqrt());
}
