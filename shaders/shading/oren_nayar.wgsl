//! slot: shading
//! label: Oren-Nayar
//! help: Diffuse light from a rough surface (Oren and Nayar 1994): flatter than Lambert, like clay or the moon.
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.8 [0, 2] -- strength of the diffuse term
//! param roughness: f32 = 0.5 [0, 1] unit rad -- standard deviation of the facets' slope angle

#include "shading/highlight.wgsl"

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let nl = clamp(dot(surface.normal, surface.light), 0.0, 1.0);
    // Normals of media turn to the light, not to the viewer.
    let toward = dot(surface.normal, surface.view);
    let nv = min(abs(toward), 1.0);
    let s2 = params.roughness * params.roughness;
    let a = 1.0 - 0.5 * s2 / (s2 + 0.33);
    let b = 0.45 * s2 / (s2 + 0.09);
    // cos of the angle between light and viewer in the tangent plane; sin(alpha) tan(beta) without angles.
    let azimuth = dot(direction_of(surface.light - nl * surface.normal), direction_of(surface.view - toward * surface.normal));
    let sines = sqrt(max((1.0 - nl * nl) * (1.0 - nv * nv), 0.0));
    let rough = a + b * max(azimuth, 0.0) * sines / max(max(nl, nv), 1e-3);
    return vec4f(medium.rgb * (params.ambient + params.diffuse * nl * rough * surface.light_color), medium.w);
}
