//! Emission and absorption along a stretch of medium, by collocation and halving.

use super::lobatto::{LOBATTO, NODES};

/// Error a leaf of the halving may be thought to have, seen from the eye. It is judged by halving once more, and the halves
/// are what is kept: their own error is smaller by four to five digits where the medium is smooth.
pub const TOLERANCE: f64 = 1e-13;

/// The same for lit material, whose light bends where a surface turns away. A ray has a few hundred leaves at most that come
/// close to this: their sum stays below 1e-9.
pub const LIT_TOLERANCE: f64 = 1e-11;

/// Transmittance below which nothing is worth another halving.
const NEGLIGIBLE: f64 = 1e-18;

/// Optical depth of a stretch above which its front alone would decide both of the estimates that are compared.
const THICK: f64 = 8.0;

/// Halvings at most: a pole of the logarithm contributes `2^-48` of a stretch then.
const MAX_HALVINGS: u32 = 48;

/// What a stretch of medium does to the ray.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Stretch {
    /// Optical depth.
    pub(super) depth: f64,
    /// Premultiplied colour, as seen from the front of the stretch.
    pub(super) color: [f64; 3],
}

impl Stretch {
    /// A stretch of one extinction times length, and one straight colour.
    pub(super) fn homogeneous(depth: f64, color: [f64; 3]) -> Self {
        let opacity = -(-depth).exp_m1();
        Self { depth, color: color.map(|c| c * opacity) }
    }

    pub(super) fn transmittance(&self) -> f64 {
        (-self.depth).exp()
    }

    pub(super) fn opacity(&self) -> f64 {
        -(-self.depth).exp_m1()
    }

    /// This stretch in front of another.
    pub(super) fn then(&self, behind: &Self) -> Self {
        let transmittance = self.transmittance();
        Self {
            depth: self.depth + behind.depth,
            color: std::array::from_fn(|i| self.color[i] + transmittance * behind.color[i]),
        }
    }
}

/// A medium over an interval: extinction and straight colour at a place.
pub(super) struct Quadrature<F> {
    /// Extinction per reference length and straight colour.
    pub(super) medium: F,
    /// Reference lengths per unit of the place.
    pub(super) scale: f64,
    /// [`TOLERANCE`] or [`LIT_TOLERANCE`].
    pub(super) tolerance: f64,
}

impl<F: Fn(f64) -> (f64, [f64; 3])> Quadrature<F> {
    /// The stretch between two places, of which a share of `transmittance` reaches the eye.
    pub(super) fn stretch(&self, from: f64, to: f64, transmittance: f64) -> Stretch {
        self.refined(from, to, self.estimate(from, to), transmittance, MAX_HALVINGS)
    }

    fn refined(&self, from: f64, to: f64, whole: Stretch, transmittance: f64, halvings: u32) -> Stretch {
        let middle = 0.5 * (from + to);
        let (front, back) = (self.estimate(from, middle), self.estimate(middle, to));
        let halves = front.then(&back);
        let resolved = halves.depth <= THICK && self.agree(&whole, &halves, transmittance);
        if resolved || transmittance <= NEGLIGIBLE || halvings == 0 {
            return halves;
        }
        let front = self.refined(from, middle, front, transmittance, halvings - 1);
        let back = self.refined(middle, to, back, transmittance * front.transmittance(), halvings - 1);
        front.then(&back)
    }

    fn agree(&self, a: &Stretch, b: &Stretch, transmittance: f64) -> bool {
        let depth = (a.depth - b.depth).abs() / b.depth.max(1.0);
        let color = a.color.iter().zip(b.color).map(|(a, b)| (a - b).abs());
        transmittance * color.fold(depth, f64::max) <= self.tolerance
    }

