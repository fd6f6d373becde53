//! slot: gradient
//! label: Sobel 3x3x3
//! help: Central differences smoothed across the other two axes with weights 1-2-1: second order, calm on noise, 27 samples.

// Written without loops: some drivers bound the loop rounds of an invocation, and a ray needs them for its samples.

/// Three values along x: their smoothed value (x) and their difference (y).
fn row(low: f32, x: vec3f, high: f32) -> vec2f {
    let a = value_at(vec3f(low, x.yz) / source.dims);
    let b = value_at(x / source.dims);
    let c = value_at(vec3f(high, x.yz) / source.dims);
    return vec2f(0.25 * a + 0.5 * b + 0.25 * c, c - a);
}

/// Nine values in a plane: smoothed along x and y (z), smoothed along x and differenced along y (y), and the reverse (x).
fn plane(low: vec3f, x: vec3f, high: vec3f) -> vec3f {
    let a = row(low.x, vec3f(x.x, low.y, x.z), high.x);
    let b = row(low.x, x, high.x);
    let c = row(low.x, vec3f(x.x, high.y, x.z), high.x);
    return vec3f(0.25 * a.y + 0.5 * b.y + 0.25 * c.y, c.x - a.x, 0.25 * a.x + 0.5 * b.x + 0.25 * c.x);
}

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    let x = clamp(p * source.dims, vec3f(0.5), source.dims - 0.5);
    let low = max(x - 1.0, vec3f(0.5));
    let high = min(x + 1.0, source.dims - 0.5);
    let a = plane(low, vec3f(x.xy, low.z), high);
    let b = plane(low, x, high);
    let c = plane(low, vec3f(x.xy, high.z), high);
    let sum = vec3f(0.25 * a.xy + 0.5 * b.xy + 0.25 * c.xy, c.z - a.z);
    let span = high - low;
    return select(vec3f(0.0), sum / max(span, vec3f(1e-6)), span > vec3f(1e-4));
}
