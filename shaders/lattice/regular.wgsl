//! slot: lattice
//! help: Samples begin where the ray's line enters the volumes.

fn lattice_shift(pixel: vec2u) -> f32 {
    return 0.0;
}
