//! E22 to E31, E40 to E44: what voxels and transfer functions may hold.

use glam::{DAffine3, DVec3};
use rayloom_reference::closed_forms::homogeneous_opacity;
use rayloom_reference::ray::AxisBox;
use rayloom_reference::{Camera, Comparison, Method, Refinement, Scene, same_samples};
use rayloom_tests::rays::{Chord, chords, homogeneous};
use rayloom_tests::{Grid, VolumeFile, Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::worlds::ramp_from_0_to_1;
use crate::{SIZE, assert_sound, difference, function, outside, ramp, same_bits, shown, thing_grid};

/// A volume of 64-bit floats with voxels of edge 1.
fn doubles(dims: [u32; 3], values: impl Iterator<Item = f64>) -> VolumeFile {
    let bytes: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    VolumeFile::described(Some(&bytes), &json!({"raw": "voxels.raw", "dims": dims, "type": "f64"}))
}

const SHADED: [(&str, &str); 1] = [("shading", "blinn_phong")];
const SURFACE: [(&str, &str); 2] = [("compositing", "isosurface"), ("shading", "diffuse")];

fn camera() -> Camera {
    outside(DVec3::new(6.5, 5.5, 4.5), 14.0)
}

/// A ramp with two voxels that have no value, and the index of one of them.
fn ramp_with_gaps() -> (Grid, [u32; 3]) {
    let dims = [12, 11, 10];
    let grid = Grid::of_index(dims, DAffine3::IDENTITY, |index| match index {
        [6, 5, 4] | [11, 0, 9] => f64::NAN,
        [i, j, k] => (f64::from(i) + 0.3 * f64::from(j) + 0.1 * f64::from(k)) / 15.0,
    });
    (grid, [6, 5, 4])
}

/// A NaN voxel and all that is interpolated with it is not there: the rest of the ray shows as ever.
#[test]
fn e22_nan_voxels_are_not_there() {
    let (grid, [i, j, k]) = ramp_with_gaps();
    let file = grid.save();
    let mut bench = Workbench::of_file(file.path());
    let volume = bench.volume();
    let camera = outside(DVec3::new(5.5, 5.0, 4.5), 12.0);
    let tau = 0.2;
    bench.put("traversal.sampling_rate", json!(64));
    let picture = shown(&mut bench, &camera, &homogeneous(tau, [1.0; 3]), &[]);
    assert_sound(&picture, "gaps");
    // The cells around a voxel reach to the next voxel centres; those at a corner to the border of the box.
    let dims = DVec3::from_array(grid.dims.map(f64::from));
    let inner = DVec3::from_array([i, j, k].map(f64::from)) + 0.5;
    let around =
        |low: DVec3, high: DVec3| chords(&camera, SIZE, &volume, &AxisBox { min: low / dims, max: high / dims });
    let [whole, hole, corner] = [
        chords(&camera, SIZE, &volume, &AxisBox::UNIT),
        around(inner - 1.0, inner + 1.0),
        around(DVec3::new(10.5, 0.0, 8.5), DVec3::new(12.0, 1.5, 10.0)),
    ];
    let length = |chord: &Option<Chord>| chord.as_ref().map_or(0.0, |chord| chord.length);
    let mut holes = 0;
    for (n, pixel) in picture.color.iter().enumerate() {
        let missing = length(&hole[n]) + length(&corner[n]);
        let exact = homogeneous_opacity(tau, length(&whole[n]) - missing);
        holes += u32::from(missing > 0.5);
        // Two ends of a hole, at whole samples.
        let allowed = if missing > 0.0 { 4.0 * tau / 64.0 } else { OPACITY + tau * 12.0 * CHORD };
        assert!((f64::from(pixel[3]) - exact).abs() <= allowed, "pixel {n}: {} for {exact}", pixel[3]);
    }
    assert!(holes > 15, "only {holes} rays meet a hole");
}

/// The device against float64 with gaps; and nothing but gaps is nothing.
#[test]
fn e22_gaps_in_every_look() {
    let (grid, _) = ramp_with_gaps();
    let file = grid.save();
    let nothing = Grid { values: vec![f32::NAN; grid.values.len()], ..grid.clone() }.save();
    let (mut bench, mut empty) = (Workbench::of_file(file.path()), Workbench::of_file(nothing.path()));
    let volume = bench.volume();
    let camera = outside(DVec3::new(5.5, 5.0, 4.5), 12.0);
    let function = ramp(0.0, 1.0);
    let surface = Method::Isosurface { value: 0.5, refinement: Refinement::Bisection(8) };
    for (compositing, method) in [
        ("dvr", Some(Method::Dvr)),
        ("mip", Some(Method::Mip)),
        ("minip", Some(Method::MinIp)),
        ("mean", Some(Method::Mean)),
        ("isosurface", Some(surface)),
        ("isosurface_dvr", None),
        ("isosurfaces", None),
        ("mida", None),
        ("attenuated_mip", None),
        ("sum", None),
        ("maximum_opacity", None),
        ("first_hit_point", None),
    ] {
        let look = [("compositing", compositing), ("refinement", "bisection")];
        let none = shown(&mut empty, &camera, &homogeneous(1.0, [1.0; 3]), &look);
        assert!(compositing == "sum" || none.color.iter().flatten().all(|c| *c == 0.0), "{compositing} of nothing");
        let found = shown(&mut bench, &camera, &function, &look);
        assert!(found.color.iter().flatten().chain(&found.depth).all(|x| x.is_finite()), "{compositing}");
        let Some(method) = method else { continue };
        let mut scene = Scene { method, ..Scene::new(&volume, function.clone(), camera, SIZE) };
        if compositing == "isosurface" {
            // Its colour is its own property here.
            scene.classification = crate::function(&[(0.0, [0.9, 0.85, 0.75], 1.0)]).into();
        }
        let expected = same_samples::render(&scene).expect("a scene that makes sense");
        let share = Comparison::new(&found.color, &expected.color).expect("one size").share_within(AGREEMENT_PIXEL);
        println!("E22 {compositing}: {:.2} % of the pixels agree", 100.0 * share);
        // A ray that grazes a gap may take one sample more or less.
        assert!(share >= 0.99, "{compositing}: only {share} of the pixels agree");
    }
    // Leaps over empty space change no bit, with gaps and classifications that read two samples.
    let thin = crate::function(&[(0.45, [1.0; 3], 0.0), (0.5, [1.0; 3], 0.4), (0.55, [1.0; 3], 0.0)]);
    for look in [
        &[("compositing", "dvr"), ("classification", "preintegrated_full"), ("shading", "none")][..],
        &[("classification", "transfer_function"), ("shading", "blinn_phong")],
        &[("compositing", "isosurface"), ("shading", "diffuse")],
    ] {
        let pictures = ["none", "occupancy", "distance"].map(|skipping| {
            bench.put("traversal.skipping", json!(skipping));
            shown(&mut bench, &camera, &thin, look)
        });
        assert_sound(&pictures[0], "skipping");
        assert!(pictures[1..].iter().all(|picture| same_bits(&pictures[0], picture)), "{look:?}");
    }
}

#[test]
fn e23_infinite_voxels_are_the_ends_of_the_range() {
    let grid = thing_grid(DAffine3::IDENTITY);
    let fold = |pick: fn(f32, f32) -> f32, start| grid.values.iter().copied().fold(start, pick);
    let (low, high) = (fold(f32::min, f32::MAX), fold(f32::max, f32::MIN));
    let at = |replaced: [f32; 2]| {
        let mut changed = grid.clone();
        (changed.values[800], changed.values[400]) = (replaced[0], replaced[1]);
        changed.save()
    };
    let (finite, infinite) = (at([high, low]), at([f32::INFINITY, f32::NEG_INFINITY]));
    for look in [&SHADED[..], &SURFACE[..], &[("compositing", "mip")], &[("compositing", "minip")]] {
        let [a, b] = [&finite, &infinite].map(|file| {
            shown(&mut Workbench::of_file(file.path()), &camera(), &ramp(f64::from(low), f64::from(high)), look)
        });
        assert_sound(&a, "finite");
        assert!(same_bits(&a, &b), "{look:?}: {}", difference(&a, &b));
    }
}

/// Denormal numbers, huge ones, negative ones, and small differences of large ones: windows move along, pictures do not change.
#[test]
fn e24_e28_e29_e31_values_in_any_unit_give_one_picture() {
    let grid = thing_grid(DAffine3::IDENTITY);
    let picture = |scale: f64, offset: f64, look: &[(&str, &str)]| {
        let file = doubles(grid.dims, grid.values.iter().map(|v| f64::from(*v) * scale + offset));
        let mut bench = Workbench::of_file(file.path());
        shown(&mut bench, &camera(), &ramp(offset, scale + offset), look)
    };
    for look in [&SHADED[..], &[("compositing", "mip")], &[("compositing", "mean")]] {
        let plain = picture(1.0, 0.0, look);
        assert_sound(&plain, "plain");
        for (scale, offset) in
            [(1e-310, 0.0), (1e-40, 0.0), (1e-6, 0.0), (1e6, -2e6), (1.0, -1e9), (4.0, 16_777_216.0), (1e300, -1e300)]
        {
            let found = picture(scale, offset, look);
            let d = difference(&plain, &found);
            println!("{look:?}, values x {scale:e} + {offset:e}: largest difference {d:.2e}");
            assert!(d <= UNITS, "{look:?}, {scale:e}, {offset:e}: {d}");
        }
    }
}

#[test]
fn e25_a_step_at_the_only_value_is_continuous_from_the_right() {
    let mut bench =
        Workbench::of_generator(&json!({"field": "constant", "value": 5.0, "dims": [6, 5, 4], "extent": [6, 5, 4]}));
    let volume = bench.volume();
    assert_eq!(volume.ranges()[0].width(), 0.0);
    let value = volume.ranges()[0].min;
    let clear = ([1.0; 3], 0.0);
    let camera = outside(DVec3::ZERO, 6.0);
    for (at, visible) in [(value - 1e-9, true), (value, true), (value + 1e-9, false)] {
        let step = TransferFunction::new(vec![Knot::split(at, clear, ([0.5, 0.25, 1.0], 0.5))]).expect("a step");
        for classification in ["transfer_function", "preintegrated_fast", "preintegrated_full"] {
            let found = shown(&mut bench, &camera, &step, &[("classification", classification), ("shading", "none")]);
            assert_eq!(found.color.iter().any(|pixel| pixel[3] > 0.0), visible, "{classification}, step at {at}");
        }
    }
    bench.put("traversal.classification", json!("transfer_function"));
    for look in [&SHADED[..], &SURFACE[..], &[("compositing", "sum")], &[("compositing", "mip")]] {
        let found = shown(&mut bench, &camera, &homogeneous(1.0, [0.5; 3]), look);
        assert!(found.color.iter().flatten().all(|c| c.is_finite()), "{look:?}");
    }
}

#[test]
fn e27_every_code_of_16_bits_is_told_from_the_next() {
    let bytes: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_le_bytes).collect();
    let description = json!({"raw": "voxels.raw", "dims": [256, 256, 1], "type": "u16"});
    let file = VolumeFile::described(Some(&bytes), &description);
    let mut bench = Workbench::of_file(file.path());
    let center = DVec3::new(127.5, 127.5, 0.0);
    let camera = Camera { up: DVec3::NEG_Y, ..Camera::orthographic(center - DVec3::Z * 9.0, center, 256.0) };
    // Opacity 1 for the largest projection, and a red that is the value.
    let grey = function(&[(0.0, [0.0; 3], 0.5), (65_535.0, [1.0, 0.0, 0.0], 0.5)]);
    bench.put("traversal.sampling", json!("nearest")).put("traversal.compositing", json!("mip"));
    let picture = bench.look(&camera).classify(&grey).render([256, 256]);
    for (code, pixel) in (0_u32..).zip(&picture.color) {
        let found = f64::from(pixel[0] / pixel[3]) * 65_535.0;
        assert!((found - f64::from(code)).abs() < 0.1, "code {code} is shown as {found}");
    }
}

