//! slot: gradient
//! label: Filtered central differences
//! help: A quarter of the central difference here and three quarters of the mean at the eight diagonal neighbours: smoothest and dearest, 54 samples.

#include "gradient/slope.wgsl"

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    var sum = vec3f(0.0);
    for (var corner = 0u; corner < 8u; corner++) {
        let side = vec3f(vec3u(corner, corner >> 1u, corner >> 2u) & vec3u(1u)) * 2.0 - 1.0;
        sum += slopes(p + side / frame.dims, 1.0, 1.0);
    }
    return 0.25 * slopes(p, 1.0, 1.0) + 0.75 / 8.0 * sum;
}
