//! Probability densities of the electron in a hydrogen atom, `|psi|^2`, in units of the Bohr radius `a`.

use std::f64::consts::PI;

use glam::DVec3;

/// 1s: `exp(-2 r / a) / (pi a^3)`.
pub(super) fn s1(p: DVec3, a: f64) -> f64 {
    (-2.0 * p.length() / a).exp() / (PI * a.powi(3))
}

/// The gradient of [`s1`]; zero at the cusp in the centre.
pub(super) fn s1_gradient(p: DVec3, a: f64) -> DVec3 {
    p.normalize_or_zero() * (-2.0 / a * s1(p, a))
}

/// 2p_z: `z^2 exp(-r / a) / (32 pi a^5)`.
pub(super) fn p2(p: DVec3, a: f64) -> f64 {
    p.z * p.z * (-p.length() / a).exp() / (32.0 * PI * a.powi(5))
}

/// The gradient of [`p2`].
pub(super) fn p2_gradient(p: DVec3, a: f64) -> DVec3 {
    let envelope = (-p.length() / a).exp() / (32.0 * PI * a.powi(5));
    DVec3::Z * (2.0 * p.z * envelope) - p.normalize_or_zero() * (p.z * p.z * envelope / a)
}

/// 3d_z2: `(3 z^2 - r^2)^2 exp(-2 r / 3 a) / (39366 pi a^7)`.
pub(super) fn d3(p: DVec3, a: f64) -> f64 {
    let angular = 3.0 * p.z * p.z - p.length_squared();
    angular * angular * (-2.0 * p.length() / (3.0 * a)).exp() / (39366.0 * PI * a.powi(7))
}

/// The gradient of [`d3`].
pub(super) fn d3_gradient(p: DVec3, a: f64) -> DVec3 {
    let angular = 3.0 * p.z * p.z - p.length_squared();
    let envelope = (-2.0 * p.length() / (3.0 * a)).exp() / (39366.0 * PI * a.powi(7));
    let angular_gradient = DVec3::Z * (6.0 * p.z) - 2.0 * p;
    angular_gradient * (2.0 * angular * envelope)
        - p.normalize_or_zero() * (2.0 / (3.0 * a) * angular * angular * envelope)
}
