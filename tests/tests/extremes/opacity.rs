//! E32 to E39, E53, E55, E68: opacities of every size over any number of steps.

use glam::{DAffine3, DVec3};
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{LinearRamp, homogeneous_opacity};
use rayloom_tests::rays::{homogeneous, tabulated};
use rayloom_tests::timing::samples;
use rayloom_tests::{Grid, Picture, Workbench, tolerances::*};
use rayloom_volume::ValueRange;
use serde_json::json;

use crate::{SIZE, assert_sound, difference, function, outside, ramp, same_bits, shown, thing_grid};

/// A homogeneous bar of 25 x 1 x 1 world units.
fn bar() -> Workbench {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [25, 1, 1], "extent": [25, 1, 1]}));
    bench.look(&Camera::orthographic(DVec3::X * -30.0, DVec3::ZERO, 0.9));
    bench
}

/// The opacity of a pixel in the middle, after one length of `length` at extinction `tau` a unit.
fn opacity(picture: &Picture) -> f64 {
    f64::from(picture.at(picture.size[0] / 2, picture.size[1] / 2)[3])
}

/// 1e5 steps of opacity 1e-8, unlit and lit. Where a driver ends
/// loops earlier, the ray takes fewer and longer steps, with a note, and its opacity stays.
#[test]
fn e34_e55_e68_faint_material_over_1e5_steps() {
    let mut bench = bar();
    for shading in ["none", "diffuse"] {
        bench.put("traversal.shading", json!(shading)).put("traversal.sampling_rate", json!(4000));
        let picture = bench.classify(&homogeneous(1e-8 * 1e5 / 25.0, [1.0; 3])).render([4, 4]);
        let exact = 1.0 - (1.0 - 1e-8_f64).powf(1e5);
        assert!((exact - 9.995_00e-4).abs() < 1e-9);
        let error = opacity(&picture) / exact - 1.0;
        println!("E34, shading {shading}: relative error {error:.2e}");
        assert!(error.abs() <= FAINT, "{shading}: {error}");
        let notes = bench.evaluator.last_run("traversal").map(|run| run.notes.join("\n")).unwrap_or_default();
        let limited = bench.runner.context.gpu.loop_rounds().is_some_and(|rounds| rounds < 100_000);
        assert_eq!(notes.contains("longer steps"), limited, "{notes}");
    }
}

/// Surfaces are refined in loops of their own, which must not use up the rounds of the samples behind them.
#[test]
fn e55_many_refined_surfaces_end_no_ray() {
    let file = Grid::of_index([512, 1, 1], DAffine3::IDENTITY, |[i, _, _]| f64::from(i % 2)).save();
    let mut bench = Workbench::of_file(file.path());
    bench.put("traversal.compositing", json!("isosurfaces")).put("traversal.shading", json!("diffuse"));
    bench.put("traversal.compositing.isovalue_a", json!(0.5)).put("traversal.compositing.opacity_a", json!(0.002));
    bench.put("traversal.compositing.opacity_b", json!(0)).put("traversal.compositing.opacity_c", json!(0));
    bench.put("traversal.refinement", json!("bisection")).put("traversal.refinement.halvings", json!(16));
    bench.put("traversal.sampling_rate", json!(200)).put("traversal.termination_error", json!(0));
    bench.look(&Camera::orthographic(DVec3::X * -9.0, DVec3::X * 250.0, 0.3));
    let found = opacity(&bench.render([4, 4]));
    let exact = 1.0 - (1.0 - 0.002_f64).powi(511);
    println!("E55, 511 surfaces: {found:.6} for {exact:.6}");
    assert!((found - exact).abs() <= OPACITY, "{found}, not {exact}");
}

/// Lit rays that meet empty space one after the other while they are walked at once: some drivers count the rounds of all.
#[test]
fn e55_long_lit_rays_are_not_cut() {
    let visible = |[i, j, k]: [u32; 3]| i <= (j + k) % 8 || i == 127;
    let file = Grid::of_index([128, 8, 8], DAffine3::IDENTITY, |index| f64::from(u8::from(visible(index)))).save();
    let mut bench = Workbench::of_file(file.path());
    bench.classify(&function(&[(0.4, [1.0; 3], 0.0), (0.6, [1.0; 3], 0.02)]));
    bench.put("traversal.sampling", json!("nearest")).put("traversal.skipping", json!("none"));
    bench.put("traversal.shading", json!("diffuse")).put("traversal.termination_error", json!(0));
    bench.look(&Camera::orthographic(DVec3::new(-9.0, 3.5, 3.5), DVec3::new(60.0, 3.5, 3.5), 8.0));
    let [short, long] = [10, 160].map(|rate| bench.put("traversal.sampling_rate", json!(rate)).render([8, 8]));
    assert!(short.color.iter().all(|pixel| pixel[3] > 0.03), "rays meet two visible voxels at least");
    let d = difference(&short, &long);
    println!("E55, lit rays of 20480 samples: {d:.2e} off");
    assert!(d <= OPACITY, "{d}");
}

