//! slot: gradient
//! label: Filtered central differences
//! help: A quarter of the central difference here and three quarters of the mean at the eight diagonal neighbours: smoothest and dearest, 54 samples.

#include "gradient/slope.wgsl"

// Written without loops: some drivers bound the loop rounds of an invocation, and a ray needs them for its samples.

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    let h = 1.0 / source.dims;
    let below = p - h;
    let above = p + h;
    let corners = slopes(below, 1.0, 1.0)
        + slopes(vec3f(above.x, below.yz), 1.0, 1.0)
        + slopes(vec3f(below.x, above.y, below.z), 1.0, 1.0)
        + slopes(vec3f(above.xy, below.z), 1.0, 1.0)
        + slopes(vec3f(below.xy, above.z), 1.0, 1.0)
        + slopes(vec3f(above.x, below.y, above.z), 1.0, 1.0)
        + slopes(vec3f(below.x, above.yz), 1.0, 1.0)
        + slopes(above, 1.0, 1.0);
    return 0.25 * slopes(p, 1.0, 1.0) + 0.75 / 8.0 * corners;
}
