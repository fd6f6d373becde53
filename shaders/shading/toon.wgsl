//! slot: shading
//! label: Toon
//! help: Diffuse light in a few flat steps, like a cartoon.
//! reads: gradient, light
//! param ambient: f32 = 0.2 [0, 1] -- share of the colour that is seen without light
//! param diffuse: f32 = 0.8 [0, 2] -- strength of the diffuse term
//! param steps: u32 = 3 [1, 16] -- number of brightness steps

fn shade(medium: vec4f, surface: Surface) -> vec4f {
    let count = f32(params.steps);
    let lambert = clamp(dot(surface.normal, surface.light), 0.0, 1.0);
    let flat_light = ceil(lambert * count) / count;
    return vec4f(medium.rgb * (params.ambient + params.diffuse * flat_light * surface.light_color), medium.w);
}
