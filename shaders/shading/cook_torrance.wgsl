//! slot: shading
//! label: Cook-Torrance
//! help: Microfacets with Beckmann distribution, Schlick's Fresnel term and the V-groove shadowing of Cook and Torrance (1982).
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.7 [0, 2] -- strength of the diffuse term
//! param specular: f32 = 0.6 [0, 2] -- strength of the reflection
//! param roughness: f32 = 0.3 [0.05, 1] -- root mean square slope of the microfacets
//! param reflectance: f32 = 0.2 [0, 1] -- Fresnel reflectance at normal incidence

#include "shading/highlight.wgsl"

const PI = 3.14159265;

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let half_way = direction_of(surface.light + surface.view);
    let nl = max(dot(surface.normal, surface.light), 0.0);
    // Normals of media turn to the light, not to the viewer.
    let nv = max(abs(dot(surface.normal, surface.view)), 1e-3);
    let nh = max(dot(surface.normal, half_way), 1e-3);
    let vh = max(dot(surface.view, half_way), 1e-3);
    let m2 = params.roughness * params.roughness;
    let nh2 = nh * nh;
    let distribution = exp((nh2 - 1.0) / (m2 * nh2)) / (PI * m2 * nh2 * nh2);
    let shadowing = min(1.0, min(2.0 * nh * nv / vh, 2.0 * nh * nl / vh));
    let miss = 1.0 - vh;
    let fresnel = params.reflectance + (1.0 - params.reflectance) * miss * miss * miss * miss * miss;
    // Divided by 4 (n.v)(n.l) and multiplied by the cosine n.l of the incoming light.
    let reflection = select(0.0, distribution * shadowing * fresnel / (4.0 * nv), nl > 0.0);
    let diffuse = params.ambient + params.diffuse * nl * surface.light_color;
    return vec4f(medium.rgb * diffuse + medium.w * params.specular * reflection * surface.light_color, medium.w);
}
