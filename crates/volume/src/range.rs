//! Ranges of values and the one rule that maps a value to `0 ..= 1`.

use serde::{Deserialize, Serialize};

/// A closed range of values in data units; both ends are finite and `min <= max`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValueRange {
    /// The smallest value, data units.
    pub min: f64,
    /// The largest value, data units.
    pub max: f64,
}

impl ValueRange {
    /// The range from `min` to `max`, data units.
    pub fn new(min: f64, max: f64) -> Self {
        Self { min, max }
    }

    /// `max - min`, data units. Infinite when the ends are further apart than the largest `f64`.
    pub fn width(&self) -> f64 {
        self.max - self.min
    }

    /// `(value - min) / (max - min)`: 0 at the minimum, 1 at the maximum, outside of `0 ..= 1` beyond them; 0 when the
    /// range is one value wide.
    pub fn normalise(&self, value: f64) -> f64 {
        fraction(value, self.min, self.max)
    }

    /// The value, data units, whose normalised value is `normalised`.
    pub fn denormalise(&self, normalised: f64) -> f64 {
        self.min * (1.0 - normalised) + self.max * normalised
    }

    /// The value to render for `value`: NaN becomes the minimum, an infinity the end it lies beyond, everything else stays.
    pub fn finite_value(&self, value: f64) -> f64 {
        match value {
            v if v.is_nan() => self.min,
            f64::INFINITY => self.max,
            f64::NEG_INFINITY => self.min,
            v => v,
        }
    }
}

/// Where `value` lies between `from` (0) and `to` (1), not clamped; 0 when the two are equal. Ends that are further apart
/// than the largest `f64` are halved first, so that the result stays finite.
pub fn fraction(value: f64, from: f64, to: f64) -> f64 {
    let width = to - from;
    if width == 0.0 {
        0.0
    } else if width.is_finite() {
        (value - from) / width
    } else {
        (value / 2.0 - from / 2.0) / (to / 2.0 - from / 2.0)
    }
}
