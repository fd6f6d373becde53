//! Emission and absorption along one ray through fields that vary along the ray only.

use crate::special::{erf, erfi};
use std::f64::consts::PI;

/// T1: opacity `1 - exp(-τL)` of a homogeneous slab of extinction `tau` and length `length`.
pub fn homogeneous_opacity(tau: f64, length: f64) -> f64 {
    -(-tau * length).exp_m1()
}

/// T2: how far a premultiplied pixel of white material lies from white once composited over a white background.
///
/// Zero for any volume, classification, step and clipping, as long as no ray is terminated early.
pub fn furnace_residual(pixel: [f64; 4]) -> f64 {
    constant_color_residual(pixel, [1.0; 3])
}

/// T3: the largest `|C - c A|` over the channels of a premultiplied pixel; zero for material of one straight colour `color`.
pub fn constant_color_residual(pixel: [f64; 4], color: [f64; 3]) -> f64 {
    (0..3).map(|i| (pixel[i] - color[i] * pixel[3]).abs()).fold(0.0, f64::max)
}

/// T6: the field `s = start + slope t` on `0..length`, with extinction `τ = density s` and straight colour
/// `c = color_offset + color_scale s`; `s` must not become negative on the way.
///
/// T4 is `{0, 1, 2, 1, 0, 1}` and T5 `{0, 1, 2, 0, 1, 1}` in the order of the fields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearRamp {
    /// Field at `t = 0`, not negative.
    pub start: f64,
    /// Change of the field per unit length; of either sign, or zero.
    pub slope: f64,
    /// Extinction per unit of the field, positive.
    pub density: f64,
    /// Straight colour where the field is zero.
    pub color_offset: f64,
    /// Change of the straight colour per unit of the field.
    pub color_scale: f64,
    /// Length of the ray.
    pub length: f64,
}

impl LinearRamp {
    /// Transmittance `exp(-k (aL + bL²/2))`.
    pub fn transmittance(&self) -> f64 {
        (-self.density * self.length * (self.start + 0.5 * self.slope * self.length)).exp()
    }

    /// Opacity, one less the transmittance.
    pub fn opacity(&self) -> f64 {
        -(-self.density * self.length * (self.start + 0.5 * self.slope * self.length)).exp_m1()
    }

    /// Premultiplied colour `c0 (1-T) + c1 (s0 - s1 T + b J)` with `J = ∫ T dt`, by integration by parts.
    pub fn color(&self) -> f64 {
        let end = self.start + self.slope * self.length;
        let t = self.transmittance();
        let weighted = self.start - end * t + self.slope * self.transmittance_integral();
        self.color_offset * self.opacity() + self.color_scale * weighted
    }

    /// `J = ∫₀ᴸ T(t) dt`: completing the square gives `erf` for a rising and `erfi` for a falling field.
    fn transmittance_integral(&self) -> f64 {
        let (a, b, k) = (self.start, self.slope, self.density);
        if b == 0.0 {
            return if a == 0.0 { self.length } else { self.opacity() / (k * a) };
        }
        let q = (0.5 * k / b.abs()).sqrt();
        let (from, to) = (a * q, (a + b * self.length) * q);
        let scale = 0.5 * PI.sqrt() / (q * b.abs());
        if b > 0.0 {
            scale * (from * from).exp() * (erf(to) - erf(from))
        } else {
            scale * (-from * from).exp() * (erfi(from) - erfi(to))
        }
    }
}

/// T7: opacity of an atmosphere of extinction `surface_tau exp(-t/scale_height)` along `0..length`.
pub fn atmosphere_opacity(surface_tau: f64, scale_height: f64, length: f64) -> f64 {
    let depth = -surface_tau * scale_height * (-length / scale_height).exp_m1();
    -(-depth).exp_m1()
}

/// T8: opacity of the ramp `s = t` on `0..length` under the step `τ = tau` for `s > threshold`, else 0.
pub fn step_opacity(tau: f64, threshold: f64, length: f64) -> f64 {
    homogeneous_opacity(tau, (length - threshold.max(0.0)).max(0.0))
}

/// T9: opacity of a ramp of slope `slope` under a box spike `tau` over `width` units of the value, wholly crossed.
pub fn spike_opacity(tau: f64, width: f64, slope: f64) -> f64 {
    homogeneous_opacity(tau, width / slope.abs())
}

