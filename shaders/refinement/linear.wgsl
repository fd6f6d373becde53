//! slot: refinement
//! label: Linear
//! help: Where the straight line between the two samples crosses: no extra sample, second order.

fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32 {
    return mix(a, b, clamp(fa / (fa - fb), 0.0, 1.0));
}
