//! Pictures whose value is a formula (T1-T6, T8-T11, T17, T18).

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::closed_forms::*;
use rayloom_reference::ray::AxisBox;
use rayloom_reference::same_samples::render;
use rayloom_reference::{Camera, Method, Scene};
use rayloom_volume::{Knot, TransferFunction, Volume};

/// The field `start + slope x` whose voxel centres span `x = 0..length`.
fn ramp(start: f64, slope: f64, length: f64) -> Volume {
    let dims = [65, 3, 3];
    let to_world = DMat3::from_diagonal(DVec3::new(length / 64.0, 1.0, 1.0));
    volume(dims, DAffine3::from_mat3(to_world), |p| start + slope * p.x)
}

/// The single pixel of a ray along +x through a [`ramp`], clipped to the voxel centres, with `samples` samples.
fn ramp_pixel(volume: &Volume, classification: TransferFunction, samples: f64, method: Method) -> [f64; 4] {
    let mut scene = Scene::new(volume, classification, along_x(1.0, 1.0), [1, 1]);
    let outer = DVec3::new(0.5 / 65.0, 0.0, 0.0);
    scene.clip = AxisBox { min: outer, max: DVec3::ONE - outer };
    scene.step = 64.0 * volume.spacing().x / samples;
    scene.method = method;
    render(&scene).expect("the scene makes sense").pixel(0, 0)
}