    /// One rule: the extinction as a polynomial through the nodes, integrated up to each of them. The colour is the mean under
    /// the weights `τ T` times the opacity, so that one straight colour stays the same however rough the estimate is.
    fn estimate(&self, from: f64, to: f64) -> Stretch {
        let rule = &*LOBATTO;
        let length = (to - from) * self.scale;
        let values: [_; NODES] = rule.nodes.map(|x| (self.medium)(from + (to - from) * x));
        let integral = |weights: &[f64; NODES]| length * (0..NODES).map(|i| weights[i] * values[i].0).sum::<f64>();
        let depth = integral(&rule.weights);
        let mut sum = 0.0;
        let mut color = [0.0; 3];
        for (i, (extinction, at)) in values.iter().enumerate() {
            let weight = rule.weights[i] * extinction * (-integral(&rule.partial[i]).clamp(0.0, depth)).exp();
            sum += weight;
            for (c, at) in color.iter_mut().zip(at) {
                *c += weight * at;
            }
        }
        let share = if sum > 0.0 { -(-depth).exp_m1() / sum } else { 0.0 };
        Stretch { depth, color: color.map(|c| c * share) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_forms::{LinearRamp, linear_opacity_depth};

    fn integrate(medium: impl Fn(f64) -> (f64, f64), length: f64) -> Stretch {
        let medium = |t| {
            let (extinction, grey) = medium(t);
            (extinction, [grey; 3])
        };
        Quadrature { medium, scale: 1.0, tolerance: TOLERANCE }.stretch(0.0, length, 1.0)
    }

    #[test]
    fn ramps_are_their_closed_form() {
        for (start, slope, density, length) in [
            (0.0, 1.0, 2.0, 1.0),
            (0.2, 0.6, 3.0, 1.3),
            (0.9, -0.6, 3.0, 1.3),
            (0.1, 1.0, 300.0, 2.0),
            (2.0, 0.3, 1e6, 1.0),
        ] {
            let form = LinearRamp { start, slope, density, color_offset: 0.1, color_scale: 0.5, length };
            let found = integrate(|t| (density * (start + slope * t), 0.1 + 0.5 * (start + slope * t)), length);
            assert!((found.opacity() - form.opacity()).abs() < 1e-14, "{found:?} {form:?}");
            // The closed form itself overflows for dense media: there, the first terms of its series in 1/density.
            let expected = if density < 1e3 { form.color() } else { 0.1 + 0.5 * (start + slope / (density * start)) };
            assert!((found.color[0] - expected).abs() < 1e-13, "{} {expected}", found.color[0]);
        }
    }

    #[test]
    fn poles_of_the_logarithm_are_integrated() {
        let found = integrate(|t| (-(1.0 - t).max(f64::MIN_POSITIVE).ln(), 1.0), 1.0);
        assert!((found.depth - linear_opacity_depth(1.0, 1.0)).abs() < 1e-12, "{}", found.depth);
        assert!((found.color[0] - found.opacity()).abs() < 1e-15);
        // A pole just beyond the end.
        let found = integrate(|t| (-(1.0 + 1e-9 - t).ln(), 1.0), 1.0);
        let exact = 1.0 + 1e-9 * (1e-9_f64.ln() - 1.0) - (1.0 + 1e-9) * (1.0 + 1e-9_f64).ln() + 1e-9;
        assert!((found.depth - exact).abs() < 1e-12, "{} {exact}", found.depth);
    }

    #[test]
    fn bends_and_jumps_are_found_wherever_they_are() {
        for place in [0.003, 0.2, 0.5, 0.777, 0.9971, 0.999_9] {
            let bent = integrate(|t| (1.0 + (t - place).max(0.0), 1.0), 1.0);
            assert!((bent.depth - 1.0 - 0.5 * (1.0 - place).powi(2)).abs() < 1e-12, "{place}");
            let jumped = integrate(|t| (1.0, if t < place { 0.2 } else { 0.9 }), 1.0);
            let exact = 0.2 * -(-place).exp_m1() + 0.9 * ((-place).exp() - (-1.0f64).exp());
            assert!((jumped.color[0] - exact).abs() < 1e-12, "{place}");
        }
    }
}
