//! Rays and transfer functions as tests take them: what makes no sense panics.

pub use rayloom_measure::verify::rays::{Chord, TABLE};
use rayloom_reference::Camera;
use rayloom_reference::ray::AxisBox;
use rayloom_volume::{Knot, TransferFunction, ValueRange, Volume};

/// See [`rayloom_measure::verify::rays::chords`].
pub fn chords(camera: &Camera, size: [u32; 2], volume: &Volume, clip: &AxisBox) -> Vec<Option<Chord>> {
    rayloom_measure::verify::rays::chords(camera, size, volume, clip).unwrap_or_else(|error| panic!("{error}"))
}

/// See [`rayloom_measure::verify::rays::tabulated`].
pub fn tabulated(
    range: ValueRange,
    extinction: impl Fn(f64) -> f64,
    color: impl Fn(f64) -> [f64; 3],
) -> TransferFunction {
    rayloom_measure::verify::rays::tabulated(range, extinction, color).unwrap_or_else(|error| panic!("{error}"))
}

/// A material of one colour and one extinction for every value.
pub fn homogeneous(extinction: f64, color: [f64; 3]) -> TransferFunction {
    TransferFunction::new(vec![Knot::new(0.0, color, -(-extinction).exp_m1())])
        .unwrap_or_else(|error| panic!("{error}"))
}