#[test]
fn e29_the_maximum_of_negative_values_is_found() {
    let file = doubles([5, 1, 1], [-2e6, -1.25e6, -1e6, -1.5e6, -1.75e6].into_iter());
    let mut bench = Workbench::of_file(file.path());
    let camera = Camera::orthographic(DVec3::X * -9.0, DVec3::ZERO, 0.5);
    let look = |compositing| [("compositing", compositing), ("sampling", "nearest")];
    for (compositing, red) in [("mip", 1.0), ("minip", 0.0), ("mean", 0.5)] {
        let map = function(&[(-2e6, [0.0; 3], 0.5), (-1e6, [1.0; 3], 0.5)]);
        let [r, _, _, a] = shown(&mut bench, &camera, &map, &look(compositing)).at(16, 16);
        assert!((f64::from(r / a) - red).abs() <= PROJECTION, "{compositing}: {}", r / a);
    }
}

/// A black surface on a ray that starts at the very corner of the box is a hit like any other.
#[test]
fn e30_black_and_the_origin_are_no_sign_of_a_miss() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [4, 4, 4], "extent": [4, 4, 4]}));
    let camera = Camera { up: DVec3::Z, ..Camera::perspective(DVec3::splat(-2.0), DVec3::ZERO, 50.0) };
    for compositing in ["first_hit_point", "first_hit_depth", "dvr"] {
        let black = homogeneous(1e3, [0.0; 3]);
        let picture = shown(&mut bench, &camera, &black, &[("compositing", compositing)]);
        assert!(picture.color.iter().all(|pixel| pixel[3] == 1.0), "{compositing}");
        assert!(picture.depth.iter().all(|&depth| depth > 0.0 && depth < 1.0), "{compositing}");
        assert!(compositing != "dvr" || picture.color.iter().all(|pixel| pixel[..3] == [0.0; 3]));
    }
}

