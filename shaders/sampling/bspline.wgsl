//! slot: sampling
//! label: Tricubic B-spline
//! help: Cubic B-spline through the voxels (prefiltered coefficients): smooth, fourth order, 64 texel loads.
//! reads: prefiltered
//! forbids: gradient = precomputed -- the coefficients hold one channel and no gradient
//! kernel: 1 1

#include "sampling/kernel.wgsl"

fn sample_volume(p: vec3f) -> vec4f {
    // Beyond the outermost voxel centres the volume is constant.
    let x = clamp(p * source.dims - 0.5, vec3f(0.0), source.dims - 1.0);
    let t = x - floor(x);
    let u = 1.0 - t;
    let w0 = u * u * u / 6.0;
    let w1 = (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0;
    let w2 = (4.0 + 3.0 * u * u * (u - 2.0)) / 6.0;
    let w3 = t * t * t / 6.0;
    return weigh_64_texels(x, array<vec3f, 4>(w0, w1, w2, w3), true);
}
