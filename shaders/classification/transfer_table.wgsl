#include "classification/table.wgsl"

/// The medium of a normalised value.
fn transfer_lookup(u: f32) -> vec4f {
#if steps
    // A cell, from one entry to the next, has three pieces with two rows each: the medium at the start and at the end. The last
    // row holds the two cuts.
    let last = i32(textureDimensions(transfer_table).x) - 1;
    let x = clamp(u, 0.0, 1.0) * f32(last);
    let i = min(i32(x), last - 1);
    let cuts = textureLoad(transfer_table, vec2i(i, 6), 0).xy;
    let cut = vec2f(x) >= cuts;
    let row = select(select(0, 2, cut.x), 4, cut.y);
    let low = select(select(f32(i), cuts.x, cut.x), cuts.y, cut.y);
    let high = select(select(cuts.x, cuts.y, cut.x), f32(i + 1), cut.y);
    let start = textureLoad(transfer_table, vec2i(i, row), 0);
    let end = textureLoad(transfer_table, vec2i(i, row + 1), 0);
    // A piece may be empty, and is so behind the last entry.
    return mix(start, end, clamp((x - low) / max(high - low, 1e-9), 0.0, 1.0));
#else
    return table_lookup(transfer_table, 0, u);
#endif
}