/// A window of nothing, of one point and of what lies outside of the data.
#[test]
fn e43_transfer_functions_of_any_domain() {
    let file = thing_grid(DAffine3::IDENTITY).save();
    let mut bench = Workbench::of_file(file.path());
    let one = homogeneous(0.2, [0.4, 0.6, 0.8]);
    let constant = shown(&mut bench, &camera(), &one, &[]);
    assert_sound(&constant, "constant");
    for classification in ["transfer_function", "preintegrated_fast", "preintegrated_full"] {
        let look = [("classification", classification)];
        let nothing = shown(&mut bench, &camera(), &TransferFunction::default(), &look);
        assert!(nothing.color.iter().flatten().all(|c| *c == 0.0), "{classification}");
        // Constant beyond the knots, wherever they are.
        for at in [-1e300, -5.0, 0.3, 7.0, 1e300] {
            let knots = one.knots.iter().map(|knot| Knot { at, ..*knot }).collect();
            let moved = TransferFunction::new(knots).expect("one knot");
            let d = difference(&constant, &shown(&mut bench, &camera(), &moved, &look));
            assert!(d <= OPACITY, "{classification}, {at:e}: {d}");
        }
        // Both ends as far away as can be: the data lie in the middle.
        let wide = function(&[(-1.7e308, [0.0; 3], 0.0), (1.7e308, [1.0; 3], 1.0)]);
        let half = shown(&mut bench, &camera(), &wide, &look);
        assert_sound(&half, classification);
        assert!(half.color.iter().all(|[r, _, _, a]| (r - 0.5 * a).abs() < 1e-4), "{classification}");
    }
}

