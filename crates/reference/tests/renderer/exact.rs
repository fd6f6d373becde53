//! The exact renderer against closed forms.

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::closed_forms::*;
use rayloom_reference::field::Sampling;
use rayloom_reference::gradient::GradientOperator;
use rayloom_reference::ray::AxisBox;
use rayloom_reference::shading::{Diffuse, Highlight, LightSpace, Shading};
use rayloom_reference::{Camera, Comparison, FirstHit, Layer, MISS, Method, Refinement, Scene, exact, same_samples};
use rayloom_volume::{Knot, TransferFunction, Volume};

/// The field `start + slope x` whose voxel centres span `x = 0..length`.
fn ramp(start: f64, slope: f64, length: f64) -> Volume {
    let to_world = DMat3::from_diagonal(DVec3::new(length / 16.0, 1.0, 1.0));
    volume([17, 3, 3], DAffine3::from_mat3(to_world), |p| start + slope * p.x)
}

/// The single pixel of a ray along +x through a [`ramp`], clipped to the voxel centres.
fn ramp_pixel(volume: &Volume, classification: TransferFunction, method: Method) -> [f64; 4] {
    let mut scene = Scene::new(volume, classification, along_x(1.0, 1.0), [1, 1]);
    let outer = DVec3::new(0.5 / 17.0, 0.0, 0.0);
    scene.clip = AxisBox { min: outer, max: DVec3::ONE - outer };
    scene.method = method;
    pixel(&scene)
}

fn pixel(scene: &Scene<'_>) -> [f64; 4] {
    exact::render(scene).expect("the scene makes sense").pixel(0, 0)
}

#[test]
fn homogeneous_slabs() {
    let volume = volume([5, 4, 3], filling([5, 4, 3], DVec3::ZERO, DVec3::ONE), |_| 0.7);
    for (tau, reference_length) in [(1.0, 1.0), (0.5, 0.5), (10.0, 1.0), (0.01, 7.0), (1e-8, 1.0)] {
        let mut scene = Scene::new(&volume, uniform([0.5; 3], tau), along_x(0.4, 0.3), [1, 1]);
        scene.reference_length = reference_length;
        let expected = homogeneous_opacity(tau, 1.0 / reference_length);
        let found = pixel(&scene);
        assert!((found[3] - expected).abs() < 1e-15 && (found[0] - 0.5 * expected).abs() < 1e-15);
    }
}

#[test]
fn ramps_with_drawn_opacity() {
    for slope in [0.1, 0.8, 0.999_999, 1.0] {
        let classification =
            TransferFunction { knots: vec![Knot::new(0.0, [1.0; 3], 0.0), Knot::new(1.0, [1.0; 3], slope)] };
        let depth = linear_opacity_depth(slope, 1.0);
        for (start, rise) in [(0.0, 1.0), (1.0, -1.0)] {
            let found = ramp_pixel(&ramp(start, rise, 1.0), classification.clone(), Method::Dvr);
            let expected = homogeneous_opacity(depth, 1.0);
            assert!((found[3] - expected).abs() < 1e-12, "{slope}: {} {expected}", found[3]);
            assert!((found[0] - found[3]).abs() < 1e-15);
        }
    }
}

#[test]
fn steps_and_spikes() {
    let volume = ramp(0.0, 1.0, 1.0);
    for (tau, threshold) in [(3.0, 0.371), (3.0, 0.5), (9.0, 0.99)] {
        let expected = step_opacity(tau, threshold, 1.0);
        let found = ramp_pixel(&volume, step(threshold, tau), Method::Dvr)[3];
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        // Far narrower than a cell; what the width itself is rounded to shows.
        for width in [1e-3, 1e-6, 1e-9] {
            let mut spike = step(threshold, tau);
            let end = threshold + width;
            spike.knots[0].right.as_mut().expect("a split knot").opacity = 0.9;
            spike.knots.push(Knot::split(end, ([1.0; 3], 0.9), ([1.0; 3], 0.0)));
            let expected = spike_opacity(-(0.1_f64).ln(), end - threshold, 1.0);
            let found = ramp_pixel(&volume, spike, Method::Dvr)[3];
            assert!((found - expected).abs() < 1e-15, "{width}: {found} {expected}");
        }
    }
}

