//! Voxels: gradients in between.

use glam::DVec3;
use rayloom_gpu::Gpu;
use serde_json::json;

use super::grid::{BLOB, GRIDS, dims, lab};
use super::lab::{Lab, rms};
use super::{Axis, Case, Expectation, Extent};
use crate::MeasureError;
use crate::verify::probe;

const SIZE: [u32; 2] = [32, 32];
/// Values are rounded by 6e-8 each, and a difference is divided by the edge of a voxel, 0.02 on the finest grid.
const FLOOR: f64 = 1e-5;

pub(super) fn cases(gpu: &Gpu, extent: Extent) -> Result<Vec<Case>, MeasureError> {
    // The widest operators span five voxels, too many for the coarsest grid.
    let grids = extent.of(&GRIDS[1..], 4);
    let mut lab = lab(gpu, SIZE)?;
    let mut cases = Vec::new();
    for (name, operator, sampling, order) in [
        ("forward differences", "forward", "trilinear", 1.0),
        ("backward differences", "backward", "trilinear", 1.0),
        ("central differences", "central", "trilinear", 2.0),
        ("Sobel", "sobel", "trilinear", 2.0),
        ("filtered", "filtered", "trilinear", 2.0),
        ("fourth order, trilinear values", "central4", "trilinear", 2.0),
        ("fourth order, cubic B-spline", "central4", "bspline", 4.0),
    ] {
        let expectation = Expectation { order, within: 0.1, floor: FLOOR };
        let errors =
            grids.iter().map(|&voxels| Ok((f64::from(voxels), gradient_error(&mut lab, voxels, operator, sampling)?)));
        let errors = errors.collect::<Result<_, MeasureError>>()?;
        cases.push(Case::new(Axis::Gradients, name, expectation, errors));
    }
    Ok(cases)
}

/// Error of gradients in the middles of rays, values a world unit.
fn gradient_error(lab: &mut Lab, voxels: u32, operator: &str, sampling: &str) -> Result<f64, MeasureError> {
    lab.keep(&[dims(voxels)])?;
    let (volume, chords) = lab.rays()?;
    let scale = volume.ranges()[0].width() / volume.spacing().x;
    let found = lab.picture(&[
        ("traversal.sampling", json!(sampling)),
        ("traversal.gradient", json!(operator)),
        ("traversal.compositing.text", json!(probe::GRADIENT)),
        ("traversal.max_samples", json!(1)),
    ])?;
    let pairs = chords.iter().zip(&found).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
    Ok(rms(pairs.map(|(chord, &[x, y, z, _])| {
        let exact = BLOB.gradient(chord.middle()).unwrap_or_default();
        (DVec3::from([x, y, z].map(f64::from)) * scale - exact).length()
    })))
}
