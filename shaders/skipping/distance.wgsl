//! slot: skipping
//! label: Distance map
//! help: Leaps over empty bricks by the Chebyshev distance to the nearest visible one. The picture stays the same to the last bit.

#include "skipping/leap.wgsl"

fn skip_empty(ray: Ray, index: u32) -> u32 {
    let p = position_along(ray, segment(ray, leap_base(index)).x);
    let brick = brick_at(p);
    let empty = textureLoad(skip_map, brick, 0).x;
    if empty == 0u {
        return index;
    }
    return max(index, leap(ray, index, p, brick, empty));
}
