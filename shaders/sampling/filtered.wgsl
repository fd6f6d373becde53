//! slot: sampling
//! label: Filtered trilinear
//! help: Trilinear interpolation by the texture unit: fastest, with weights of about 8 bits on most GPUs.
//! reads: filtering
//! kernel: 0 1

fn sample_volume(p: vec3f) -> vec4f {
    return textureSampleLevel(volume, linear_sampler, p, 0.0);
}
