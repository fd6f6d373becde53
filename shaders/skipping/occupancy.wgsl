//! slot: skipping
//! label: Brick occupancy
//! help: Leaps to the end of a brick in which nothing is visible. The picture stays the same to the last bit.

#include "skipping/leap.wgsl"

fn skip_empty(ray: Ray, index: f32) -> f32 {
    let p = position_along(ray, place_of(ray, leap_base(ray, index)).distance);
    let brick = brick_at(p);
    if textureLoad(skip_map, brick, 0).x == 0u {
        return index;
    }
    return leap(ray, index, p, brick, 1u);
}
