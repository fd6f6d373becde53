//! Extremes, by the numbers E1 to E70 of docs/EXTREMES.md. Here are those of the whole program on the device; cameras have
//! their own program, `camera`, and what needs no device is tested in its crate.

mod catalogue;
mod knobs;
mod opacity;
mod sampling;
mod values;
mod worlds;

use glam::{DAffine3, DVec3};
use rayloom_reference::Camera;
use rayloom_tests::{Grid, Picture, Workbench};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

const SIZE: [u32; 2] = [32, 32];

fn function(knots: &[(f64, [f64; 3], f64)]) -> TransferFunction {
    let knots = knots.iter().map(|&(at, color, opacity)| Knot::new(at, color, opacity)).collect();
    TransferFunction::new(knots).expect("sorted knots")
}

/// A ramp over these values that shows everything.
fn ramp(low: f64, high: f64) -> TransferFunction {
    function(&[
        (low, [0.1, 0.3, 0.9], 0.02),
        (0.5 * low + 0.5 * high, [0.9, 0.8, 0.2], 0.2),
        (high, [1.0, 0.2, 0.1], 0.6),
    ])
}

/// A lopsided thing with values from about 0 to 1 at the voxels of a grid.
fn thing([x, y, z]: [f64; 3]) -> f64 {
    let blob = |center: [f64; 3], sigma: f64| {
        let d = DVec3::new(x, y, z) - DVec3::from_array(center);
        (-d.length_squared() / (2.0 * sigma * sigma)).exp()
    };
    0.8 * blob([5.0, 4.0, 6.0], 3.0) + 0.6 * blob([10.0, 9.0, 3.0], 2.0) + 0.1 * (0.7 * x).sin() + 0.1
}

/// The thing on 14 x 12 x 10 voxels.
fn thing_grid(index_to_world: DAffine3) -> Grid {
    Grid::of_index([14, 12, 10], index_to_world, |index| thing(index.map(f64::from)))
}

/// Looks at a box of `extent` around `center` from the upper left.
fn outside(center: DVec3, extent: f64) -> Camera {
    let eye = center + extent * DVec3::new(-1.1, 0.8, 1.3);
    Camera { up: DVec3::Y, ..Camera::perspective(eye, center, 40.0) }
}

/// What a chain shows from `camera`, with properties of the traversal in JSON or as bare words.
fn shown(bench: &mut Workbench, camera: &Camera, function: &TransferFunction, look: &[(&str, &str)]) -> Picture {
    bench.look(camera).classify(function);
    for (property, value) in look {
        let value = serde_json::from_str(value).unwrap_or_else(|_| json!(value));
        bench.put(&format!("traversal.{property}"), value);
    }
    bench.render(SIZE)
}

/// Largest difference of any component.
fn difference(a: &Picture, b: &Picture) -> f64 {
    let pairs = a.color.iter().flatten().zip(b.color.iter().flatten());
    pairs.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most })
}

/// Whether two pictures are the same, bit by bit, depths included.
fn same_bits(a: &Picture, b: &Picture) -> bool {
    let bits = |p: &Picture| -> Vec<u32> { p.color.iter().flatten().chain(&p.depth).map(|x| x.to_bits()).collect() };
    bits(a) == bits(b)
}

/// Every number is finite, and a good part of the picture shows something.
fn assert_sound(picture: &Picture, name: &str) {
    assert!(picture.color.iter().flatten().chain(&picture.depth).all(|x| x.is_finite()), "{name}: not finite");
    let shown = picture.color.iter().filter(|pixel| pixel[3] > 0.01).count() as f64 / picture.color.len() as f64;
    assert!(shown > 0.1, "{name}: only {shown:.3} of the picture shows something");
}
