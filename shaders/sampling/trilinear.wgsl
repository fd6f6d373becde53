//! slot: sampling
//! label: Float trilinear
//! help: Trilinear interpolation with 32-bit float weights from eight texel loads.
//! kernel: 0 1

fn sample_volume(p: vec3f) -> vec4f {
    let x = p * source.dims - 0.5;
    let base = floor(x);
    let w = x - base;
    let last = vec3i(textureDimensions(volume)) - 1;
    let a = clamp(vec3i(base), vec3i(0), last);
    let b = clamp(vec3i(base) + 1, vec3i(0), last);
    let c00 = mix(textureLoad(volume, a, 0), textureLoad(volume, vec3i(b.x, a.yz), 0), w.x);
    let c10 = mix(textureLoad(volume, vec3i(a.x, b.y, a.z), 0), textureLoad(volume, vec3i(b.xy, a.z), 0), w.x);
    let c01 = mix(textureLoad(volume, vec3i(a.xy, b.z), 0), textureLoad(volume, vec3i(b.x, a.y, b.z), 0), w.x);
    let c11 = mix(textureLoad(volume, vec3i(a.x, b.yz), 0), textureLoad(volume, b, 0), w.x);
    return mix(mix(c00, c10, w.y), mix(c01, c11, w.y), w.z);
}
