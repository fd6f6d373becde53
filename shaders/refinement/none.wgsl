//! slot: refinement
//! label: None
//! help: The sample behind the crossing: an error of up to one step.

fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32 {
    return b;
}
