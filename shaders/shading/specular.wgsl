//! slot: shading
//! label: Specular
//! help: Only highlights, in the colour of the light, over an ambient share of the colour.
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param specular: f32 = 0.8 [0, 2] -- strength of the highlight
//! param shininess: f32 = 32 [1, 512] -- exponent: larger means a smaller highlight

#include "shading/highlight.wgsl"

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let highlight = params.specular * blinn_highlight(surface, params.shininess) * surface.light_color;
    return vec4f(medium.rgb * params.ambient + medium.w * highlight, medium.w);
}
