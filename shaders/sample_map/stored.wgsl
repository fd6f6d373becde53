//! slot: sample_map
//! help: The samples of every ray go to an image.

/// Per ray: samples taken, samples contributing, 0, and 1 where the ray meets the volume.
@group(0) @binding(auto) var sample_map: texture_storage_2d<rgba32float, write>;

fn map_ray(pixel: vec2u, ray: Ray, walk: Walk) {
    let met = select(0.0, 1.0, ray.last > ray.first);
    textureStore(sample_map, pixel, vec4f(f32(walk.taken), f32(walk.contributing), 0.0, met));
}
