//! Rays past a radially symmetric blob or ball, by their impact parameter (the smallest distance from the centre).

use super::absorption::homogeneous_opacity;
use std::f64::consts::TAU;

/// T10: opacity of a whole line through the extinction `peak exp(-r²/2σ²)`: `1 - exp(-k σ √(2π) exp(-b²/2σ²))`.
pub fn gaussian_blob_opacity(peak: f64, sigma: f64, impact: f64) -> f64 {
    homogeneous_opacity(gaussian_blob_maximum(peak, sigma, impact), sigma * TAU.sqrt())
}

/// T18: the largest value `peak exp(-b²/2σ²)` of a Gaussian blob on a line with impact parameter `impact`.
pub fn gaussian_blob_maximum(peak: f64, sigma: f64, impact: f64) -> f64 {
    peak * (-0.5 * (impact / sigma).powi(2)).exp()
}

/// T11: opacity of a homogeneous ball of extinction `tau`: `1 - exp(-2τ √(R² - b²))`, zero outside the silhouette.
pub fn ball_opacity(tau: f64, radius: f64, impact: f64) -> f64 {
    let half_chord_squared = (radius - impact) * (radius + impact);
    homogeneous_opacity(tau, 2.0 * half_chord_squared.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((gaussian_blob_opacity(2.0, 0.1, 0.0) - 0.394_272_857_9).abs() < 1e-10);
        assert!((gaussian_blob_opacity(2.0, 0.1, 0.1) - 0.262_190_324_7).abs() < 1e-10);
        assert!((ball_opacity(2.0, 0.4, 0.0) - 0.798_103_482_0).abs() < 1e-10);
        assert!((ball_opacity(2.0, 0.4, 0.3) - 0.652_954_895_9).abs() < 1e-10);
        assert_eq!(ball_opacity(2.0, 0.4, 0.5), 0.0);
        assert_eq!(gaussian_blob_maximum(2.0, 0.1, 0.0), 2.0);
    }
}
