/// Normalised values of all channels at `p` (volume coordinates).
fn voxel_at(p: vec3f) -> vec4f {
    return sample_volume(p) * frame.texel_scale + frame.texel_offset;
}

fn selected(voxel: vec4f) -> f32 {
#if channel_0
    return voxel.x;
#endif
#if channel_1
    return voxel.y;
#endif
#if channel_2
    return voxel.z;
#endif
#if channel_3
    return voxel.w;
#endif
}

/// Normalised value of the selected channel at `p` (volume coordinates).
fn value_at(p: vec3f) -> f32 {
    return selected(voxel_at(p));
}
