/// (1 - exp(-x)) / x for x >= 0; a polynomial where the difference would cancel.
fn mean_transmittance(x: f32) -> f32 {
    let small = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))));
    let safe = max(x, 0.25);
    return select(small, (1.0 - exp(-safe)) / safe, x > 0.25);
}

/// Premultiplied colour and opacity of a stretch of medium, `length` in reference lengths.
/// All four components share one factor: colour 1 keeps colour equal to opacity to the last bit.
fn absorb(medium: vec4f, length: f32) -> vec4f {
    return medium * (length * mean_transmittance(medium.w * length));
}
