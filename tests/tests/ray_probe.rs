//! The ray probe sees what the picture is made of.

use glam::DVec3;
use rayloom_processors::Trace;
use rayloom_reference::Camera;
use rayloom_reference::field::{Field, Sampling};
use rayloom_reference::ray::AxisBox;
use rayloom_reference::same_samples::Lattice;
use rayloom_tests::chain::step;
use rayloom_tests::{Workbench, rays, tolerances};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

const SIZE: [u32; 2] = [48, 32];
const VOXELS: [u32; 3] = [60, 44, 30];

fn camera() -> Camera {
    Camera::perspective(DVec3::new(70.0, 35.0, -60.0), DVec3::new(3.0, 2.0, -1.0), 50.0)
}

/// A ball of which a part is visible.
fn ball() -> Workbench {
    let properties = json!({"field": "bucky_ball", "dims": VOXELS, "extent": [60.0, 66.0, 75.0]});
    let mut bench = Workbench::of_generator(&properties);
    let knots = [(0.3, [0.2, 0.4, 1.0], 0.0), (0.5, [0.9, 0.9, 0.2], 0.1), (0.9, [1.0, 0.3, 0.1], 0.5)];
    let knots = knots.map(|(value, color, opacity)| Knot::new(value, color, opacity));
    bench.classify(&TransferFunction::new(knots.to_vec()).expect("sorted knots")).look(&camera());
    bench
}

