//! T4, T5, T6 linear fields under linear extinction, T8 a step in the transfer function.

use rayloom_reference::Camera;
use rayloom_reference::closed_forms::{LinearRamp, step_opacity};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::{Chord, chords, tabulated};
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::{largest, linear_slab, orders, scientific, slab_cameras};

const SIZE: [u32; 2] = [24, 24];
/// Odd, so that neither voxels nor table entries fall together with samples.
const INTERVALS: u32 = 13;

/// A scene of T4 to T6: the field `start + slope x` on `0..length` and its material.
#[derive(Clone, Copy)]
struct Ramp {
    start: f64,
    slope: f64,
    density: f64,
    color_offset: f64,
    color_scale: f64,
    length: f64,
}

impl Ramp {
    /// The formula for one ray.
    fn along(&self, chord: &Chord) -> LinearRamp {
        let [from, to] = [chord.segment.from, chord.segment.to].map(|t| self.start + self.slope * chord.ray.at(t).x);
        LinearRamp {
            start: from.max(0.0),
            slope: (to - from) / chord.length,
            density: self.density,
            color_offset: self.color_offset,
            color_scale: self.color_scale,
            length: chord.length,
        }
    }

    /// Largest errors of colour and opacity with this many samples over the length, seen from one camera.
    fn errors(&self, bench: &mut Workbench, clip: &AxisBox, camera: &Camera, samples: u32) -> [f64; 2] {
        let volume = bench.volume();
        bench.put("traversal.sampling_rate", json!(f64::from(samples) / f64::from(INTERVALS)));
        let picture = bench.look(camera).render(SIZE);
        // Rays that only cut an edge of the slab are short; what they show is as right, but says little.
        let judged: Vec<[f64; 2]> = chords(camera, SIZE, &volume, clip)
            .iter()
            .zip(&picture.color)
            .filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)))
            .map(|(chord, pixel)| {
                let exact = self.along(chord);
                [(f64::from(pixel[0]) - exact.color()).abs(), (f64::from(pixel[3]) - exact.opacity()).abs()]
            })
            .collect();
        [0, 1].map(|i| largest(&judged.iter().map(|errors| errors[i]).collect::<Vec<_>>()))
    }

    fn bench(&self) -> (Workbench, AxisBox, rayloom_tests::VolumeFile) {
        let (mut bench, clip, file) = linear_slab(INTERVALS, self.length, |x| self.start + self.slope * x);
        let range = bench.volume().ranges()[0];
        let color = |s: f64| [self.color_offset + self.color_scale * s; 3];
        bench.classify(&tabulated(range, |s| self.density * s.max(0.0), color));
        (bench, clip, file)
    }
}

const T4: Ramp = Ramp { start: 0.0, slope: 1.0, density: 2.0, color_offset: 1.0, color_scale: 0.0, length: 1.0 };
const T5: Ramp = Ramp { color_offset: 0.0, color_scale: 1.0, ..T4 };
const T6: Ramp = Ramp { start: 0.2, slope: 0.6, density: 3.0, color_offset: 0.1, color_scale: 0.5, length: 1.3 };

#[test]
fn t4_the_midpoint_rule_gives_a_linear_ramp_its_exact_opacity() {
    for sampling in ["filtered", "trilinear"] {
        let (mut bench, clip, _file) = T4.bench();
        bench.put("traversal.sampling", json!(sampling));
        let mut worst: f64 = 0.0;
        for camera in slab_cameras(T4.length) {
            for samples in [1, 2, 5, 16, 77, 400] {
                worst = T4.errors(&mut bench, &clip, &camera, samples).into_iter().fold(worst, f64::max);
            }
        }
        println!("T4, {sampling}: largest error {worst:.2e}");
        assert!(worst <= OPACITY, "{sampling}: {worst}");
    }
}