/// Sums of faint samples, which long rays keep, count as what has been accumulated.
#[test]
fn e39_long_rays_end_early() {
    let mut bench = bar();
    bench.classify(&homogeneous(1.0, [1.0; 3])).put("traversal.termination_error", json!(0.01));
    bench.put("traversal.skipping", json!("none"));
    for rate in [100, 2000] {
        let taken = samples(bench.put("traversal.sampling_rate", json!(rate)), [4, 4]) as f64;
        // ln 100 of 25 units.
        let share = taken / (16.0 * 25.0 * f64::from(rate));
        println!("E39, {rate} samples a voxel: {share:.3} of them taken");
        assert!((share - 0.01_f64.ln() / -25.0).abs() < 0.01, "{rate}: {share}");
    }
}

#[test]
fn e53_samples_do_not_drift_over_5e4_steps() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [12, 1, 1], "extent": [12, 1, 1]}));
    bench.put("traversal.sampling_rate", json!(4096)).look(&Camera::orthographic(DVec3::X * -9.0, DVec3::ZERO, 0.9));
    assert!(
        (opacity(&bench.classify(&homogeneous(0.1, [1.0; 3])).render([4, 4])) - homogeneous_opacity(0.1, 12.0)).abs()
            <= OPACITY
    );
    // The last sample of a ray is where it should be: T5 over as many steps.
    let range = ValueRange::new(0.0, 1.0);
    let (mut bench, _, _file) = crate::worlds::ramp_from_0_to_1(12);
    bench.classify(&tabulated(range, |s| 2.0 * s / 12.0, |s| [s; 3]));
    bench.put("traversal.sampling_rate", json!(4096)).look(&Camera::orthographic(DVec3::X * -9.0, DVec3::X * 6.0, 0.3));
    let exact = LinearRamp {
        start: 0.0,
        slope: 1.0 / 12.0,
        density: 2.0 / 12.0,
        color_offset: 0.0,
        color_scale: 1.0,
        length: 12.0,
    };
    let [red, _, _, alpha] = bench.render([4, 4]).at(1, 1).map(f64::from);
    println!("E53: colour {:.2e}, opacity {:.2e} off", red - exact.color(), alpha - exact.opacity());
    assert!((red - exact.color()).abs() <= RAMP_AT_256 && (alpha - exact.opacity()).abs() <= RAMP_AT_256);
}

#[test]
fn e32_opacity_0_is_nothing_at_all() {
    let mut bench = bar();
    for look in [
        &[("compositing", "dvr")][..],
        &[("shading", "blinn_phong")],
        &[("compositing", "mip")],
        &[("compositing", "first_hit_point")],
    ] {
        let picture = shown(&mut bench, &outside(DVec3::ZERO, 25.0), &function(&[(0.0, [1.0; 3], 0.0)]), look);
        assert!(picture.color.iter().flatten().all(|c| c.to_bits() == 0), "{look:?}");
        let missed = look[0].1 == "mip" || picture.depth.iter().all(|depth| *depth > 2.9e38);
        assert!(missed, "{look:?}: something transparent was hit");
    }
}

/// Opacity 1 is opaque at any step down to a hundred-thousandth of the reference length.
#[test]
fn e33_opacity_1_is_opaque_at_every_step() {
    let mut bench = bar();
    let color = [0.25, 0.5, 1.0];
    for reference_length in [1e-6, 1.0, 40.0] {
        for rate in [1.0 / 64.0, 1.0, 37.0, 1000.0] {
            bench
                .put("traversal.reference_length", json!(reference_length))
                .put("traversal.sampling_rate", json!(rate));
            let picture = bench.classify(&function(&[(0.0, color, 1.0)])).render([4, 4]);
            for [r, g, b, a] in &picture.color {
                let close =
                    [r, g, b].into_iter().zip(color).all(|(found, c)| (f64::from(*found) - c).abs() <= ONE_COLOR);
                assert!(*a == 1.0 && close, "{reference_length}, {rate}: {r} {g} {b} {a}");
            }
        }
    }
}

