//! slot: shading
//! label: Diffuse
//! help: Lambert: brightness falls with the cosine between normal and light.
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.8 [0, 2] -- strength of the diffuse term

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let lambert = max(dot(surface.normal, surface.light), 0.0);
    return vec4f(medium.rgb * (params.ambient + params.diffuse * lambert * surface.light_color), medium.w);
}
