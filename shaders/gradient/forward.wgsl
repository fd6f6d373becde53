//! slot: gradient
//! label: Forward differences
//! help: Value one voxel ahead minus the value here: cheap, first order, shifted by half a voxel.

#include "gradient/slope.wgsl"

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    return slopes(p, 0.0, 1.0);
}
