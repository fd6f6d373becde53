//! slot: lattice
//! help: Moved by a random share of a step for every pixel.

/// From 0 to below 1, of 24 random bits: the integer hash PCG3D of Jarzynski and Olano (2020).
fn lattice_shift(pixel: vec2u) -> f32 {
    var v = vec3u(pixel, frame.jitter_seed) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    return f32(v.x >> 8u) / 16777216.0;
}