#[test]
fn balls_of_planes() {
    // A wedge |x|: the trilinear field is the formula, so the chord between two planes is exact.
    let wedge = volume([17, 3, 3], filling([17, 3, 3], DVec3::splat(-0.5), DVec3::splat(0.5)), |p| 0.25 - p.x.abs());
    for angle in [0.0_f64, 0.3, 0.9] {
        let direction = DVec3::new(angle.cos(), angle.sin() * 0.2, 0.0);
        let camera = Camera::orthographic(-direction, DVec3::ZERO, 1.0);
        let found = pixel(&Scene::new(&wedge, step(0.0, 2.0), camera, [1, 1]))[3];
        let expected = homogeneous_opacity(2.0, 0.5 / direction.normalize().x);
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

#[test]
fn projections_of_ramps() {
    let volume = ramp(2.0, 3.0, 1.0);
    let exact = linear_projection(2.0, 5.0);
    let value = |method| 5.0 * ramp_pixel(&volume, readable(0.0, 5.0), method)[0];
    assert!((value(Method::Mip) - exact.maximum).abs() < 1e-14);
    assert!((value(Method::MinIp) - exact.minimum).abs() < 1e-14);
    assert!((value(Method::Mean) - exact.mean).abs() < 1e-14);
    assert!((value(Method::Sum) - 3.5).abs() < 1e-14);
}

#[test]
fn extremes_between_voxels() {
    // x y on a cell: along the diagonal the cubic is a parabola with its maximum inside.
    let saddle =
        volume([2, 2, 1], filling([2, 2, 1], DVec3::splat(-0.5), DVec3::new(1.5, 1.5, 0.5)), |p| p.x * (1.0 - p.y));
    let camera = Camera::orthographic(DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0), 1.0);
    let mut scene = Scene::new(&saddle, readable(0.0, 1.0), camera, [1, 1]);
    scene.camera.up = DVec3::Z;
    scene.method = Method::Mip;
    let image = exact::render(&scene).expect("the scene makes sense");
    assert!((image.pixel(0, 0)[0] - 0.25).abs() < 1e-15);
    assert!((image.depth[0] - 1.5 * 2.0_f64.sqrt()).abs() < 1e-8);
    scene.method = Method::Isosurface { value: 0.25 - 1e-12, refinement: Refinement::None };
    // Both crossings lie within 3e-6 of the maximum.
    let hit = exact::render(&scene).expect("the scene makes sense");
    assert!((hit.depth[0] - (1.5 - 1e-6) * 2.0_f64.sqrt()).abs() < 1e-9);
}

#[test]
fn planes_and_touched_surfaces() {
    let dims = [8, 9, 10];
    let to_world = filling(dims, DVec3::splat(-1.0), DVec3::new(1.0, 2.0, 1.5));
    let normal = DVec3::new(-0.36, 0.48, -0.8);
    let volume = volume(dims, to_world, |p| normal.dot(p));
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    let camera = Camera::perspective(center - 4.0 * normal + DVec3::new(0.3, 0.2, 0.0), center, 6.0);
    let mut scene = Scene::new(&volume, uniform([1.0; 3], 1.0), camera, [8, 6]);
    let offset = normal.dot(center);
    scene.method = Method::Isosurface { value: offset, refinement: Refinement::None };
    let renderer = exact::Renderer::new(&scene).expect("the scene makes sense");
    let view = camera.view(scene.size).expect("the camera makes sense");
    for (x, y) in [(0, 0), (3, 4), (7, 5)] {
        let hit = renderer.surface(x, y).expect("the plane fills the view");
        let ray = view.ray(x, y);
        let expected = plane_hit(ray.origin, ray.direction, normal, offset).expect("the plane is not parallel");
        assert!((hit.depth - expected).abs() < 1e-13 && hit.normal.abs_diff_eq(-normal, 1e-12));
        assert_eq!(renderer.pixel(x, y).depth, hit.depth);
    }
}

#[test]
fn layers_in_the_order_of_the_ray() {
    // Values rise to 0.25 at x = 0 and fall again.
    let volume = volume([17, 3, 3], filling([17, 3, 3], DVec3::splat(-0.5), DVec3::splat(0.5)), |p| 0.25 - p.x.abs());
    let layer = |value, red| Layer { value, color: [red, 1.0 - red, 0.5], opacity: 0.4 };
    let [low, middle, high] = [layer(-0.1, 0.9), layer(0.1, 0.2), layer(0.2, 0.6)];
    let over = |order: &[Layer]| {
        let mut sum = [0.0; 4];
        for Layer { color: [r, g, b], opacity, .. } in order {
            let weight = opacity * (1.0 - sum[3]);
            sum = std::array::from_fn(|i| sum[i] + weight * [*r, *g, *b, 1.0][i]);
        }
        sum
    };
    let mut scene = Scene::new(&volume, TransferFunction::default(), along_x(0.1, 0.0), [1, 1]);
    scene.method =
        Method::Isosurfaces { layers: [middle, low, Layer { opacity: 0.0, ..high }], refinement: Refinement::Linear };
    let close = |a: [f64; 4], b: [f64; 4]| (0..4).all(|i| (a[i] - b[i]).abs() < 1e-15);
    let expected = over(&[low, middle, middle, low]);
    for image in
        [exact::render(&scene), same_samples::render(&scene)].map(|image| image.expect("a scene that makes sense"))
    {
        assert!(close(image.pixel(0, 0), expected), "{:?} {expected:?}", image.pixel(0, 0));
        assert!((image.depth[0] - 9.65).abs() < 1e-12, "{}", image.depth[0]);
    }
    // Two at one jump, either way; the third is met nowhere.
    let step = self::volume([3, 1, 1], filling([3, 1, 1], DVec3::ZERO, DVec3::ONE), |p| 1.0 - 3.0 * (p.x - 0.5).abs());
    scene.volume = &step;
    scene.sampling = Sampling::Nearest;
    scene.camera = along_x(0.4, 0.3);
    scene.method = Method::Isosurfaces { layers: [middle, high, low], refinement: Refinement::None };
    let expected = over(&[middle, high, high, middle]);
    for image in
        [exact::render(&scene), same_samples::render(&scene)].map(|image| image.expect("a scene that makes sense"))
    {
        assert!(close(image.pixel(0, 0), expected), "{:?} {expected:?}", image.pixel(0, 0));
    }
}

#[test]
fn first_hits_of_planes() {
    let dims = [8, 9, 10];
    let normal = DVec3::new(-0.36, 0.48, -0.8);
    let volume = volume(dims, filling(dims, DVec3::splat(-1.0), DVec3::new(1.0, 2.0, 1.5)), |p| normal.dot(p));
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    let camera = Camera::perspective(center - 4.0 * normal + DVec3::new(0.3, 0.2, 0.0), center, 6.0);
    // Visible from the plane on, once by a jump and once by a slope.
    let offset = normal.dot(center);
    let slope =
        TransferFunction { knots: vec![Knot::new(offset, [1.0; 3], 0.0), Knot::new(offset + 0.1, [1.0; 3], 0.9)] };
    for function in [step(offset, 0.1), slope] {
        let mut scene = Scene::new(&volume, function, camera, [8, 6]);
        let ray = camera.view(scene.size).expect("the camera makes sense").ray(3, 4);
        let depth = plane_hit(ray.origin, ray.direction, normal, offset).expect("the plane is not parallel");
        let point = volume.texture_to_world().inverse().transform_point3(ray.at(depth));
        let told =
            [(FirstHit::Depth, DVec3::splat(depth)), (FirstHit::Point, point), (FirstHit::Normal, 0.5 - 0.5 * normal)];
        for (told, expected) in told {
            scene.method = Method::FirstHit(told);
            let found = exact::Renderer::new(&scene).expect("the scene makes sense").pixel(3, 4);
            let [r, g, b, alpha] = found.color;
            assert!(DVec3::new(r, g, b).abs_diff_eq(expected, 1e-12) && alpha == 1.0, "{told:?} {found:?} {expected}");
            assert!((found.depth - depth).abs() < 1e-12);
            // The first sample inside lies behind, by less than a step.
            scene.step = volume.mean_spacing() / 100.0;
            let sampled = same_samples::Renderer::new(&scene).expect("the scene makes sense").pixel(3, 4);
            assert!((0.0..0.01).contains(&(sampled.depth - depth)), "{} {depth}", sampled.depth);
        }
    }
}

/// Noise in a box, seen from a corner.
fn noisy_scene(volume: &Volume) -> Scene<'_> {
    let camera = Camera::perspective(DVec3::new(2.0, 1.5, 3.0), DVec3::ZERO, 40.0);
    let mut scene = Scene::new(volume, colorful(), camera, [12, 10]);
    scene.reference_length = 0.2;
    scene
}

