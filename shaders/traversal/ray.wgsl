const MISS_DEPTH = 3.0e38;

#if jitter
/// A number from 0 to below 1 for a pixel, of 24 random bits: the integer hash PCG3D of Jarzynski and Olano (2020).
fn jitter_at(pixel: vec2u) -> f32 {
    var v = vec3u(pixel, frame.jitter_seed) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    return f32(v.x >> 8u) / 16777216.0;
}

#endif
/// The ray between the entry and exit points of a pixel.
fn ray_through(pixel: vec2u) -> Ray {
    let entry = textureLoad(entry_points, pixel, 0);
    let exit = textureLoad(exit_points, pixel, 0);
    let chord = exit.xyz - entry.xyz;
    let world = frame.volume_to_world * chord;
    let world_length = length(world);
    // Sampling rate is counted along the ray in voxels, so an isotropic volume has one step length for all rays.
    let steps = clamp(length(chord * frame.dims) * frame.samples_per_voxel, 1e-6, f32(frame.max_samples));
    var ray: Ray;
    ray.entry = entry.xyz;
    ray.step = chord / steps;
    ray.steps = steps;
    // A remainder below 1e-4 of a step is rounding, not a segment: the last one takes it in.
#if jitter
    ray.shift = jitter_at(pixel);
    ray.count = max(1u, u32(ceil(steps + ray.shift - 1e-4)));
#else
    ray.count = max(1u, u32(ceil(steps - 1e-4)));
#endif
    ray.step_length = world_length / steps;
    ray.view = -world / max(world_length, 1e-30);
    if entry.w < 0.5 || exit.w < 0.5 || world_length <= 0.0 {
        ray.count = 0u;
    }
    return ray;
}

/// Where sample `index` is (x, in steps) and how long its segment is (y, in steps).
fn segment(ray: Ray, index: u32) -> vec2f {
#if jitter
    // The first segment is shortened, too.
    let start = max(f32(index) - ray.shift, 0.0);
    let whole = select(1.0, 1.0 - ray.shift, index == 0u);
    let span = select(whole, ray.steps - start, index + 1u == ray.count);
#else
    let start = f32(index);
    let span = select(1.0, ray.steps - start, index + 1u == ray.count);
#endif
#if segment_ends
    return vec2f(start + span, span);
#else
    return vec2f(start + 0.5 * span, span);
#endif
}

/// Volume coordinates after `along` steps.
fn position_along(ray: Ray, along: f32) -> vec3f {
    return ray.entry + ray.step * along;
}

/// Distance along the viewing direction in world units; linear along a ray for every camera.
fn depth_along(ray: Ray, along: f32) -> f32 {
    let depth = dot(frame.depth_plane, vec4f(position_along(ray, along), 1.0));
    return select(depth, MISS_DEPTH, along < 0.0);
}
#if statistics

fn count_wide(slot: u32, amount: u32) {
    let before = atomicAdd(&counters[slot], amount);
    if before + amount < before {
        atomicAdd(&counters[slot + 1u], 1u);
    }
}

fn count_samples(ray: Ray, taken: u32, contributing: u32) {
    count_wide(0u, select(0u, 1u, ray.count > 0u));
    count_wide(2u, taken);
    count_wide(4u, contributing);
}
#endif
