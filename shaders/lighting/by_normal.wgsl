//! slot: lighting
//! help: Shading by the normal, which is against the gradient. Where the gradient vanishes there is no surface to light, and the unlit medium shows.

/// Two-sided lighting turns normals to the side of `facing`: the viewer for surfaces, whose front is what is seen. A medium has
/// no front, and it turns to the light: turning to the viewer would jump where a normal is seen edge-on, inside of what the ray
/// integrates, and cost an order of convergence.
fn lit(medium: vec4f, ray: Ray, p: vec3f, voxel: vec4f, facing: vec3f) -> vec4f {
    let gradient = world_gradient(p, voxel);
    let magnitude = length(gradient);
    var normal = -gradient / max(magnitude, 1e-20);
    if frame.two_sided > 0.5 && dot(normal, facing) < 0.0 {
        normal = -normal;
    }
    let weight = magnitude / (magnitude + frame.gradient_fade);
    return mix(medium, shade(medium, Surface(normal, ray.view, frame.light_direction, frame.light_color)), weight);
}
