//! slot: gradient
//! label: Sobel 3x3x3
//! help: Central differences smoothed across the other two axes with weights 1-2-1: second order, calm on noise, 27 samples.

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    let x = clamp(p * frame.dims, vec3f(0.5), frame.dims - 0.5);
    let low = max(x - 1.0, vec3f(0.5));
    let high = min(x + 1.0, frame.dims - 0.5);
    var places = array<vec3f, 3>(low, x, high);
    var smooth_weight = array<f32, 3>(0.25, 0.5, 0.25);
    var sum = vec3f(0.0);
    for (var k = 0; k < 3; k++) {
        for (var j = 0; j < 3; j++) {
            for (var i = 0; i < 3; i++) {
                let value = value_at(vec3f(places[i].x, places[j].y, places[k].z) / frame.dims);
                let w = vec3f(smooth_weight[i], smooth_weight[j], smooth_weight[k]);
                sum += value * vec3f(f32(i - 1) * w.y * w.z, f32(j - 1) * w.x * w.z, f32(k - 1) * w.x * w.y);
            }
        }
    }
    let span = high - low;
    return select(vec3f(0.0), sum / max(span, vec3f(1e-6)), span > vec3f(1e-4));
}