fn noisy() -> Volume {
    volume([7, 6, 5], filling([7, 6, 5], DVec3::NEG_ONE, DVec3::ONE), noise)
}

#[test]
fn identities_hold_for_noise() {
    let volume = noisy();
    let mut scene = noisy_scene(&volume);
    let color = [0.9, 0.5, 0.1];
    let mut function = colorful();
    function.knots.iter_mut().for_each(|knot| knot.color = color);
    scene.classification = function.into();
    let image = exact::render(&scene).expect("the scene makes sense");
    assert!(image.color.iter().all(|&pixel| constant_color_residual(pixel, color) < 1e-14));
    assert!(image.color.iter().any(|pixel| pixel[3] > 0.3));
    assert!(image.color.iter().zip(&image.depth).all(|(c, &d)| (c[3] == 0.0) == (d == MISS)));
}

#[test]
fn samples_converge_to_the_exact_picture() {
    let volume = noisy();
    let lit = Shading { gradient_fade: 0.05, ..Shading::default() };
    let refinement = Refinement::Secant(8);
    let layers = [0.6, 0.3, 0.7].map(|value| Layer { value, color: [1.0 - value, value, 0.5], opacity: 0.5 });
    let methods = [
        (Method::Dvr, None, 2e-4),
        (Method::Dvr, Some(lit), 2e-4),
        (Method::Mip, None, 2e-3),
        (Method::MinIp, None, 2e-3),
        (Method::Mean, None, 2e-5),
        (Method::Sum, None, 2e-5),
        (Method::Isosurface { value: 0.6, refinement }, Some(lit), 2e-3),
        (Method::Isosurfaces { layers, refinement }, Some(lit), 2e-3),
    ];
    for (method, shading, tolerance) in methods {
        for gradient in [
            GradientOperator::Central,
            GradientOperator::Forward,
            GradientOperator::CentralFourth,
            GradientOperator::Sobel,
        ] {
            let mut scene = noisy_scene(&volume);
            (scene.method, scene.shading, scene.gradient) = (method, shading, gradient);
            scene.step /= 100.0;
            let expected = exact::render(&scene).expect("the scene makes sense");
            let found = same_samples::render(&scene).expect("the scene makes sense");
            let errors = Comparison::new(&found.color, &expected.color).expect("pictures of one size").pixels;
            println!("{method:?} {gradient:?}: {errors:?}");
            assert!(errors.mean < tolerance, "{method:?} {gradient:?}: {errors:?}");
        }
    }
}

