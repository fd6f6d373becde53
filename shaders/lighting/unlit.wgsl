//! slot: lighting
//! help: The classified colour as it is.

fn lit(medium: vec4f, ray: Ray, p: vec3f, voxel: vec4f, facing: vec3f) -> vec4f {
    return medium;
}
