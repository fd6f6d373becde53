//! slot: shading
//! label: Ward
//! help: Anisotropic Gaussian highlight (Ward 1992), brushed along the world's vertical axis.
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.7 [0, 2] -- strength of the diffuse term
//! param specular: f32 = 0.3 [0, 2] -- strength of the reflection
//! param along: f32 = 0.2 [0.05, 1] -- slope across the brushing
//! param across: f32 = 0.4 [0.05, 1] -- slope along the brushing

#include "shading/highlight.wgsl"

const PI = 3.14159265;

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let n = surface.normal;
    // The brushing direction must not be parallel to the normal.
    let axis = select(vec3f(0.0, 0.0, 1.0), vec3f(1.0, 0.0, 0.0), abs(n.z) > 0.9);
    let tangent = direction_of(cross(axis, n));
    let bitangent = cross(n, tangent);
    let half_way = direction_of(surface.light + surface.view);
    let nl = max(dot(n, surface.light), 0.0);
    // Normals of media turn to the light, not to the viewer.
    let nv = max(abs(dot(n, surface.view)), 1e-3);
    let nh = max(dot(n, half_way), 1e-3);
    let x = dot(half_way, tangent) / params.along;
    let y = dot(half_way, bitangent) / params.across;
    let gauss = exp(-(x * x + y * y) / (nh * nh)) / (4.0 * PI * params.along * params.across);
    // Ward's 1 / sqrt(n.l n.v), times the cosine n.l of the incoming light.
    let reflection = select(0.0, gauss * sqrt(nl / nv), nl > 0.0);
    let diffuse = params.ambient + params.diffuse * nl * surface.light_color;
    return vec4f(medium.rgb * diffuse + medium.w * params.specular * reflection * surface.light_color, medium.w);
}
