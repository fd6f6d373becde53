/// The mean medium of a segment along which the value runs linearly from `front` to `back`.
fn preintegrated(front: f32, back: f32) -> vec4f {
    return table_lookup_2d(preintegrated_table, vec2f(front, back));
}
