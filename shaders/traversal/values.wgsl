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
#if gaps

/// Whether interpolation between the voxels around `p` (volume coordinates) touches one that has no value (NaN).
fn in_gap(p: vec3f) -> bool {
    let last = vec3i(textureDimensions(gap_map)) - 1;
    return textureLoad(gap_map, clamp(vec3i(floor(p * frame.dims - 0.5)), vec3i(0), last), 0).x != 0u;
}
#endif
