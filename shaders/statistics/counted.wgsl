//! slot: statistics
//! help: Rays and samples of the whole picture are counted.

/// Rays, then samples taken and samples contributing, each as low and high word.
@group(0) @binding(auto) var<storage, read_write> counters: array<atomic<u32>, 6>;

fn count_ray(ray: Ray, walk: Walk) {
    count_wide(0u, select(0u, 1u, ray.last > ray.first));
    count_wide(2u, walk.taken);
    count_wide(4u, walk.contributing);
}

fn count_wide(slot: u32, amount: u32) {
    let before = atomicAdd(&counters[slot], amount);
    if before + amount < before {
        atomicAdd(&counters[slot + 1u], 1u);
    }
}
