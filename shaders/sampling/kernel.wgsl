// Written without loops: some drivers bound the loop rounds of an invocation, and a ray needs them for its samples.

/// Four texels along x from `first` on. Beyond the border the voxels are mirrored at the outermost ones, or those go on.
fn weigh_4_texels(first: vec3i, last: vec3i, w: array<vec3f, 4>, mirror: bool) -> vec4f {
    return textureLoad(volume, within(first, last, mirror), 0) * w[0].x
        + textureLoad(volume, within(first + vec3i(1, 0, 0), last, mirror), 0) * w[1].x
        + textureLoad(volume, within(first + vec3i(2, 0, 0), last, mirror), 0) * w[2].x
        + textureLoad(volume, within(first + vec3i(3, 0, 0), last, mirror), 0) * w[3].x;
}

fn within(texel: vec3i, last: vec3i, mirror: bool) -> vec3i {
    let mirrored = last - abs(last - abs(texel));
    return clamp(select(texel, mirrored, mirror), vec3i(0), last);
}

fn weigh_16_texels(first: vec3i, last: vec3i, w: array<vec3f, 4>, mirror: bool) -> vec4f {
    return weigh_4_texels(first, last, w, mirror) * w[0].y
        + weigh_4_texels(first + vec3i(0, 1, 0), last, w, mirror) * w[1].y
        + weigh_4_texels(first + vec3i(0, 2, 0), last, w, mirror) * w[2].y
        + weigh_4_texels(first + vec3i(0, 3, 0), last, w, mirror) * w[3].y;
}

/// Sum over the 4x4x4 texels around `x` (voxel centres at whole numbers) with separable weights: element k of `w` holds the
/// weights of offset k - 1.
fn weigh_64_texels(x: vec3f, w: array<vec3f, 4>, mirror: bool) -> vec4f {
    let first = vec3i(floor(x)) - 1;
    let last = vec3i(textureDimensions(volume)) - 1;
    return weigh_16_texels(first, last, w, mirror) * w[0].z
        + weigh_16_texels(first + vec3i(0, 0, 1), last, w, mirror) * w[1].z
        + weigh_16_texels(first + vec3i(0, 0, 2), last, w, mirror) * w[2].z
        + weigh_16_texels(first + vec3i(0, 0, 3), last, w, mirror) * w[3].z;
}
