//! slot: gradient
//! label: Backward differences
//! help: Value here minus the value one voxel behind: cheap, first order, shifted by half a voxel.

#include "gradient/slope.wgsl"

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    return slopes(p, 1.0, 0.0);
}
