//! Transfer functions of one value: knots with straight lines between them.

use serde::{Deserialize, Serialize};

use super::{Medium, Rgba, TransferFunctionError, check_finite, check_unit};
use crate::{ValueRange, fraction};

/// A point of a transfer function. A split knot has another colour and opacity on its right side: the function jumps there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knot {
    /// The value, data units.
    pub at: f64,
    /// Straight red, green, blue; 0 to 1.
    pub color: [f64; 3],
    /// Opacity per reference length; 0 to 1.
    pub opacity: f64,
    /// Colour and opacity at the value itself and to its right, where they differ from those to its left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right: Option<RightSide>,
}

/// The right side of a split knot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RightSide {
    /// Straight red, green, blue; 0 to 1.
    pub color: [f64; 3],
    /// Opacity per reference length; 0 to 1.
    pub opacity: f64,
}

impl Knot {
    /// A knot whose two sides are equal.
    pub fn new(at: f64, color: [f64; 3], opacity: f64) -> Self {
        Self { at, color, opacity, right: None }
    }

    /// A knot where the function jumps from the first colour and opacity to the second.
    pub fn split(at: f64, left: ([f64; 3], f64), right: ([f64; 3], f64)) -> Self {
        Self { at, color: left.0, opacity: left.1, right: Some(RightSide { color: right.0, opacity: right.1 }) }
    }

    /// Colour and opacity just below [`Knot::at`].
    pub fn left_side(&self) -> Rgba {
        Rgba { color: self.color, opacity: self.opacity }
    }

    /// Colour and opacity at [`Knot::at`] and just above.
    pub fn right_side(&self) -> Rgba {
        self.right.map_or(self.left_side(), |right| Rgba { color: right.color, opacity: right.opacity })
    }

    fn check(&self, index: usize) -> Result<(), TransferFunctionError> {
        check_finite(|| format!("`at` of knot {index}"), self.at)?;
        for (side, rgba) in [("", self.left_side()), ("the right side of ", self.right_side())] {
            for (name, component) in ["red", "green", "blue"].into_iter().zip(rgba.color) {
                check_unit(|| format!("{name} of {side}knot {index}"), component)?;
            }
            check_unit(|| format!("the opacity of {side}knot {index}"), rgba.opacity)?;
        }
        Ok(())
    }
}

/// A piecewise linear transfer function over values in data units.
///
/// Straight colour and opacity run linearly from knot to knot and are constant outside of the first and the last. Where the
/// function jumps (a split knot, or several knots at one value) it is continuous from the right. Without knots everything is
/// transparent black.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct TransferFunction {
    /// The knots, sorted by value. After changing them, [`TransferFunction::check`] tells whether they still make sense.
    pub knots: Vec<Knot>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    knots: Vec<Knot>,
}

impl TryFrom<Unchecked> for TransferFunction {
    type Error = TransferFunctionError;

    fn try_from(unchecked: Unchecked) -> Result<Self, Self::Error> {
        Self::new(unchecked.knots)
    }
}

impl TransferFunction {
    /// A transfer function of these knots.
    ///
    /// # Errors
    /// See [`TransferFunction::check`].
    pub fn new(knots: Vec<Knot>) -> Result<Self, TransferFunctionError> {
        let function = Self { knots };
        function.check()?;
        Ok(function)
    }

    /// A straight ramp over `range`: transparent black at its minimum, white with the given opacity at its maximum.
    pub fn ramp(range: ValueRange, opacity: f64) -> Self {
        Self { knots: vec![Knot::new(range.min, [0.0; 3], 0.0), Knot::new(range.max, [1.0; 3], opacity)] }
    }

    /// Checks that every number is finite, the knots are sorted (several at one value are fine) and colours and opacities
    /// lie between 0 and 1.
    ///
    /// # Errors
    /// The first thing that is wrong, with the number of its knot.
    pub fn check(&self) -> Result<(), TransferFunctionError> {
        for (index, knot) in self.knots.iter().enumerate() {
            knot.check(index)?;
        }
        let pairs = self.knots.windows(2).enumerate();
        match pairs.into_iter().find(|(_, pair)| pair[1].at < pair[0].at) {
            None => Ok(()),
            Some((index, pair)) => {
                Err(TransferFunctionError::NotSorted { index: index + 1, found: pair[1].at, previous: pair[0].at })
            }
        }
    }

    /// Straight colour and opacity per reference length at a value in data units. NaN counts as below every knot.
    pub fn evaluate(&self, value: f64) -> Rgba {
        let above = self.knots.partition_point(|knot| knot.at <= value);
        let Some(below) = above.checked_sub(1).map(|index| &self.knots[index]) else {
            return self.knots.first().map_or(Rgba::default(), Knot::left_side);
        };
        let Some(next) = self.knots.get(above) else {
            return below.right_side();
        };
        mix(below.right_side(), next.left_side(), fraction(value, below.at, next.at))
    }

    /// Emission and extinction per reference length at a value in data units.
    pub fn medium(&self, value: f64) -> Medium {
        self.evaluate(value).medium()
    }

    /// A table of `n` entries (extinction times red, green and blue, extinction) per reference length: entry `i` is the
    /// function at `range.min + i / (n - 1) * (range.max - range.min)`, so the ends of the range lie on the first and the
    /// last entry. Evaluated in `f64`.
    pub fn table(&self, range: ValueRange, n: usize) -> Vec<[f32; 4]> {
        (0..n).map(|i| self.medium(table_value(range, n, i)).to_entry()).collect()
    }

    /// Whether the opacity is exactly zero on the whole closed interval `min ..= max`, data units. Exact, from the knots.
    pub fn transparent_between(&self, min: f64, max: f64) -> bool {
        let ends_are_clear = [min, max].iter().all(|&end| self.evaluate(end).opacity == 0.0);
        ends_are_clear
            && self.knots.windows(2).all(|pair| {
                let overlaps = pair[0].at.max(min) < pair[1].at.min(max);
                !overlaps || (pair[0].right_side().opacity == 0.0 && pair[1].left_side().opacity == 0.0)
            })
    }
}

fn mix(a: Rgba, b: Rgba, t: f64) -> Rgba {
    let lerp = |a: f64, b: f64| a * (1.0 - t) + b * t;
    Rgba { color: std::array::from_fn(|c| lerp(a.color[c], b.color[c])), opacity: lerp(a.opacity, b.opacity) }
}

/// The value, data units, of entry `i` of a table of `n` entries over `range`.
pub(super) fn table_value(range: ValueRange, n: usize, i: usize) -> f64 {
    match i {
        0 => range.min,
        i if i + 1 >= n => range.max,
        i => range.denormalise(i as f64 / (n - 1) as f64),
    }
}

/// The interval `min ..= max` (data units) widened to whole cells of a table of `n` entries over `range`. A table that is
/// interpolated linearly reads nothing outside of it, so what is transparent on the widened interval is transparent when
/// read through the table. Ends outside of the range stay: tables are constant there.
pub fn table_interval(range: ValueRange, n: usize, min: f64, max: f64) -> (f64, f64) {
    if n < 2 || range.max <= range.min {
        return (min.min(range.min), max.max(range.max));
    }
    let cells = (n - 1) as f64;
    // A hundredth of a cell covers what is lost when a value is normalised and stored in f32 on its way to the table.
    let low = (range.normalise(min) * cells - 0.01).floor().clamp(0.0, cells);
    let high = (range.normalise(max) * cells + 0.01).ceil().clamp(0.0, cells);
    (min.min(range.denormalise(low / cells)), max.max(range.denormalise(high / cells)))
}
