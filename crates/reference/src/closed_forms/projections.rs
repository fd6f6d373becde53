//! Extreme, mean and sum projections.

use crate::special::{bessel_k1, bessel_k2};
use glam::DVec3;
use std::f64::consts::PI;

/// What the projections of a field along one ray come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projections {
    /// Largest value on the ray.
    pub maximum: f64,
    /// Smallest value on the ray.
    pub minimum: f64,
    /// Mean value along the ray.
    pub mean: f64,
}

/// T18: projections of a field that runs linearly from `start` to `end` along the ray.
pub fn linear_projection(start: f64, end: f64) -> Projections {
    Projections { maximum: start.max(end), minimum: start.min(end), mean: 0.5 * (start + end) }
}

/// Hydrogen 1s density `exp(-2r/a) / (π a³)` at `position` from the nucleus, with Bohr radius `a`.
pub fn hydrogen_1s(position: DVec3, a: f64) -> f64 {
    (-2.0 * position.length() / a).exp() / (PI * a.powi(3))
}

/// T17: integral of [`hydrogen_1s`] along a whole line at distance `impact`: `2b K₁(2b/a) / (π a³)`, `1/(π a²)` at zero.
pub fn hydrogen_1s_projection(a: f64, impact: f64) -> f64 {
    let x = 2.0 * impact.abs() / a;
    // x K₁(x) → 1 quadratically; below the bound K₁ itself could overflow.
    let factor = if x < 1e-9 { 1.0 } else { x * bessel_k1(x) };
    factor / (PI * a * a)
}

/// Hydrogen 2p_z density `z² exp(-r/a) / (32 π a⁵)` at `position` from the nucleus, with Bohr radius `a`.
pub fn hydrogen_2pz(position: DVec3, a: f64) -> f64 {
    position.z * position.z * (-position.length() / a).exp() / (32.0 * PI * a.powi(5))
}

/// T17: integral of [`hydrogen_2pz`] along a whole line parallel to z at distance `impact`:
/// `2 a b² K₂(b/a) / (32 π a⁵)`, `1/(8 π a²)` at zero.
pub fn hydrogen_2pz_projection(a: f64, impact: f64) -> f64 {
    let x = impact.abs() / a;
    let factor = if x < 1e-9 { 2.0 } else { x * x * bessel_k2(x) };
    2.0 * factor / (32.0 * PI * a * a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Midpoint sum along z: the integrands are smooth and vanish at both ends, so it converges exponentially.
    fn line_integral(density: impl Fn(DVec3) -> f64, impact: f64) -> f64 {
        let d = 0.005;
        (-16_000..16_000).map(|i| density(DVec3::new(impact, 0.0, (f64::from(i) + 0.5) * d)) * d).sum()
    }

    #[test]
    fn hydrogen_projections_match_quadrature() {
        for (a, b) in [(1.0, 0.5), (0.7, 1.3), (1.5, 2.0)] {
            let found = hydrogen_1s_projection(a, b);
            let expected = line_integral(|p| hydrogen_1s(p, a), b);
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            let found = hydrogen_2pz_projection(a, b);
            let expected = line_integral(|p| hydrogen_2pz(p, a), b);
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    #[test]
    fn hydrogen_projections_through_the_nucleus() {
        assert_eq!(hydrogen_1s_projection(2.0, 0.0), 1.0 / (4.0 * PI));
        assert!((hydrogen_2pz_projection(2.0, 0.0) - 1.0 / (32.0 * PI)).abs() < 1e-17);
        assert!((hydrogen_1s_projection(1.0, 1e-6) * PI - 1.0).abs() < 1e-10);
    }

    #[test]
    fn linear_field() {
        let projections = linear_projection(3.0, -1.0);
        assert_eq!((projections.maximum, projections.minimum, projections.mean), (3.0, -1.0, 1.0));
    }
}
