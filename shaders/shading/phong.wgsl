//! slot: shading
//! label: Phong
//! help: Diffuse light and a highlight around the mirrored light direction (Phong 1975).
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.7 [0, 2] -- strength of the diffuse term
//! param specular: f32 = 0.3 [0, 2] -- strength of the highlight
//! param shininess: f32 = 16 [1, 512] -- exponent: larger means a smaller highlight

#include "shading/highlight.wgsl"

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let cosine = dot(surface.normal, surface.light);
    let mirrored = 2.0 * cosine * surface.normal - surface.light;
    let highlight = select(0.0, lobe(max(dot(mirrored, surface.view), 0.0), params.shininess), cosine > 0.0);
    let diffuse = params.ambient + params.diffuse * max(cosine, 0.0) * surface.light_color;
    return vec4f(medium.rgb * diffuse + medium.w * params.specular * highlight * surface.light_color, medium.w);
}
