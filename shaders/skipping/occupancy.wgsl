//! slot: skipping
//! label: Brick occupancy
//! help: Leaps to the end of a brick in which nothing is visible. The picture stays the same to the last bit.

#include "skipping/leap.wgsl"

fn skip_empty(ray: Ray, index: u32) -> u32 {
    let p = position_along(ray, segment(ray, leap_base(index)).x);
    let brick = brick_at(p);
    if textureLoad(skip_map, brick, 0).x == 0u {
        return index;
    }
    return max(index, leap(ray, index, p, brick, 1u));
}
