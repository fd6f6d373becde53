//! slot: shading
//! label: Blinn-Phong
//! help: Diffuse light and a highlight around the half-way vector (Blinn 1977).
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.7 [0, 2] -- strength of the diffuse term
//! param specular: f32 = 0.3 [0, 2] -- strength of the highlight
//! param shininess: f32 = 32 [1, 512] -- exponent: larger means a smaller highlight

#include "shading/highlight.wgsl"

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let lambert = max(dot(surface.normal, surface.light), 0.0);
    let highlight = blinn_highlight(surface, params.shininess);
    let diffuse = params.ambient + params.diffuse * lambert * surface.light_color;
    return vec4f(medium.rgb * diffuse + medium.w * params.specular * highlight * surface.light_color, medium.w);
}