/// Every diffuse term and every highlight. The light comes from aside: steps, kinks and the ends of light are all there.
#[test]
fn every_light_is_integrated() {
    let volume = noisy();
    let matt = |diffuse_term| Shading { diffuse_term, specular: 0.0, ..Shading::default() };
    let shiny = |highlight| Shading { highlight, specular: 0.6, ..Shading::default() };
    let lights = [
        matt(Diffuse::OrenNayar { roughness: 0.5 }),
        matt(Diffuse::Toon { steps: 3 }),
        shiny(Highlight::Phong { shininess: 16.0 }),
        shiny(Highlight::CookTorrance { roughness: 0.3, reflectance: 0.2 }),
        shiny(Highlight::Ward { along: 0.2, across: 0.4 }),
    ];
    for light in lights {
        for two_sided in [true, false] {
            let light_direction = DVec3::new(0.9, 0.2, -0.1);
            let mut scene = noisy_scene(&volume);
            scene.shading = Some(Shading { two_sided, light_direction, gradient_fade: 0.02, ..light });
            let found = exact::render(&scene).expect("the scene makes sense");
            let error = |rate: f64| {
                let scene = Scene { step: scene.step / rate, ..scene.clone() };
                let sampled = same_samples::render(&scene).expect("the scene makes sense");
                Comparison::new(&sampled.color, &found.color).expect("pictures of one size").pixels.mean
            };
            let (coarse, fine) = (error(50.0), error(800.0));
            println!("{light:?} {two_sided}: {coarse:.1e} {fine:.1e}");
            // A jump costs half a step, and all of them are independent.
            assert!(fine < 3e-5 && fine < coarse / 8.0, "{light:?} {two_sided}: {coarse:e} {fine:e}");
        }
    }
}

