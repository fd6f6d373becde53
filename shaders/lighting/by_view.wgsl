//! slot: lighting
//! help: Shading that reads no gradient: the surface looks at the viewer.

fn lit(medium: vec4f, ray: Ray, p: vec3f, voxel: vec4f, facing: vec3f) -> vec4f {
    return shade(medium, Surface(ray.view, ray.view, frame.light_direction, frame.light_color));
}
