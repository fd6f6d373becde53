/// Linear interpolation between the entries of a one-row table; `u` in 0..1 runs from the first entry to the last.
fn table_lookup(table: texture_2d<f32>, row: i32, u: f32) -> vec4f {
    let last = i32(textureDimensions(table).x) - 1;
    let x = clamp(u, 0.0, 1.0) * f32(last);
    let i = min(i32(x), last - 1);
    return mix(textureLoad(table, vec2i(i, row), 0), textureLoad(table, vec2i(i + 1, row), 0), x - f32(i));
}

/// Bilinear interpolation between the entries of a two-dimensional table; `u` in 0..1 along both axes.
fn table_lookup_2d(table: texture_2d<f32>, u: vec2f) -> vec4f {
    let last = i32(textureDimensions(table).y) - 1;
    let y = clamp(u.y, 0.0, 1.0) * f32(last);
    let j = min(i32(y), last - 1);
    return mix(table_lookup(table, j, u.x), table_lookup(table, j + 1, u.x), y - f32(j));
}
