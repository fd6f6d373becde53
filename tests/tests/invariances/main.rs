//! What must not change a picture: skipping empty space (I1), the directions of the voxel axes (I5, I6), cutting the volume in
//! two (I8), transparent voxels around it (I12); and what may change it only so much: early termination (I4), a camera that is
//! not quite parallel (I10), denser material (I11). Units of length (I7) and of values (I9) are among the extremes.

mod axes;
mod cuts;
mod limits;
mod skipping;

use rayloom_tests::Picture;
use rayloom_volume::{Knot, TransferFunction};

const SIZE: [u32; 2] = [64, 64];

/// Whether a picture shows something, but not everywhere.
fn assert_shows(picture: &Picture, name: &str) {
    let shown = picture.color.iter().filter(|pixel| pixel[3] > 0.01).count() as f64 / picture.color.len() as f64;
    assert!(shown > 0.05, "{name}: only {shown:.3} of the picture shows something");
}

/// Largest difference of any component.
fn difference(a: &Picture, b: &Picture) -> f64 {
    let pairs = a.color.iter().flatten().zip(b.color.iter().flatten());
    pairs.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most })
}

fn function(knots: &[(f64, [f64; 3], f64)]) -> TransferFunction {
    let knots = knots.iter().map(|&(at, color, opacity)| Knot::new(at, color, opacity)).collect();
    TransferFunction::new(knots).expect("sorted knots")
}
