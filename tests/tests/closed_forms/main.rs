//! Pictures of the ray loop against scenes whose exact value is a formula.
//!
//! Numbers such as T5 are those of the table in `rayloom_reference::closed_forms`. Where a discretisation remains, its
//! observed order of convergence is held, too. Grids are clipped to the box of their voxel centres where a formula needs a
//! field that is linear up to the end: in the outer half voxel fields are constant.

mod atoms;
mod blobs;
mod checkerboard;
mod points;
mod profiles;
mod projections;
mod ramps;
mod slabs;
mod surfaces;

use glam::{DAffine3, DVec3};
use rayloom_reference::Camera;
use rayloom_reference::ray::AxisBox;
use rayloom_tests::{Grid, VolumeFile, Workbench};
use serde_json::json;

/// Observed orders of convergence `log2(e[i] / e[i + 1])` of errors at halved steps.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Small numbers for people.
fn scientific(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.2e}")).collect::<Vec<_>>().join(" ")
}

/// Root of the mean square; panics for no errors, which would mean that nothing was compared.
fn rms(errors: &[f64]) -> f64 {
    assert!(errors.len() > 20, "only {} pixels were compared", errors.len());
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Largest error; panics for few errors, which would mean that hardly anything was compared.
fn largest(errors: &[f64]) -> f64 {
    assert!(errors.len() > 20, "only {} pixels were compared", errors.len());
    errors.iter().copied().fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}

/// A chain on a linear field `value(x)` of the world, with `intervals + 1` voxel centres from 0 to `length` along x, which
/// the proxy is clipped to. The bench, the clip box in texture coordinates and the file that must outlive the bench.
fn linear_slab(intervals: u32, length: f64, value: impl Fn(f64) -> f64) -> (Workbench, AxisBox, VolumeFile) {
    let spacing = length / f64::from(intervals);
    let to_world = DAffine3::from_translation(DVec3::new(0.0, -1.5 * spacing, -1.5 * spacing))
        * DAffine3::from_scale(DVec3::splat(spacing));
    let dims = [intervals + 1, 4, 4];
    let file = Grid::of_world(dims, to_world, |p| value(p.x)).save();
    let mut bench = Workbench::of_file(file.path());
    let [first, last] = [0.5, f64::from(intervals) + 0.5];
    bench.put("proxy.clip_x", json!([first, last]));
    let voxels = f64::from(dims[0]);
    let clip = AxisBox { min: DVec3::new(first / voxels, 0.0, 0.0), max: DVec3::new(last / voxels, 1.0, 1.0) };
    (bench, clip, file)
}

/// Looks at a slab of this length from one end, the other and askew.
fn slab_cameras(length: f64) -> [Camera; 3] {
    let center = DVec3::new(0.5 * length, 0.0, 0.0);
    let height = 0.2 * length;
    [
        Camera::orthographic(DVec3::new(-length, 0.0, 0.0), center, height),
        Camera::orthographic(DVec3::new(2.0 * length, 0.0, 0.0), center, height),
        Camera::perspective(DVec3::new(-0.9 * length, 0.13 * length, 0.17 * length), center, 14.0),
    ]
}
