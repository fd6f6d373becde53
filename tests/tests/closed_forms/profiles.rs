//! T7 an atmosphere that thins out, T9 a spike in the transfer function, both along a linear field.

use rayloom_reference::closed_forms::{atmosphere_opacity, spike_opacity};
use rayloom_tests::rays::tabulated;
use rayloom_tests::{Workbench, tolerances::*};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

use crate::{linear_slab, orders, scientific, slab_cameras};

/// Odd, so that neither voxels nor table entries fall together with samples.
const INTERVALS: u32 = 13;

/// The opacity of the middle ray with this many samples.
fn opacity(bench: &mut Workbench, samples: u32) -> f64 {
    bench.put("traversal.sampling_rate", json!(f64::from(samples) / f64::from(INTERVALS)));
    f64::from(bench.render([4, 4]).at(1, 1)[3])
}

#[test]
fn t7_an_atmosphere_converges_with_the_square_of_the_step() {
    let (surface, height) = (4.0, 0.3);
    let exact = atmosphere_opacity(surface, height, 1.0);
    let (mut bench, _, _file) = linear_slab(INTERVALS, 1.0, |x| x);
    let range = bench.volume().ranges()[0];
    bench.classify(&tabulated(range, |altitude| surface * (-altitude / height).exp(), |_| [1.0; 3]));
    let [up, down, _] = slab_cameras(1.0);
    for (name, camera) in [("up", up), ("down", down)] {
        bench.look(&camera);
        let errors = [8, 16, 32, 64, 128, 256].map(|samples| (opacity(&mut bench, samples) - exact).abs());
        let orders = orders(&errors);
        println!("T7, {name}: errors {}, orders {orders:.3?}", scientific(&errors));
        let judged = orders.iter().zip(&errors[1..]).take_while(|(_, error)| **error > ORDER_ABOVE).count();
        assert!(judged >= 2, "{name}: too few steps show an order");
        assert!(orders[..judged].iter().all(|order| SECOND_ORDER_IRREGULAR.contains(order)), "{name}: {orders:?}");
        assert!(errors[judged + 1..].iter().all(|error| *error <= ORDER_ABOVE), "{name}: {errors:?}");
    }
}

#[test]
fn t9_a_spike_is_missed_by_long_steps_and_met_exactly_by_pre_integration() {
    let (tau, from, width) = (20.0, 0.37, 0.02);
    let exact = spike_opacity(tau, width, 1.0);
    let (mut bench, _, _file) = linear_slab(INTERVALS, 1.0, |x| x);
    let (clear, dense) = (([1.0; 3], 0.0), ([1.0; 3], 1.0 - (-tau).exp()));
    let spike = vec![Knot::split(from, clear, dense), Knot::split(from + width, dense, clear)];
    bench.classify(&TransferFunction::new(spike).expect("rising knots"));
    let [camera, ..] = slab_cameras(1.0);
    bench.look(&camera);
    // Samples at 0.35 and 0.45: none in the spike.
    assert_eq!(opacity(&mut bench, 10), 0.0);
    for samples in [110, 190, 400, 900] {
        let found = opacity(&mut bench, samples);
        // Half a step at either side of the spike.
        let bound = tau * (1.0 / f64::from(samples) + 2.0 * STEP_PLACE);
        println!("T9 post, {samples} samples: error {:.2e}, bound {bound:.2e}", found - exact);
        assert!((found - exact).abs() <= bound, "{samples}: {found} for {exact}");
    }
    for classification in ["preintegrated_fast", "preintegrated_full"] {
        bench.put("traversal.classification", json!(classification));
        for samples in [5, 15, 51, 255] {
            let found = opacity(&mut bench, samples);
            println!("T9 {classification}, {samples} samples: error {:.2e}", found - exact);
            // Segments end between entries of the table, which blunts both ends of the spike.
            assert!((found - exact).abs() <= tau / STEP_TABLE_2D, "{classification}, {samples}: {found} for {exact}");
        }
    }
}
