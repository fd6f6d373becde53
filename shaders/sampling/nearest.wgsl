//! slot: sampling
//! label: Nearest voxel
//! help: The value of the voxel that contains the point. Shows the data as stored; the only choice for labels.
//! kernel: 0 1

fn sample_volume(p: vec3f) -> vec4f {
    let last = vec3i(textureDimensions(volume)) - 1;
    return textureLoad(volume, clamp(vec3i(floor(p * source.dims)), vec3i(0), last), 0);
}
