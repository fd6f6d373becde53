//! slot: gradient
//! label: Precomputed
//! help: The gradient that a gradient volume stores beside the value: no extra sample at all.
//! reads: gradient_volume

fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f {
    return voxel.xyz;
}