/// Errors of the colour at halved steps fall with their square until arithmetic takes over.
fn assert_second_order(name: &str, ramp: Ramp, camera: &Camera) {
    let (mut bench, clip, _file) = ramp.bench();
    let samples = [8, 16, 32, 64, 128, 256, 512, 1024];
    let errors = samples.map(|samples| ramp.errors(&mut bench, &clip, camera, samples)[0]);
    let orders = orders(&errors);
    println!("{name}: errors {}, orders {orders:.3?}", scientific(&errors));
    assert!(errors[2] <= RAMP_AT_32, "{name}: {}", errors[2]);
    let judged = orders.iter().zip(&errors[1..]).take_while(|(_, error)| **error > ORDER_ABOVE);
    let judged: Vec<f64> = judged.map(|(order, _)| *order).collect();
    assert!(judged.len() >= 2, "{name}: too few steps show an order");
    // The ends of the slab cut steps at places that change with the step.
    assert!(judged.iter().all(|order| SECOND_ORDER_IRREGULAR.contains(order)), "{name}: {judged:?}");
    assert!(errors[judged.len() + 1..].iter().all(|error| *error <= ORDER_ABOVE), "{name}: {errors:?}");
}

#[test]
fn t5_converges_with_the_square_of_the_step() {
    for (name, camera) in ["T5", "T5 from behind", "T5 askew"].iter().zip(slab_cameras(T5.length)) {
        assert_second_order(name, T5, &camera);
    }
}

#[test]
fn t6_converges_with_the_square_of_the_step() {
    let [camera, ..] = slab_cameras(T6.length);
    let (mut bench, _, _file) = T6.bench();
    bench.put("traversal.sampling_rate", json!(256.0 / f64::from(INTERVALS)));
    let center = bench.look(&camera).render([1, 1]).at(0, 0).map(f64::from);
    println!("T6: C {} for 0.3348845174, A {} for 0.8998413650", center[0], center[3]);
    assert!((center[0] - 0.334_884_517_4).abs() <= RAMP_AT_256 && (center[3] - 0.899_841_365_0).abs() <= OPACITY);
    for (name, camera) in ["T6", "T6 from behind", "T6 askew"].iter().zip(slab_cameras(T6.length)) {
        assert_second_order(name, T6, &camera);
    }
}

#[test]
fn t8_a_step_is_met_to_half_a_step_and_exactly_by_pre_integration() {
    let (tau, threshold) = (3.0, 0.37);
    let (mut bench, _, _file) = linear_slab(INTERVALS, 1.0, |x| x);
    let clear = ([1.0; 3], 0.0);
    let step = Knot::split(threshold, clear, ([1.0; 3], step_opacity(tau, 0.0, 1.0)));
    bench.classify(&TransferFunction::new(vec![step]).expect("one knot"));
    let [camera, ..] = slab_cameras(1.0);
    let exact = step_opacity(tau, threshold, 1.0);
    let mut error = |classification: &str, samples: u32| {
        bench.put("traversal.classification", json!(classification));
        bench.put("traversal.sampling_rate", json!(f64::from(samples) / f64::from(INTERVALS)));
        f64::from(bench.look(&camera).render([4, 4]).at(1, 1)[3]) - exact
    };
    // Sums of the irregular errors at a spread of steps: their mean order is what the method has.
    let spread = |error: &mut dyn FnMut(u32) -> f64, around: u32| {
        let counts = (0..25).map(|part| around + around * part / 25);
        crate::rms(&counts.map(&mut *error).collect::<Vec<_>>())
    };
    for samples in [7, 10, 33, 64, 150, 400] {
        let bound = tau * (0.5 / f64::from(samples) + STEP_PLACE);
        let found = error("transfer_function", samples);
        println!("T8 post, {samples} samples: error {found:.2e}, bound {bound:.2e}");
        assert!(found.abs() <= bound, "{samples}: {found}");
    }
    let errors = [10, 20, 40, 80].map(|around| spread(&mut |samples| error("transfer_function", samples), around));
    let order = (errors[0] / errors[3]).log2() / 3.0;
    println!("T8 post: rms errors {}, mean order {order:.3}", scientific(&errors));
    assert!(FIRST_ORDER.contains(&order), "{order}");
    for classification in ["preintegrated_fast", "preintegrated_full"] {
        for samples in [7, 10, 15, 33, 51, 64, 150, 255, 400] {
            let found = error(classification, samples);
            println!("T8 {classification}, {samples} samples: error {found:.2e}");
            assert!(found.abs() <= tau / (STEP_TABLE_2D * 2.0), "{classification}, {samples}: {found}");
        }
    }
}
