//! slot: slope
//! help: The gradient at every sample.

fn sample_gradient(s: Sample) -> vec3f {
    return world_gradient(s.position, s.voxel);
}