/// T9: a spike of width `w` in the transfer function, crossed with slope `g`: opacity 1 - exp(-tau w / g).
fn spike(at: f64, width: f64) -> TransferFunction {
    let (clear, thick) = (([1.0; 3], 0.0), ([1.0; 3], 0.9));
    let knots = vec![Knot::split(at, clear, thick), Knot::split(at + width, thick, clear)];
    TransferFunction::new(knots).expect("a spike")
}

/// Opacity of a ramp from 0 to 1 over a length of 12 along x.
fn through_ramp(bench: &mut Workbench, function: &TransferFunction, classification: &str, samples: u32) -> f64 {
    bench.look(&Camera::orthographic(DVec3::X * -9.0, DVec3::X * 6.0, 0.3)).classify(function);
    bench.put("traversal.sampling", json!("trilinear")).put("traversal.classification", json!(classification));
    f64::from(bench.put("traversal.sampling_rate", json!(f64::from(samples) / 12.0)).render([4, 4]).at(1, 1)[3])
}

/// A voxel whose value is that of a step lies above it, however the values are stored, and nothing is blended.
#[test]
fn e40_steps_on_the_values_of_voxels() {
    let levels = 200u32;
    for (kind, from, bytes) in [
        ("u8", 30, (30..30 + levels as u8).collect::<Vec<u8>>()),
        ("u16", 5000, (5000..5000 + levels as u16).flat_map(u16::to_le_bytes).collect()),
        ("i16", -1000, (-1000..-1000 + levels as i16).flat_map(i16::to_le_bytes).collect()),
        ("f32", -7, (-7..-7 + levels as i16).flat_map(|value| f32::from(value).to_le_bytes()).collect()),
    ] {
        let file =
            VolumeFile::described(Some(&bytes), &json!({"raw": "voxels.raw", "dims": [levels, 1, 1], "type": kind}));
        let mut bench = Workbench::of_file(file.path());
        let middle = DVec3::X * f64::from(levels - 1) / 2.0;
        bench.look(&Camera::orthographic(middle - DVec3::X * 300.0, middle, 0.3));
        for sampling in ["nearest", "filtered"] {
            // Along the row of voxels, so that the centre of each is one of the samples.
            bench.put("traversal.sampling", json!(sampling)).put("traversal.sampling_rate", json!(1.0));
            for above in [1, 2, 3, 7, 50, 100, 131, 198, 199] {
                let at = f64::from(from) + f64::from(levels - above);
                let step = Knot::split(at, ([1.0; 3], 0.0), ([1.0; 3], 0.01));
                bench.classify(&TransferFunction::new(vec![step]).expect("one knot"));
                let expected = 1.0 - 0.99_f64.powi(above as i32);
                let found = f64::from(bench.render([4, 4]).at(1, 1)[3]);
                let name = format!("{kind}, {sampling}, {above} voxels from {at}");
                assert!((found - expected).abs() <= OPACITY, "{name}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn e40_e41_steps_and_spikes_narrower_than_a_sample() {
    let (mut bench, _, _file) = ramp_from_0_to_1(12);
    let length = 12.0;
    let tau = -(0.1_f64.ln());
    // As wide as several entries of the table of 256, as less than one, and as less than one of 1024; a sample is a third to a fifth of the range.
    for width in [0.1, 0.01, 0.002, 0.0002] {
        let expected = homogeneous_opacity(tau, width * length);
        // Less than an entry is too narrow for pre-integration, whose segments end anywhere between entries.
        let classifications: &[_] =
            if width < 1.0 / STEP_TABLE_2D { &[] } else { &["preintegrated_fast", "preintegrated_full"] };
        for classification in classifications {
            for samples in [3, 4, 5, 17] {
                let found = through_ramp(&mut bench, &spike(0.43, width), classification, samples);
                println!("E41 {classification}, width {width}, {samples} samples: {found:.6} for {expected:.6}");
                let name = format!("{classification}, width {width}, {samples} samples");
                assert!((found - expected).abs() <= SPIKE, "{name}: {found} for {expected}");
                // Long steps pass several bricks at once.
                for skipping in ["none", "occupancy", "distance"] {
                    bench.put("traversal.skipping", json!(skipping));
                    let skipped = through_ramp(&mut bench, &spike(0.43, width), classification, samples);
                    assert_eq!(skipped, found, "{name}, {skipping}");
                }
            }
        }
        // Samples at values see it once they are closer than it is wide.
        let found = through_ramp(&mut bench, &spike(0.43, width), "transfer_function", 20_000);
        println!("E41 transfer_function, width {width}: {found:.6} for {expected:.6}");
        // One sample more or less, and two steps a little off.
        let allowed = tau * length * (1.0 / 20_000.0 + 2.0 * STEP_PLACE);
        assert!((found - expected).abs() <= allowed, "transfer_function, {width}: {found} for {expected}");
    }
}
