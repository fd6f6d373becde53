//! slot: slope
//! help: Nothing reads the gradient of a sample.

fn sample_gradient(s: Sample) -> vec3f {
    return vec3f(0.0);
}
