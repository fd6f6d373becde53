//! slot: gradient
//! label: Central differences
//! help: Difference of the values one voxel ahead and one behind: second order, six samples.

#include "gradient/slope.wgsl"

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    return slopes(p, 1.0, 1.0);
}
