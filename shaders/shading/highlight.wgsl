/// A unit vector, or zero for a vector without direction.
fn direction_of(v: vec3f) -> vec3f {
    return v / max(length(v), 1e-20);
}

/// base^exponent for base 0..1; 0 where the base is 0.
fn lobe(base: f32, exponent: f32) -> f32 {
    return select(0.0, exp2(exponent * log2(max(base, 1e-20))), base > 0.0);
}

/// Blinn's highlight: normal against the vector half-way between light and viewer. Zero on the unlit side.
fn blinn_highlight(surface: Surface, shininess: f32) -> f32 {
    let half_way = direction_of(surface.light + surface.view);
    let highlight = lobe(max(dot(surface.normal, half_way), 0.0), shininess);
    return select(0.0, highlight, dot(surface.normal, surface.light) > 0.0);
}
