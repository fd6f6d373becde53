//! slot: skipping
//! label: Distance map
//! help: Leaps over empty bricks by the Chebyshev distance to the nearest visible one. The picture stays the same to the last bit.

#include "skipping/leap.wgsl"

fn skip_empty(ray: Ray, index: f32) -> f32 {
    let p = position_along(ray, place_of(ray, leap_base(ray, index)).distance);
    let brick = brick_at(p);
    let empty = textureLoad(skip_map, brick, 0).x;
    if empty == 0u {
        return index;
    }
    return leap(ray, index, p, brick, empty);
}