/// Optical depth of the ramp `s = t` on `0..length` when the *opacity* per unit length is drawn as the line `slope s`:
/// `∫ -ln(1 - slope t) dt = L + (1 - aL) ln(1 - aL) / a`, for `slope length <= 1`.
///
/// This is what a transfer function of two knots means exactly.
pub fn linear_opacity_depth(slope: f64, length: f64) -> f64 {
    let x = slope * length;
    if x == 0.0 {
        return 0.0;
    }
    if x == 1.0 {
        return length;
    }
    length + (1.0 - x) * (-x).ln_1p() / slope
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(start: f64, slope: f64, density: f64, color_offset: f64, color_scale: f64, length: f64) -> LinearRamp {
        LinearRamp { start, slope, density, color_offset, color_scale, length }
    }

    #[test]
    fn homogeneous_slab() {
        assert!((homogeneous_opacity(1.0, 1.0) - 0.632_120_558_8).abs() < 1e-10);
        assert_eq!(homogeneous_opacity(0.5, 2.0), homogeneous_opacity(1.0, 1.0));
        assert!((1.0 - homogeneous_opacity(10.0, 1.0) - 4.539_99e-5).abs() < 1e-10);
    }

    #[test]
    fn identities() {
        assert_eq!(furnace_residual([0.25, 0.25, 0.25, 0.25]), 0.0);
        assert_eq!(constant_color_residual([0.5, 0.25, 0.0, 0.5], [1.0, 0.5, 0.0]), 0.0);
        assert_eq!(constant_color_residual([0.5, 0.25, 0.125, 0.5], [1.0, 0.5, 0.0]), 0.125);
    }

    #[test]
    fn linear_ramps() {
        let t4 = ramp(0.0, 1.0, 2.0, 1.0, 0.0, 1.0);
        assert!((t4.opacity() - 0.632_120_558_8).abs() < 1e-10 && (t4.color() - t4.opacity()).abs() < 1e-15);
        assert!((ramp(0.0, 1.0, 2.0, 0.0, 1.0, 1.0).color() - 0.378_944_691_640_984_7).abs() < 1e-15);
        let t6 = ramp(0.2, 0.6, 3.0, 0.1, 0.5, 1.3);
        assert!((t6.color() - 0.334_884_517_396_557_2).abs() < 1e-14);
        assert!((t6.opacity() - 0.899_841_365_0).abs() < 1e-10);
        // Falling and constant fields, against numerical quadrature.
        assert!((ramp(0.9, -0.6, 3.0, 0.1, 0.5, 1.3).color() - 0.393_798_331_817_109_04).abs() < 1e-14);
        assert!((ramp(0.9, 0.0, 3.0, 0.1, 0.5, 1.3).color() - 0.533_556_697_059_690_5).abs() < 1e-14);
        assert_eq!(ramp(0.0, 0.0, 3.0, 0.1, 0.5, 1.3).color(), 0.0);
    }

    #[test]
    fn steps_and_atmosphere() {
        assert_eq!(step_opacity(3.0, 0.25, 1.0), homogeneous_opacity(3.0, 0.75));
        assert_eq!(step_opacity(3.0, 2.0, 1.0), 0.0);
        assert_eq!(spike_opacity(40.0, 0.02, 2.0), homogeneous_opacity(40.0, 0.01));
        assert!((atmosphere_opacity(2.0, 1e9, 0.5) - homogeneous_opacity(2.0, 0.5)).abs() < 1e-9);
        assert!((atmosphere_opacity(2.0, 0.5, 1.0) - homogeneous_opacity(1.0, 1.0 - (-2.0_f64).exp())).abs() < 1e-15);
    }

    #[test]
    fn linear_opacity() {
        // Midpoint quadrature with Richardson extrapolation as the second opinion.
        let quadrature = |n: i32| -> f64 {
            let d = 1.0 / f64::from(n);
            (0..n).map(|i| -(-0.8 * (f64::from(i) + 0.5) * d).ln_1p() * d).sum()
        };
        let expected = (4.0 * quadrature(2000) - quadrature(1000)) / 3.0;
        assert!((linear_opacity_depth(0.8, 1.0) - expected).abs() < 1e-11);
        assert_eq!(linear_opacity_depth(0.5, 2.0), 2.0);
        assert_eq!(linear_opacity_depth(0.0, 2.0), 0.0);
    }
}
