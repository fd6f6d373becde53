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
    let piece = i32(x >= cuts.x) + i32(x >= cuts.y);
    var ends = vec4f(f32(i), cuts, f32(i + 1));
    let start = textureLoad(transfer_table, vec2i(i, 2 * piece), 0);
    let end = textureLoad(transfer_table, vec2i(i, 2 * piece + 1), 0);
    // A piece may be empty, and is so behind the last entry.
    let along = (x - ends[piece]) / max(ends[piece + 1] - ends[piece], 1e-9);
    return mix(start, end, clamp(along, 0.0, 1.0));
#else
    return table_lookup(transfer_table, 0, u);
#endif
}
