/// The sample from which the loop may leap ahead: the next one, or, where samples need their predecessor,
/// the last one taken, so that whatever spans two samples has both its ends in empty bricks.
fn leap_base(index: u32) -> u32 {
#if previous
    return max(index, 1u) - 1u;
#else
    return index;
#endif
}

/// The brick of the skipping map at `p` (volume coordinates).
fn brick_at(p: vec3f) -> vec3i {
    let last = vec3i(textureDimensions(skip_map)) - 1;
    return clamp(vec3i(floor(p * frame.brick_scale)), vec3i(0), last);
}

/// The next sample to take from `index` on when all bricks closer than `empty` to that of its leap base are empty (1: only its
/// own), which lies at `p` in `brick`. Samples stay on their lattice; too short a leap costs a look, too long a one would cost the picture, so it rounds down.
fn leap(ray: Ray, index: u32, p: vec3f, brick: vec3i, empty: u32) -> u32 {
    let reach = f32(empty) - 1.0;
    let low = (vec3f(brick) - reach) / frame.brick_scale;
    let high = (vec3f(brick) + 1.0 + reach) / frame.brick_scale;
    let border = select(low, high, ray.step > vec3f(0.0));
    let moving = abs(ray.step) > vec3f(1e-12);
    let safe_step = select(vec3f(1.0), ray.step, moving);
    let exits = select(vec3f(1e9), (border - p) / safe_step, moving);
    let exit = min(exits.x, min(exits.y, exits.z));
    let inside = u32(clamp(floor(exit * (1.0 - 1e-5) - 1e-3), 0.0, 1e9));
#if previous
    // The last empty sample becomes the predecessor of the first that is not. The first of all follows on the entry point,
    // which may lie in another brick.
    return select(max(index - 1u + inside, index), 0u, index == 0u);
#else
    return index + 1u + inside;
#endif
}
