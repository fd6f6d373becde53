/// The sample from which the loop may leap ahead: the next one, or, where samples need their predecessor,
/// the last one taken, so that whatever spans two samples has both its ends in empty bricks.
fn leap_base(ray: Ray, index: f32) -> f32 {
    return select(index, max(index - 1.0, ray.first), PREVIOUS);
}

/// The brick of the skipping map at `p` (volume coordinates).
fn brick_at(p: vec3f) -> vec3i {
    let last = vec3i(textureDimensions(skip_map)) - 1;
    return clamp(vec3i(floor(p * source.brick_scale)), vec3i(0), last);
}

/// The next sample to take from `index` on when all bricks closer than `empty` to that of its leap base are empty (1: only its
/// own), which lies at `p` in `brick`. Samples stay on their lattice; too short a leap costs a look, too long a one would cost the
/// picture, so it rounds down.
fn leap(ray: Ray, index: f32, p: vec3f, brick: vec3i, empty: u32) -> f32 {
    let reach = f32(empty) - 1.0;
    let low = (vec3f(brick) - reach) / source.brick_scale;
    let high = (vec3f(brick) + 1.0 + reach) / source.brick_scale;
    let step = direction_of_ray(ray) * frame.step;
    let border = select(low, high, step > vec3f(0.0));
    let moving = abs(step) > vec3f(1e-12);
    let exits = select(vec3f(1e9), (border - p) / select(vec3f(1.0), step, moving), moving);
    let exit = min(exits.x, min(exits.y, exits.z));
    let inside = clamp(floor(exit * (1.0 - 1e-5) - 1e-3), 0.0, 1e9);
    // The last empty sample becomes the predecessor of the first that is not. The first of all follows on the begin of the ray,
    // which may lie in another brick.
    let with_predecessor = select(index - 1.0 + inside, index, index <= ray.first);
    return select(index + 1.0 + inside, with_predecessor, PREVIOUS);
}
