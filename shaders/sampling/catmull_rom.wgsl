//! slot: sampling
//! label: Catmull-Rom
//! help: Cubic interpolation of the voxels, third order; may overshoot the data. 64 texel loads.
//! kernel: 1 1.953125

#include "sampling/kernel.wgsl"

fn sample_volume(p: vec3f) -> vec4f {
    // Beyond the outermost voxel centres the volume is constant.
    let x = clamp(p * source.dims - 0.5, vec3f(0.0), source.dims - 1.0);
    let t = x - floor(x);
    let w0 = 0.5 * t * (t * (2.0 - t) - 1.0);
    let w1 = 0.5 * (t * t * (3.0 * t - 5.0) + 2.0);
    let w2 = 0.5 * t * (t * (4.0 - 3.0 * t) + 1.0);
    let w3 = 0.5 * t * t * (t - 1.0);
    return weigh_64_texels(x, array<vec3f, 4>(w0, w1, w2, w3), false);
}
