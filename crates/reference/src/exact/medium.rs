//! One straight piece of a transfer function.

use rayloom_volume::{Rgba, TransferFunction, extinction, fraction};

/// Material whose straight colour and opacity run linearly with the value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Medium {
    low: f64,
    high: f64,
    below: Rgba,
    above: Rgba,
}

impl Medium {
    /// The piece of `function` that `value` lies on.
    pub(super) fn around(function: &TransferFunction, value: f64) -> Self {
        let knots = &function.knots;
        let next = knots.partition_point(|knot| knot.at <= value);
        let before = next.checked_sub(1).map(|index| &knots[index]);
        match (before, knots.get(next)) {
            (Some(low), Some(high)) => {
                Self { low: low.at, high: high.at, below: low.right_side(), above: high.left_side() }
            }
            (Some(knot), None) => Self::uniform(knot.right_side()),
            (None, Some(knot)) => Self::uniform(knot.left_side()),
            (None, None) => Self::uniform(Rgba::default()),
        }
    }

    /// The same material for all values.
    pub(super) fn uniform(material: Rgba) -> Self {
        Self { low: 0.0, high: 0.0, below: material, above: material }
    }

    /// Whether nothing can be seen of it.
    pub(super) fn is_transparent(&self) -> bool {
        self.below.opacity == 0.0 && self.above.opacity == 0.0
    }

    /// Extinction per reference length, where that is the same for all values.
    pub(super) fn constant_extinction(&self) -> Option<f64> {
        (self.below.opacity == self.above.opacity).then(|| extinction(self.below.opacity))
    }

    /// The straight colour, where that is the same for all values.
    pub(super) fn constant_color(&self) -> Option<[f64; 3]> {
        (self.below.color == self.above.color).then_some(self.below.color)
    }

    /// Extinction per reference length and straight colour at a value on the piece.
    ///
    /// Opacity 1 at a single value, an end of the piece, is a pole of the logarithm that has a finite integral; the cap of
    /// [`extinction`] is for pieces that are opaque throughout. Close to the pole the transmittance is interpolated, not one
    /// less the opacity, which would cancel.
    pub(super) fn at(&self, value: f64) -> (f64, [f64; 3]) {
        let t = fraction(value, self.low, self.high).clamp(0.0, 1.0);
        let rest = fraction(value, self.high, self.low).clamp(0.0, 1.0);
        let lerp = |a: f64, b: f64| if a == b { a } else { a * rest + b * t };
        let color = std::array::from_fn(|i| lerp(self.below.color[i], self.above.color[i]));
        if let Some(extinction) = self.constant_extinction() {
            return (extinction, color);
        }
        let opacity = lerp(self.below.opacity, self.above.opacity);
        let extinction = if opacity < 0.5 {
            -(-opacity).ln_1p()
        } else {
            -lerp(1.0 - self.below.opacity, 1.0 - self.above.opacity).max(f64::MIN_POSITIVE).ln()
        };
        (extinction, color)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayloom_volume::Knot;

    #[test]
    fn pieces_are_the_function() {
        let white = [1.0; 3];
        let function = TransferFunction {
            knots: vec![
                Knot::new(-1.0, [0.0, 0.5, 1.0], 0.2),
                Knot::split(0.5, ([1.0, 0.5, 0.0], 0.9), (white, 0.0)),
                Knot::new(2.0, [0.2; 3], 0.0),
                Knot::new(2.0, [0.3; 3], 0.4),
                Knot::new(3.0, white, 1.0),
            ],
        };
        for value in [-2.0, -1.0, -0.3, 0.49, 0.5, 1.0, 2.0, 2.5, 3.0, 4.0] {
            let expected = function.evaluate(value);
            let (found, color) = Medium::around(&function, value).at(value);
            assert!((found - extinction(expected.opacity)).abs() < 1e-14, "{value}: {found} {expected:?}");
            assert!((0..3).all(|i| (color[i] - expected.color[i]).abs() < 1e-15));
        }
        assert!(Medium::around(&function, 1.0).is_transparent());
        assert!(Medium::around(&TransferFunction::default(), 1.0).is_transparent());
        // Two units in the last place before opacity 1 the transmittance is still right.
        let near = 3.0 - 4.0 * f64::EPSILON;
        let (found, _) = Medium::around(&function, near).at(near);
        assert!((found + (0.6 * 4.0 * f64::EPSILON).ln()).abs() < 1e-9);
    }
}
