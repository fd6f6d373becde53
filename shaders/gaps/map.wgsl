//! slot: gaps
//! help: A map tells where interpolation touches a voxel that has no value (NaN).

/// 1 where it does.
@group(0) @binding(auto) var gap_map: texture_3d<u32>;

fn in_gap(p: vec3f) -> bool {
    let last = vec3i(textureDimensions(gap_map)) - 1;
    return textureLoad(gap_map, clamp(vec3i(floor(p * source.dims - 0.5)), vec3i(0), last), 0).x != 0u;
}
