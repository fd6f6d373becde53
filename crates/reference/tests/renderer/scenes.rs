//! Volumes, transfer functions and cameras that the tests share.

use glam::{DAffine3, DMat3, DVec3, UVec3};
use rayloom_reference::Camera;
use rayloom_volume::{Knot, TransferFunction, Volume, Voxels};

/// A volume of the field `f` over world space, sampled at the voxel centres.
pub fn volume(dims: [u32; 3], index_to_world: DAffine3, f: impl Fn(DVec3) -> f64) -> Volume {
    let [nx, ny, nz] = dims;
    let index = |n: u32| UVec3::new(n % nx, n / nx % ny, n / nx / ny).as_dvec3();
    let values = (0..nx * ny * nz).map(|n| f(index_to_world.transform_point3(index(n)))).collect();
    Volume::new("test", dims, 1, Voxels::F64(values), index_to_world).expect("the test volume makes sense")
}

/// The transformation that fills the world box `low..high` with the voxels of a grid.
pub fn filling(dims: [u32; 3], low: DVec3, high: DVec3) -> DAffine3 {
    let spacing = (high - low) / UVec3::from_array(dims).as_dvec3();
    DAffine3::from_mat3_translation(DMat3::from_diagonal(spacing), low + 0.5 * spacing)
}

/// Reproducible noise in 0..1 without structure, by hashing the position.
pub fn noise(p: DVec3) -> f64 {
    let mut h = 0x9e37_79b9_7f4a_7c15_u64;
    for x in p.to_array() {
        // Rounded, so that the same point reached by another transformation has the same value.
        h = (h ^ ((x * 1024.0).round() as i64 as u64)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        h ^= h >> 32;
    }
    (h >> 11) as f64 / (1u64 << 53) as f64
}

/// A transfer function that follows `material` (grey value, extinction) over `low..high` closely, by many knots.
pub fn following(low: f64, high: f64, material: impl Fn(f64) -> (f64, f64)) -> TransferFunction {
    let count = 20_000;
    let knot = |i: i32| {
        let at = low + (high - low) * f64::from(i) / f64::from(count);
        let (grey, tau) = material(at);
        Knot::new(at, [grey; 3], -(-tau).exp_m1())
    };
    TransferFunction { knots: (0..=count).map(knot).collect() }
}

/// One colour and extinction for all values.
pub fn uniform(color: [f64; 3], tau: f64) -> TransferFunction {
    TransferFunction { knots: vec![Knot::new(0.0, color, -(-tau).exp_m1())] }
}

/// Transparent below `threshold`, white of extinction `tau` from there on.
pub fn step(threshold: f64, tau: f64) -> TransferFunction {
    TransferFunction { knots: vec![Knot::split(threshold, ([1.0; 3], 0.0), ([1.0; 3], -(-tau).exp_m1()))] }
}

/// Opaque, with grey running from 0 at `low` to 1 at `high`: a picture that can be read as values.
pub fn readable(low: f64, high: f64) -> TransferFunction {
    TransferFunction { knots: vec![Knot::new(low, [0.0; 3], 1.0), Knot::new(high, [1.0; 3], 1.0)] }
}

/// Coloured and translucent everywhere in 0..1 but below 0.1.
pub fn colorful() -> TransferFunction {
    let knots = vec![
        Knot::new(0.1, [0.9, 0.2, 0.1], 0.0),
        Knot::new(0.5, [0.2, 0.8, 0.3], 0.3),
        Knot::new(1.0, [0.1, 0.3, 1.0], 0.6),
    ];
    TransferFunction { knots }
}

/// An orthographic camera that looks along +x with its single ray through `(y, z)`.
pub fn along_x(y: f64, z: f64) -> Camera {
    Camera::orthographic(DVec3::new(-10.0, y, z), DVec3::new(0.0, y, z), 1.0)
}

/// Orders of convergence between successive errors, each at half the step of the one before.
pub fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

/// Asserts that successive halvings of the step divide the errors by two to the power of `order`, give or take `slack`.
pub fn assert_order(errors: &[f64], order: f64, slack: f64) {
    let found = orders(errors);
    assert!(
        found.iter().all(|p| (p - order).abs() <= slack),
        "orders {found:?} of errors {errors:?}, expected {order}"
    );
}