fn trace(bench: &mut Workbench, pixel: [u32; 2]) -> Trace {
    bench.runner.trace("traversal", pixel).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_ray_comes_to_the_pixel_bit_for_bit() {
    let cases = [
        ("dvr", "transfer_function", "none", 0.0),
        ("dvr", "transfer_function", "blinn_phong", 0.05),
        ("dvr", "transfer_function_2d", "none", 0.0),
        ("dvr", "preintegrated_fast", "none", 0.0),
        ("dvr", "preintegrated_full", "phong", 0.002),
        ("mip", "transfer_function", "none", 0.0),
        ("mean", "transfer_function", "none", 0.0),
        ("mida", "transfer_function", "none", 0.0),
        ("isosurface", "transfer_function", "blinn_phong", 0.0),
        ("isosurface_dvr", "transfer_function", "blinn_phong", 0.0),
    ];
    let mut bench = ball();
    let mut visible = 0;
    for (compositing, classification, shading, error) in cases {
        for (property, value) in
            [("compositing", compositing), ("classification", classification), ("shading", shading)]
        {
            bench.put(&format!("traversal.{property}"), json!(value));
        }
        bench.put("traversal.termination_error", json!(error));
        let picture = bench.render(SIZE);
        for pixel in [[24, 16], [20, 12], [29, 19], [17, 17], [24, 3]] {
            let traced = trace(&mut bench, pixel);
            let color = picture.at(pixel[0], pixel[1]);
            let name = format!("{compositing}, {classification}, {shading}, pixel {pixel:?}");
            assert_eq!(traced.outputs[0].color.map(f32::to_bits), color.map(f32::to_bits), "{name}: {traced:?}");
            visible += u32::from(color[3] > 0.0);
            let Some(last) = traced.samples.last() else { continue };
            // Elsewhere what lies behind the last sample taken belongs to the pixel, too.
            if compositing == "dvr" {
                assert_eq!(last.accumulated[0].map(f32::to_bits), color.map(f32::to_bits), "{name}");
                assert_eq!(last.shaded.is_some(), shading != "none", "{name}");
            }
        }
    }
    assert!(visible > 30, "{visible}");
}

#[test]
fn values_are_those_of_the_reference() {
    let mut bench = ball();
    bench.put("traversal.sampling", json!("trilinear")).put("traversal.skipping", json!("none"));
    bench.put("traversal.sampling_rate", json!(1.7));
    bench.render(SIZE);
    let volume = bench.volume();
    let field = Field::new(&volume, 0, Sampling::Trilinear);
    let chords = rays::chords(&camera(), SIZE, &volume, &AxisBox { min: DVec3::ZERO, max: DVec3::ONE });
    let mut worst = 0.0_f64;
    for pixel in [[24, 16], [20, 12], [29, 19], [26, 13]] {
        let chord = chords[(pixel[1] * SIZE[0] + pixel[0]) as usize].expect("a ray through the volume");
        let lattice = Lattice { step: step(&camera(), SIZE, &volume, 1.7), shift: 0.0, from: 0.0, to: chord.length };
        let traced = trace(&mut bench, pixel);
        assert!((traced.length - chord.length).abs() < 1e-5 * chord.length, "{} {}", traced.length, chord.length);
        assert_eq!(traced.count as usize, lattice.steps().count());
        for (sample, expected) in traced.samples.iter().zip(lattice.samples()) {
            let share = expected.position / chord.length;
            let value = field.at_texture(chord.segment.at(share));
            worst = worst.max((sample.value - value).abs() / field.range().width());
            assert!((sample.distance - share * chord.length).abs() < 1e-5 * chord.length);
        }
    }
    println!("values of the ray probe are off by at most {worst:e} of the range");
    assert!(worst > 0.0 && worst < tolerances::PROBED_VALUE, "{worst:e}");
}

#[test]
fn skipped_samples_are_gaps_and_the_rest_is_the_same() {
    let mut bench = ball();
    let mut of = |skipping: &str| {
        bench.put("traversal.skipping", json!(skipping)).render(SIZE);
        trace(&mut bench, [24, 16])
    };
    let [all, some] = ["none", "distance"].map(&mut of);
    assert!(all.samples.iter().zip(0..).all(|(sample, index)| sample.index == index));
    assert_eq!((all.taken, all.count), (all.count, some.count));
    assert!(some.taken < all.taken && some.taken > 0, "{} of {}", some.taken, all.taken);
    for sample in &some.samples {
        assert_eq!(*sample, all.samples[sample.index as usize]);
    }
    let taken = |index: u32| some.samples.iter().any(|sample| sample.index == index);
    let skipped = all.samples.iter().filter(|sample| !taken(sample.index));
    assert!(skipped.clone().all(|sample| sample.classified.is_some_and(|medium| medium[3] == 0.0)));
    assert_eq!(skipped.count() as u32, all.taken - some.taken);
}

#[test]
fn leaving_a_ray_early_and_running_out_of_room_are_told() {
    let mut bench = ball();
    bench.put("traversal.termination_error", json!(0.5)).put("traversal.reference_length", json!(0.2)).render(SIZE);
    let left = trace(&mut bench, [24, 16]);
    let last = left.samples.last().expect("samples");
    assert!(left.stopped && last.accumulated[0][3] > 0.5 && last.index + 1 < left.count, "{last:?}");

    bench.put("traversal.sampling_rate", json!(900.0)).put("traversal.skipping", json!("none"));
    bench.put("traversal.termination_error", json!(0.0));
    // A small picture: it is not looked at.
    bench.render([6, 4]);
    let long = trace(&mut bench, [3, 2]);
    assert!(long.count > 32768 && long.taken == long.count, "{} {}", long.count, long.taken);
    assert_eq!((long.samples.len(), long.truncated()), (32768, long.count - 32768));
}

#[test]
fn where_there_is_no_ray_the_reason_is_told() {
    let mut bench = ball();
    let error = bench.runner.trace("traversal", [0, 0]).expect_err("nothing has been rendered");
    assert!(error.message.contains("no picture"), "{error}");
    bench.render(SIZE);
    let missed = trace(&mut bench, [0, 0]);
    assert!(missed.samples.is_empty() && missed.absence().is_some_and(|why| why.contains("misses")), "{missed:?}");
    let error = bench.runner.trace("traversal", SIZE).expect_err("outside of the picture");
    assert!(error.message.contains("48,32") && error.message.contains("48 x 32"), "{error}");
    assert!(bench.runner.trace("source", [0, 0]).is_err());
}