#[test]
fn homogeneous_slab_is_exact_at_any_rate() {
    let volume = volume([5, 4, 3], filling([5, 4, 3], DVec3::ZERO, DVec3::ONE), |_| 0.7);
    for (tau, reference_length) in [(1.0, 1.0), (0.5, 0.5), (10.0, 1.0), (0.01, 7.0)] {
        for rate in [0.01, 0.37, 1.0, 3.3, 20.1] {
            let mut scene = Scene::new(&volume, uniform([1.0; 3], tau), along_x(0.4, 0.3), [1, 1]);
            (scene.step, scene.reference_length) = (scene.step / rate, reference_length);
            let expected = homogeneous_opacity(tau, 1.0 / reference_length);
            let found = render(&scene).expect("the scene makes sense").pixel(0, 0)[3];
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
    }
}

#[test]
fn opaque_stays_opaque_at_any_rate() {
    let volume = volume([5, 4, 3], filling([5, 4, 3], DVec3::ZERO, DVec3::ONE), |_| 0.7);
    for rate in [0.1, 1.0, 1000.0] {
        let mut scene = Scene::new(&volume, readable(0.0, 0.7), along_x(0.4, 0.3), [1, 1]);
        scene.step /= rate;
        assert_eq!(render(&scene).expect("the scene makes sense").pixel(0, 0), [1.0; 4]);
    }
}

#[test]
fn constant_color_identities_hold_for_noise() {
    let volume = volume([9, 7, 5], filling([9, 7, 5], DVec3::NEG_ONE, DVec3::ONE), noise);
    let color = [0.9, 0.5, 0.1];
    let painted = |color| {
        let mut function = colorful();
        function.knots.iter_mut().for_each(|knot| knot.color = color);
        function
    };
    let camera = Camera::perspective(DVec3::new(2.0, 1.5, 3.0), DVec3::ZERO, 50.0);
    let mut scene = Scene::new(&volume, painted(color), camera, [16, 12]);
    for rate in [0.3, 1.7] {
        scene.step = volume.mean_spacing() / rate;
        for &pixel in &render(&scene).expect("the scene makes sense").color {
            assert!(constant_color_residual(pixel, color) < 1e-15);
        }
    }
    scene.classification = painted([1.0; 3]).into();
    let furnace = render(&scene).expect("the scene makes sense");
    assert!(furnace.color.iter().all(|&pixel| furnace_residual(pixel) == 0.0));
    assert!(furnace.color.iter().any(|pixel| pixel[3] > 0.3));
}

#[test]
fn ramps_converge_with_order_two() {
    let forms = [
        LinearRamp { start: 0.0, slope: 1.0, density: 2.0, color_offset: 0.0, color_scale: 1.0, length: 1.0 },
        LinearRamp { start: 0.2, slope: 0.6, density: 3.0, color_offset: 0.1, color_scale: 0.5, length: 1.3 },
        LinearRamp { start: 0.9, slope: -0.6, density: 3.0, color_offset: 0.1, color_scale: 0.5, length: 1.3 },
    ];
    for form in forms {
        let volume = ramp(form.start, form.slope, form.length);
        let material = |s: f64| (form.color_offset + form.color_scale * s, form.density * s);
        let pixel = |n| ramp_pixel(&volume, following(0.0, 1.0, material), n, Method::Dvr);
        let errors = [16.0, 32.0, 64.0, 128.0].map(|n| (pixel(n)[0] - form.color()).abs());
        assert_order(&errors, 2.0, 0.05);
        // The midpoint rule integrates a linear extinction exactly; what is left is the approximation by knots.
        assert!((pixel(16.0)[3] - form.opacity()).abs() < 1e-8);
    }
}

/// The clip begins and ends inside of segments, each time elsewhere.
#[test]
fn cut_segments_cost_no_order() {
    let form = LinearRamp { start: 0.0, slope: 1.0, density: 2.0, color_offset: 0.0, color_scale: 1.0, length: 1.0 };
    let volume = ramp(form.start, form.slope, form.length);
    let pixel = |n| ramp_pixel(&volume, following(0.0, 1.0, |s| (s, 2.0 * s)), n, Method::Dvr);
    for samples in [21.7, 27.3, 30.01] {
        let errors = [1.0, 2.0, 4.0, 8.0].map(|finer| (pixel(samples * finer)[0] - form.color()).abs());
        assert_order(&errors, 2.0, 0.1);
    }
}

#[test]
fn drawn_opacity_converges_with_order_two() {
    let classification = TransferFunction { knots: vec![Knot::new(0.0, [1.0; 3], 0.0), Knot::new(1.0, [1.0; 3], 0.8)] };
    let volume = ramp(0.0, 1.0, 1.0);
    let exact = -(-linear_opacity_depth(0.8, 1.0)).exp_m1();
    let opacity = |n| ramp_pixel(&volume, classification.clone(), n, Method::Dvr)[3];
    assert_order(&[16.0, 32.0, 64.0, 128.0].map(|n| (opacity(n) - exact).abs()), 2.0, 0.05);
}

#[test]
fn steps_and_spikes_stay_within_their_bounds() {
    let volume = ramp(0.0, 1.0, 1.0);
    let (tau, threshold, width) = (3.0, 0.371, 0.05);
    let mut spike = step(threshold, tau);
    spike.knots.push(Knot::split(threshold + width, ([1.0; 3], spike.knots[0].right_side().opacity), ([1.0; 3], 0.0)));
    for samples in [5.0, 16.0, 33.3, 100.0, 1000.0, 10_000.0] {
        let d = 1.0 / samples;
        let error = |tf: &TransferFunction, exact: f64| {
            (ramp_pixel(&volume, tf.clone(), samples, Method::Dvr)[3] - exact).abs()
        };
        assert!(error(&step(threshold, tau), step_opacity(tau, threshold, 1.0)) <= 0.5 * tau * d);
        assert!(error(&spike, spike_opacity(tau, width, 1.0)) <= tau * d);
    }
}

#[test]
fn projections_of_a_ramp() {
    let volume = ramp(2.0, 3.0, 1.0);
    let exact = linear_projection(2.0, 5.0);
    // Whole steps in the half voxel before the clip and within it.
    let samples = 128.0;
    // Both extremes lie at the ends, half a step beyond the outermost samples.
    let half_step = 0.5 * 3.0 / samples;
    let value = |method| 5.0 * ramp_pixel(&volume, readable(0.0, 5.0), samples, method)[0];
    assert!((value(Method::Mip) - (exact.maximum - half_step)).abs() < 1e-12);
    assert!((value(Method::MinIp) - (exact.minimum + half_step)).abs() < 1e-12);
    assert!((value(Method::Mean) - exact.mean).abs() < 1e-12);
    // Normalised values average one half over a length of one.
    assert!((value(Method::Sum) - 3.5).abs() < 1e-12);
}

/// Gaussian blob of σ = 0.1 on `n³` voxels that fill ±0.7.
fn blob(n: u32) -> Volume {
    volume([n; 3], filling([n; 3], DVec3::splat(-0.7), DVec3::splat(0.7)), |p| {
        gaussian_blob_maximum(2.0, 0.1, p.length())
    })
}

#[test]
fn gaussian_blob_converges_with_order_two() {
    // An odd offset, in a direction that follows no axis, so that errors do not cancel by symmetry.
    let direction = DVec3::new(1.0, 0.37, -0.23).normalize();
    let aside = direction.cross(DVec3::Y).normalize() * 0.0713;
    let camera = Camera::orthographic(aside - 5.0 * direction, aside, 1.0);
    let (exact, peak) = (gaussian_blob_opacity(2.0, 0.1, 0.0713), gaussian_blob_maximum(2.0, 0.1, 0.0713));
    let mut opacity_errors = vec![];
    let mut peak_errors = vec![];
    for n in [24, 48, 96, 192] {
        let volume = blob(n);
        let mut scene = Scene::new(&volume, following(0.0, 2.0, |s| (1.0, s)), camera, [1, 1]);
        scene.step /= 2.0;
        opacity_errors.push((render(&scene).expect("the scene makes sense").pixel(0, 0)[3] - exact).abs());
        (scene.method, scene.classification) = (Method::Mip, readable(0.0, 2.0).into());
        let found = 2.0 * render(&scene).expect("the scene makes sense").pixel(0, 0)[0];
        assert!(found <= gaussian_blob_maximum(2.0, 0.1, 0.0));
        peak_errors.push((found - peak).abs());
    }
    assert_order(&opacity_errors, 2.0, 0.25);
    let bound = 0.25 * 2.0 / 0.01;
    for (n, error) in [24.0, 48.0, 96.0, 192.0].into_iter().zip(peak_errors) {
        // Trilinear bound h²/8 Σ|f''| plus half a step off the peak, with |f''| <= peak/σ² on each axis.
        let h: f64 = 1.4 / n;
        assert!(error <= bound * h * h * 2.0, "{error}");
    }
}

#[test]
fn homogeneous_ball_converges_with_order_one() {
    let (tau, radius) = (2.0, 0.4);
    for (impact, exact) in [0.0, 0.3].map(|b| (b, ball_opacity(tau, radius, b))) {
        for n in [32, 64, 128] {
            let volume =
                volume([n; 3], filling([n; 3], DVec3::splat(-0.5), DVec3::splat(0.5)), |p| radius - p.length());
            let mut scene = Scene::new(&volume, step(0.0, tau), along_x(impact, 0.0), [1, 1]);
            scene.step /= 4.0;
            let error = (render(&scene).expect("the scene makes sense").pixel(0, 0)[3] - exact).abs();
            let (h, d) = (1.0 / f64::from(n), 0.25 / f64::from(n));
            // Half a step at each wall, and a wall displaced by h²/4R seen at an angle.
            let displaced = 2.0 * h * h / (4.0 * radius) * radius / (radius * radius - impact * impact).sqrt();
            assert!(error <= tau * (1.0 - exact) * (d + displaced) * 1.1, "{n}: {error}");
        }
    }
}

#[test]
fn hydrogen_projections_converge_with_order_two() {
    let half = 2.0;
    let camera = Camera::orthographic(DVec3::new(0.13, 0.17, 10.0), DVec3::new(0.13, 0.17, 0.0), 0.5);
    let view = camera.view([12, 12]).expect("the camera makes sense");
    // Root mean square over a picture: single rays depend on where they cross the cells.
    let error = |n: u32, density: &dyn Fn(DVec3) -> f64, exact: &dyn Fn(f64) -> f64| {
        let volume = volume([n; 3], filling([n; 3], DVec3::splat(-half), DVec3::splat(half)), density);
        let largest = volume.ranges()[0].max;
        let mut scene = Scene::new(&volume, readable(0.0, largest), camera, [12, 12]);
        scene.method = Method::Mean;
        let image = render(&scene).expect("the scene makes sense");
        let square = |(x, y)| {
            let impact = view.ray(x, y).origin.truncate().length();
            (image.pixel(x, y)[0] * largest * 2.0 * half / exact(impact) - 1.0).powi(2)
        };
        ((0..144).map(|i| square((i % 12, i / 12))).sum::<f64>() / 144.0).sqrt()
    };
    let errors = [64, 128, 256].map(|n| error(n, &|p| hydrogen_1s(p, 0.25), &|b| hydrogen_1s_projection(0.25, b)));
    // The cusp at the nucleus makes single halvings uneven.
    assert_order(&errors, 2.0, 0.4);
    let errors = [64, 128, 256].map(|n| error(n, &|p| hydrogen_2pz(p, 0.1), &|b| hydrogen_2pz_projection(0.1, b)));
    assert_order(&errors, 2.0, 0.3);
}

#[test]
fn early_termination_costs_what_it_may() {
    let volume = volume([9, 7, 5], filling([9, 7, 5], DVec3::NEG_ONE, DVec3::ONE), noise);
    let camera = Camera::perspective(DVec3::new(2.0, 1.5, 3.0), DVec3::ZERO, 50.0);
    let mut scene = Scene::new(&volume, colorful(), camera, [16, 12]);
    (scene.reference_length, scene.step) = (0.2, scene.step / 3.0);
    let whole = render(&scene).expect("the scene makes sense");
    for threshold in [0.5, 0.95] {
        let mut early = scene.clone();
        early.early_termination = Some(threshold);
        let early = render(&early).expect("the scene makes sense");
        let errors = early.color.iter().flatten().zip(whole.color.iter().flatten()).map(|(a, b)| (b - a).abs());
        let worst = errors.fold(0.0, f64::max);
        assert!(worst > 0.0 && worst <= 1.0 - threshold, "{threshold}: {worst}");
    }
}
