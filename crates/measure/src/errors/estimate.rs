//! The error of a picture without its reference: Richardson's estimate from pictures at halved steps.
//!
//! Where errors fall with the power `p` of the step, a picture at step `d` differs from the one at `d / 2` by `2^p - 1` times the
//! error of the latter if errors only shrink, and by `sqrt(4^p + 1)` times, root mean square, if they are as good as independent
//! from step to step: at jumps in the material, in the data and in the lighting, where the power is 1, and, in part, at the faces
//! of cells, where it is 2. The geometric mean of the two is off by a sixth for `p = 2`, and by a third for `p = 1`, at most. Two
//! differences in a row tell the power; one above 2 is luck and counts as 2.
//!
//! What no picture shows, such as a spike of the transfer function that every step misses in every pixel, no estimate from
//! pictures can know.

use rayloom_reference::Comparison;
use rayloom_reference::metrics::Pixel;

use crate::MeasureError;

/// The powers that are taken at their word.
const ORDERS: [f64; 2] = [0.6, 2.0];
/// Changes below this are those of arithmetic and tell no power.
const ROUND_OFF: f64 = 2e-6;

/// How far a picture is from the one without steps, by estimate. Of every pixel the largest error of its four premultiplied
/// channels counts, as in [`crate::Errors`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Root of the mean square error of the finer picture.
    pub rmse: f64,
    /// The error that 99 % of its pixels do not exceed.
    pub p99: f64,
    /// The power of the step with which errors fall, as observed; none where two pictures cannot tell it, or only arithmetic is
    /// left. Then the first power is assumed, which is on the safe side.
    pub order: Option<f64>,
}

impl Estimate {
    /// From pictures at steps `d` and `d / 2` and, if there is one, the picture at `2 d` before them.
    ///
    /// # Errors
    /// Pictures that differ in size, or that are empty.
    pub fn of<P: Pixel>(coarsest: Option<&[P]>, coarse: &[P], fine: &[P]) -> Result<Self, MeasureError> {
        let change = Comparison::new(coarse, fine)?.pixels;
        let before = coarsest.map(|coarsest| Comparison::new(coarsest, coarse)).transpose()?;
        let order = before.filter(|_| change.rmse > ROUND_OFF).map(|before| (before.pixels.rmse / change.rmse).log2());
        let power = Self::power(order);
        let share = ((power - 1.0) * (power * power + 1.0).sqrt()).sqrt().recip();
        Ok(Self { rmse: share * change.rmse, p99: share * change.p99, order })
    }

    /// The same of the coarser of the last two pictures, at step `d`.
    #[must_use]
    pub fn of_coarser(self) -> Self {
        let factor = Self::power(self.order);
        Self { rmse: factor * self.rmse, p99: factor * self.p99, ..self }
    }

    /// How many times the error shrinks when the step is halved.
    fn power(order: Option<f64>) -> f64 {
        order.unwrap_or(1.0).clamp(ORDERS[0], ORDERS[1]).exp2()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures of one value that is off by `c d^p`.
    fn picture(step: f64, order: f64) -> Vec<[f64; 4]> {
        vec![[0.5 + 0.01 * step.powf(order); 4]; 10]
    }

    #[test]
    fn the_power_is_found_and_the_error_nearly() {
        for order in [1.0, 1.5, 2.0] {
            let [a, b, c] = [1.0, 0.5, 0.25].map(|step| picture(step, order));
            let found = Estimate::of(Some(&a[..]), &b, &c).expect("pictures of one size");
            // Errors that only shrink, in all pixels alike: the estimate is at its lowest.
            let lowest = if order < 1.2 { 0.66 } else { 0.77 };
            let ratio = found.rmse / (0.01 * 0.25_f64.powf(order));
            assert!((found.order.expect("an order") - order).abs() < 1e-9);
            assert!((lowest..=1.0).contains(&ratio) && (found.p99 - found.rmse).abs() < 1e-12, "{found:?}");
            assert!((found.of_coarser().rmse - found.rmse * order.exp2()).abs() < 1e-12);
        }
    }

    #[test]
    fn without_a_third_picture_the_estimate_is_on_the_safe_side() {
        let [b, c] = [0.5, 0.25].map(|step| picture(step, 2.0));
        let found = Estimate::of(None, &b, &c).expect("pictures of one size");
        assert!(found.order.is_none() && found.rmse > 1.5 * 0.01 / 16.0);
        let still = Estimate::of(Some(&c[..]), &c, &c).expect("pictures of one size");
        assert_eq!((still.rmse, still.order), (0.0, None));
        assert!(Estimate::of(None, &b[1..], &c).is_err());
    }
}
