//! Transfer functions: from values to colour and extinction.
//!
//! Opacity is *per reference length*: the opacity of a homogeneous slab one reference length thick. What is integrated along
//! rays is the extinction, see [`extinction`].

mod labels;
mod one_dimensional;
mod preintegration;
mod split_table;
mod two_dimensional;

pub use labels::{Label, LabelTable};
pub use one_dimensional::{Knot, RightSide, TransferFunction, table_interval};
pub use split_table::SplitTable;
pub use two_dimensional::{Primitive, Shape, TransferFunction2D};

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The extinction, per reference length, of opacity 1. It leaves less than `f32` can tell from opaque at any step above a
/// hundred-thousandth of the reference length.
pub const MAX_EXTINCTION: f64 = 1e6;

/// The extinction per reference length, `-ln(1 - opacity)`, of an opacity per reference length in `0 ..= 1`; opacity 1 gives
/// [`MAX_EXTINCTION`].
pub fn extinction(opacity: f64) -> f64 {
    (-(-opacity).ln_1p()).min(MAX_EXTINCTION)
}

/// A straight (not premultiplied) colour with an opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rgba {
    /// Red, green, blue; 0 to 1.
    pub color: [f64; 3],
    /// Opacity per reference length; 0 to 1.
    pub opacity: f64,
}

impl Rgba {
    /// The optical properties of this colour and opacity.
    pub fn medium(&self) -> Medium {
        let extinction = extinction(self.opacity);
        Medium { emission: self.color.map(|c| c * extinction), extinction }
    }
}

/// What a ray integrates: emission and extinction per reference length. Along a homogeneous length L the opacity is
/// `1 - exp(-extinction L)` and the premultiplied colour `emission / extinction` times that opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Extinction times colour, per reference length.
    pub emission: [f64; 3],
    /// Extinction per reference length, `0 ..= MAX_EXTINCTION`.
    pub extinction: f64,
}

impl Medium {
    /// Emission and extinction as an entry of a table, in `f32`.
    pub fn to_entry(&self) -> [f32; 4] {
        let [r, g, b] = self.emission;
        [r as f32, g as f32, b as f32, self.extinction as f32]
    }
}

/// Why a transfer function is refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TransferFunctionError {
    /// A number is not finite.
    #[error("{part} is {found}, but must be a finite number")]
    NotFinite {
        /// Which number of which knot or primitive.
        part: String,
        /// What it is.
        found: f64,
    },
    /// A number lies outside of `0 ..= 1`.
    #[error("{part} is {found}, but must lie between 0 and 1")]
    OutOfUnit {
        /// Which number of which knot or primitive.
        part: String,
        /// What it is.
        found: f64,
    },
    /// Knots are not sorted.
    #[error("knot {index} lies at {found}, before the knot in front of it at {previous}; knots must be sorted by `at`")]
    NotSorted {
        /// The number of the knot, from 0.
        index: usize,
        /// Where it lies.
        found: f64,
        /// Where the knot before it lies.
        previous: f64,
    },
    /// A shape has no area.
    #[error("{part} runs from {low} to {high}, but the second end must be larger than the first")]
    Empty {
        /// Which extent of which primitive.
        part: String,
        /// The first end.
        low: f64,
        /// The second end.
        high: f64,
    },
}

fn check_finite(part: impl FnOnce() -> String, found: f64) -> Result<(), TransferFunctionError> {
    if found.is_finite() { Ok(()) } else { Err(TransferFunctionError::NotFinite { part: part(), found }) }
}

fn check_unit(part: impl FnOnce() -> String, found: f64) -> Result<(), TransferFunctionError> {
    match found {
        f if !f.is_finite() => Err(TransferFunctionError::NotFinite { part: part(), found }),
        f if !(0.0..=1.0).contains(&f) => Err(TransferFunctionError::OutOfUnit { part: part(), found }),
        _ => Ok(()),
    }
}

fn check_extent(part: impl Fn() -> String, [low, high]: [f64; 2]) -> Result<(), TransferFunctionError> {
    check_finite(&part, low)?;
    check_finite(&part, high)?;
    if low < high { Ok(()) } else { Err(TransferFunctionError::Empty { part: part(), low, high }) }
}
