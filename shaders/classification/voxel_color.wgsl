//! slot: classification
//! label: Voxel value as colour
//! help: The channels are the colour: grey, grey and opacity, RGB (opacity is the largest component), or RGB and opacity.
//! reads: voxel
//! param density: f32 = 1 [0, 1] -- factor of the opacity a reference length

/// -ln(1 - a), by its series where the logarithm is inexact.
fn extinction(opacity: f32) -> f32 {
    let a = clamp(opacity, 0.0, 1.0);
    let series = a * (1.0 + a * (1.0 / 2.0 + a * (1.0 / 3.0 + a * (1.0 / 4.0 + a * (1.0 / 5.0 + a / 6.0)))));
    // Opacity 1 is opaque at any step.
    let direct = select(-log(max(1.0 - a, 1e-7)), 1e6, a >= 1.0);
    return select(series, direct, a > 0.1);
}

fn classify(s: Sample) -> vec4f {
#if channels_1
    let color = vec4f(s.voxel.xxx, s.voxel.x);
#endif
#if channels_2
    let color = vec4f(s.voxel.xxx, s.voxel.y);
#endif
#if channels_3
    let color = vec4f(s.voxel.xyz, max(s.voxel.x, max(s.voxel.y, s.voxel.z)));
#endif
#if channels_4
    let color = s.voxel;
#endif
    return vec4f(clamp(color.rgb, vec3f(0.0), vec3f(1.0)), 1.0) * extinction(color.a * params.density);
}
