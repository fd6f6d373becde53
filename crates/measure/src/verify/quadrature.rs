//! Steps along the ray, against the same scene without samples.

use rayloom_gpu::Gpu;
use rayloom_network::{Camera, Projection};
use serde_json::{Value as Json, json};

use super::lab::{Lab, Settings};
use super::{Axis, Case, Expectation, Extent};
use crate::{Errors, MeasureError};

const SIZE: [u32; 2] = [48, 48];
/// Samples a voxel.
const RATES: [f64; 6] = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

/// Below this the step is a ramp, as wide as an entry of the transfer function's table.
const STEP: f64 = 6e-4;

/// Opacity and colour grow smoothly with the value.
fn smooth() -> Json {
    json!({"knots": [{"at": 0, "color": [0.1, 0.3, 0.9], "opacity": 0.05}, {"at": 1, "color": [1, 0.8, 0.3], "opacity": 0.8}]})
}

/// Clear up to a value, then dense.
fn step() -> Json {
    json!({"knots": [{"at": 0.431, "color": [1, 0.8, 0.6], "opacity": 0, "right": {"color": [1, 0.8, 0.6], "opacity": 0.7}}]})
}

pub(super) fn cases(gpu: &Gpu, extent: Extent) -> Result<Vec<Case>, MeasureError> {
    let rates = extent.of(&RATES, 4);
    let projection = Projection::Perspective { fov_degrees: 30.0 };
    let camera = Camera { position: [4.0, 3.1, 2.3], focus: [0.0; 3], projection, ..Camera::default() };
    let field = [
        ("source.field", json!("gaussian_blob")),
        ("source.sigma", json!(0.5)),
        ("source.dims", json!([9, 9, 9])),
        ("source.extent", json!([2, 2, 2])),
        ("traversal.reference_length", json!(0.5)),
    ];
    let mut lab = Lab::new(gpu, SIZE, camera, &field)?;
    let classification = |id: &str| ("traversal.classification", json!(id));
    let compositing = |id: &str| ("traversal.compositing", json!(id));
    let material = |json| ("traversal.transfer_function", json);
    let methods: [(&str, Expectation, Settings<'_>); 5] = [
        ("midpoint, smooth material", Expectation { order: 2.0, within: 0.1, floor: 3e-6 }, &[material(smooth())]),
        ("midpoint, step in the material", Expectation { order: 1.0, within: 0.2, floor: STEP }, &[material(step())]),
        (
            "pre-integrated, full",
            Expectation { order: 2.0, within: 0.1, floor: 1e-5 },
            &[material(smooth()), classification("preintegrated_full")],
        ),
        (
            "pre-integrated, fast",
            Expectation { order: 2.0, within: 0.1, floor: 1e-5 },
            &[material(smooth()), classification("preintegrated_fast")],
        ),
        (
            "mean value",
            Expectation { order: 2.0, within: 0.1, floor: 3e-6 },
            &[material(smooth()), compositing("mean")],
        ),
    ];
    let mut cases = Vec::new();
    for (name, expectation, settings) in methods {
        let exact = lab.exact(settings)?;
        let mut errors = Vec::new();
        for rate in &rates {
            let at_rate = [settings, &[("traversal.sampling_rate", json!(rate))]].concat();
            let (found, _) = Errors::of(&lab.picture(&at_rate)?, &exact)?;
            errors.push((*rate, found.rmse));
        }
        cases.push(Case::new(Axis::Quadrature, name, expectation, errors));
    }
    Ok(cases)
}
