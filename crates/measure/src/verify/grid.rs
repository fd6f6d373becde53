//! Voxels: values between them, and whole pictures of a manufactured scene.

use glam::DVec3;
use rayloom_gpu::Gpu;
use rayloom_network::{Camera, Projection};
use rayloom_volume::Field;
use serde_json::{Value as Json, json};

use super::lab::{Lab, rms};
use super::{Axis, Case, Expectation, Extent};
use crate::MeasureError;
use crate::verify::probe;
use crate::verify::rays::{Chord, tabulated};

const SIZE: [u32; 2] = [40, 40];
/// Voxels along an edge of the box from -1 to 1.
pub(super) const GRIDS: [u32; 6] = [17, 24, 33, 48, 67, 96];
/// A blob that has all but vanished at the border.
pub(super) const BLOB: Field = Field::GaussianBlob { sigma: SIGMA };
const SIGMA: f64 = 0.3;
/// Where it is seen from, and how far from there rays begin: within the box, so that their middles lie in a slanted plane, which
/// meets voxels everywhere.
const POSITION: [f64; 3] = [2.0, 1.37, 1.11];
const NEAR: f64 = 2.2;

/// The blob on a grid, seen so that the middles of rays lie around its slopes.
pub(super) fn lab(gpu: &Gpu, size: [u32; 2]) -> Result<Lab, MeasureError> {
    let projection = Projection::Orthographic { height: 0.7 };
    let camera = Camera { position: POSITION, focus: [0.0; 3], projection, near: Some(NEAR), ..Camera::default() };
    let field =
        [("source.field", json!("gaussian_blob")), ("source.sigma", json!(SIGMA)), ("source.extent", json!([2, 2, 2]))];
    Lab::new(gpu, size, camera, &field)
}

/// The blob's grid with this many voxels along an edge.
pub(super) fn dims(voxels: u32) -> (&'static str, Json) {
    ("source.dims", json!([voxels, voxels, voxels]))
}

pub(super) fn cases(gpu: &Gpu, extent: Extent) -> Result<Vec<Case>, MeasureError> {
    let grids = extent.of(&GRIDS, 4);
    let mut lab = lab(gpu, SIZE)?;
    let mut cases = Vec::new();
    for (name, sampling, expectation) in [
        ("value, nearest voxel", "nearest", Expectation { order: 1.0, within: 0.2, floor: 1e-6 }),
        ("value, trilinear", "trilinear", Expectation { order: 2.0, within: 0.1, floor: 1e-6 }),
        ("value, Catmull-Rom", "catmull_rom", Expectation { order: 3.0, within: 0.2, floor: 1e-6 }),
        ("value, cubic B-spline", "bspline", Expectation { order: 4.0, within: 0.2, floor: 4e-7 }),
    ] {
        let errors = grids.iter().map(|&voxels| Ok((f64::from(voxels), value_error(&mut lab, voxels, sampling)?)));
        let errors = errors.collect::<Result<_, MeasureError>>()?;
        cases.push(Case::new(Axis::Grid, name, expectation, errors));
    }
    let errors = grids.iter().map(|&voxels| Ok((f64::from(voxels), picture_error(&mut lab, voxels)?)));
    let errors = errors.collect::<Result<_, MeasureError>>()?;
    cases.push(Case::new(
        Axis::Grid,
        "picture, step and voxel together",
        Expectation { order: 2.0, within: 0.1, floor: 5e-6 },
        errors,
    ));
    Ok(cases)
}

/// Error of values in the middles of rays.
fn value_error(lab: &mut Lab, voxels: u32, sampling: &str) -> Result<f64, MeasureError> {
    lab.keep(&[dims(voxels), ("traversal.sampling", json!("trilinear"))])?;
    let (volume, chords) = lab.rays()?;
    let range = volume.ranges()[0];
    let found = lab.picture(&[
        ("traversal.sampling", json!(sampling)),
        ("traversal.compositing.text", json!(probe::VALUE)),
        ("traversal.max_samples", json!(1)),
    ])?;
    let pairs = chords.iter().zip(&found).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
    Ok(rms(pairs.map(|(chord, pixel)| range.denormalise(f64::from(pixel[0])) - BLOB.value(chord.middle()))))
}

/// Error of a manufactured picture at one sample a voxel: extinction and colour are the field's own value.
fn picture_error(lab: &mut Lab, voxels: u32) -> Result<f64, MeasureError> {
    lab.keep(&[dims(voxels)])?;
    let (volume, chords) = lab.rays()?;
    let function = tabulated(volume.ranges()[0], |value| DENSITY * value.max(0.0), |value| [value.clamp(0.0, 1.0); 3])
        .map_err(|error| MeasureError::Subject(error.to_string()))?;
    let found = lab.picture(&[("traversal.transfer_function", serde_json::to_value(&function)?)])?;
    let pairs = chords.iter().zip(&found).filter_map(|(chord, pixel)| Some((manufactured(chord.as_ref()?), pixel)));
    Ok(rms(pairs.flat_map(|(exact, pixel)| [f64::from(pixel[0]) - exact[0], f64::from(pixel[3]) - exact[1]])))
}

/// Extinction a unit of the field's value.
const DENSITY: f64 = 3.0;

/// Colour and opacity of the ray through the field itself: the midpoint rule, so fine that its error is below 1e-6.
fn manufactured(chord: &Chord) -> [f64; 2] {
    const STEPS: u32 = 1000;
    let d = chord.length / f64::from(STEPS);
    let value = |i: u32| BLOB.value(DVec3::lerp(chord.at(0.0), chord.at(1.0), (f64::from(i) + 0.5) / f64::from(STEPS)));
    let (mut color, mut transmittance) = (0.0, 1.0);
    for value in (0..STEPS).map(value) {
        let passed = (-DENSITY * value * d).exp();
        color += transmittance * (1.0 - passed) * value;
        transmittance *= passed;
    }
    [color, 1.0 - transmittance]
}