#[test]
fn e35_faint_opacities_are_corrected_for_the_step_like_all() {
    let mut bench = bar();
    let mut found = Vec::new();
    for rate in [1.0, 2.0, 10.0, 100.0] {
        bench.put("traversal.sampling_rate", json!(rate));
        found.push(opacity(&bench.classify(&function(&[(0.0, [1.0; 3], 5e-5)])).render([4, 4])));
    }
    let exact = 1.0 - (1.0 - 5e-5_f64).powi(25);
    println!("E35: {found:?} for {exact}");
    assert!(found.iter().all(|a| (a / exact - 1.0).abs() <= 1e-5), "{found:?} for {exact}");
}

/// Accumulation is in 32 bits whatever the target: ten thousand steps of opacity 1e-4 do not stall.
#[test]
fn e36_faint_steps_add_up_in_16_bit_targets() {
    let mut bench = bar();
    bench.put("traversal.sampling_rate", json!(400)).put("traversal.target", json!("16-bit"));
    let tau = 1e-4 * 1e4 / 25.0;
    let found = opacity(&bench.classify(&homogeneous(tau, [1.0; 3])).render([4, 4]));
    // Half floats near 0.6 are 2^-11 apart, and a device may store the smaller one.
    assert!((found - homogeneous_opacity(tau, 25.0)).abs() <= 2.0_f64.powi(-11), "{found}");
}

#[test]
fn e37_e59_e60_edits_and_sizes_leave_nothing_behind() {
    let file = thing_grid(glam::DAffine3::IDENTITY).save();
    let camera = outside(DVec3::new(6.5, 5.5, 4.5), 14.0);
    let fresh =
        |_: u32| shown(&mut Workbench::of_file(file.path()), &camera, &ramp(0.0, 1.0), &[("shading", "blinn_phong")]);
    let first = fresh(0);
    assert_sound(&first, "fresh");
    assert!(same_bits(&first, &fresh(1)), "the same scene twice");
    let mut bench = Workbench::of_file(file.path());
    for round in 1..=10 {
        bench.put("traversal.reference_length", json!(0.1 * f64::from(round)));
        bench.put("traversal.sampling_rate", json!(f64::from(round)));
        shown(
            &mut bench,
            &camera,
            &ramp(0.0, f64::from(round)),
            &[("compositing", if round % 2 == 0 { "mip" } else { "dvr" })],
        );
        bench.render([7 * round, 90 - 7 * round]);
    }
    bench.put("traversal.reference_length", json!(1.0)).put("traversal.sampling_rate", json!(1.0));
    let last = shown(&mut bench, &camera, &ramp(0.0, 1.0), &[("compositing", "dvr"), ("shading", "blinn_phong")]);
    assert!(same_bits(&first, &last), "after ten edits: {}", difference(&first, &last));
}

/// Light brighter than 1 stays in the picture of floats; opacity and unlit colours keep their bounds.
#[test]
fn e38_bright_light_is_kept_and_bounds_hold() {
    let file = thing_grid(glam::DAffine3::IDENTITY).save();
    let mut bench = Workbench::of_file(file.path());
    let camera = outside(DVec3::new(6.5, 5.5, 4.5), 14.0);
    let plain = shown(&mut bench, &camera, &ramp(0.0, 1.0), &[]);
    assert!(plain.color.iter().all(|p| p[3] <= 1.0 && p[..3].iter().all(|c| *c <= p[3] * (1.0 + 1e-6))));
    bench
        .put("traversal.shading", json!("blinn_phong"))
        .put("traversal.shading.diffuse", json!(2.0))
        .put("traversal.shading.specular", json!(2.0));
    let bright = bench.render(SIZE);
    assert_sound(&bright, "bright");
    assert!(bright.color.iter().flatten().any(|c| *c > 1.0), "nothing is brighter than 1");
    assert!(bright.color.iter().zip(&plain.color).all(|(a, b)| a[3] == b[3]), "light changes no opacity");
}

/// I4 over a white background: what early termination leaves out is at most the error that was chosen.
#[test]
fn e39_early_termination_errs_by_no_more_than_chosen() {
    let file = thing_grid(glam::DAffine3::IDENTITY).save();
    let mut bench = Workbench::of_file(file.path());
    bench.add("background", "background").join("traversal.image", "background.front");
    bench.put("background.mode", json!("color")).put("background.first", json!([1, 1, 1, 1]));
    bench.look(&outside(DVec3::new(6.5, 5.5, 4.5), 14.0)).classify(&ramp(0.0, 0.6));
    let whole = bench.picture("background", "image", SIZE);
    for error in [0.1, 0.05, 0.01, 0.002, 1e-4] {
        bench.put("traversal.termination_error", json!(error));
        let d = difference(&whole, &bench.picture("background", "image", SIZE));
        println!("E39, error {error}: largest difference {d:.2e}");
        assert!(d <= error + OPACITY, "{error}: {d}");
        assert!(error < 0.01 || d > 0.0, "{error}: no ray ended early");
    }
}