/// Normals that are all alike but for rounding, just where light steps or ends: not to be told apart by halving.
#[test]
fn rounding_does_not_step() {
    let normal = DVec3::new(0.6, -0.3, 0.2).normalize();
    let aside = normal.cross(DVec3::new(0.2, 0.9, 0.1)).normalize();
    let volume = volume([6, 7, 5], filling([6, 7, 5], DVec3::NEG_ONE, DVec3::ONE), |p| 0.5 - 0.3 * normal.dot(p));
    for cosine in [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0_f64] {
        let light_direction = cosine * normal + (1.0 - cosine * cosine).sqrt() * aside;
        let light = Shading { light_direction, light_space: LightSpace::World, ambient: 0.0, ..Shading::default() };
        for two_sided in [true, false] {
            let mut scene = noisy_scene(&volume);
            scene.shading =
                Some(Shading { diffuse_term: Diffuse::Toon { steps: 3 }, two_sided, specular: 0.0, ..light });
            scene.classification = uniform([1.0; 3], 0.7).into();
            for pixel in exact::render(&scene).expect("the scene makes sense").color {
                assert!((pixel[0] - 0.8 * cosine * pixel[3]).abs() < 1e-9, "{cosine} {two_sided}: {pixel:?}");
            }
            let highlight = Highlight::BlinnPhong { shininess: 1.0 };
            scene.shading = Some(Shading { two_sided, highlight, ..light });
            assert!(exact::render(&scene).is_ok());
        }
    }
}

#[test]
fn lit_integrals_are_right_to_a_billionth() {
    let volume = noisy();
    for two_sided in [true, false] {
        let mut scene = noisy_scene(&volume);
        scene.shading = Some(Shading { two_sided, gradient_fade: 0.02, ..Shading::default() });
        scene.size = [1, 1];
        let expected = pixel(&scene);
        // Midpoints with steps so small that bends, jumps and knots cost less than the bound below.
        let marched = |rate| {
            let mut scene = scene.clone();
            scene.step /= rate;
            same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0)
        };
        let error = |rate| (0..4).map(|i| (marched(rate)[i] - expected[i]).abs()).fold(0.0, f64::max);
        let errors = [1e4, 1e5].map(error);
        println!("two-sided {two_sided}: {errors:?}");
        // Light that jumps where a normal is turned around costs the march half a step.
        let bound = if two_sided { 5e-7 } else { 1e-9 };
        assert!(errors[1] < bound && errors[1] < 0.2 * errors[0], "{errors:?}");
    }
}

#[test]
fn front_over_back_is_the_whole() {
    let volume = noisy();
    for shading in [None, Some(Shading { gradient_fade: 0.02, ..Shading::default() })] {
        let mut scene = noisy_scene(&volume);
        scene.shading = shading;
        let mut render = |clip| {
            scene.clip = clip;
            exact::render(&scene).expect("the scene makes sense").color
        };
        let whole = render(AxisBox::UNIT);
        // The camera looks towards smaller z: what is above the cut is in front. The parts are halved elsewhere than the whole.
        let cut = 0.437_123;
        let front = render(AxisBox { min: DVec3::new(0.0, 0.0, cut), ..AxisBox::UNIT });
        let back = render(AxisBox { max: DVec3::new(1.0, 1.0, cut), ..AxisBox::UNIT });
        let over = |i: usize, c: usize| front[i][c] + (1.0 - front[i][3]) * back[i][c];
        let errors =
            (0..whole.len()).flat_map(|i| (0..4).map(move |c| (i, c))).map(|(i, c)| (over(i, c) - whole[i][c]).abs());
        let (worst, bound) = (errors.fold(0.0, f64::max), if shading.is_some() { 1e-9 } else { 1e-13 });
        println!("lit {}: {worst:e}", shading.is_some());
        assert!(worst < bound, "{worst:e}");
    }
}
