// Pixels from rays. A pixel is the mean over its footprint, which is at least as wide as a ray: a box over several rays
// where there are more of them than pixels, linear interpolation where there are fewer. Depth is that of the nearest ray in
// the footprint. One invocation a pixel.

@group(0) @binding(0) var rays: texture_2d<f32>;
@group(0) @binding(1) var ray_depths: texture_2d<f32>;
#if half_targets
@group(0) @binding(2) var result: texture_storage_2d<rgba16float, write>;
#else
@group(0) @binding(2) var result: texture_storage_2d<rgba32float, write>;
#endif
@group(0) @binding(3) var result_depth: texture_storage_2d<r32float, write>;

const MISS = 3.0e38;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(result);
    if any(id.xy >= size) {
        return;
    }
    let rays_per_pixel = vec2f(textureDimensions(rays)) / vec2f(size);
    let center = (vec2f(id.xy) + 0.5) * rays_per_pixel;
    let reach = 0.5 * max(rays_per_pixel, vec2f(1.0));
    let low = center - reach;
    let high = center + reach;
    let last = vec2i(textureDimensions(rays)) - 1;
    var sum = vec4f(0.0);
    var total = 0.0;
    var depth = MISS;
    for (var y = i32(floor(low.y)); y < i32(ceil(high.y)); y += 1) {
        for (var x = i32(floor(low.x)); x < i32(ceil(high.x)); x += 1) {
            let corner = vec2f(f32(x), f32(y));
            let overlap = min(high, corner + 1.0) - max(low, corner);
            let weight = overlap.x * overlap.y;
            let ray = clamp(vec2i(x, y), vec2i(0), last);
            sum += weight * textureLoad(rays, ray, 0);
            total += weight;
            depth = min(depth, textureLoad(ray_depths, ray, 0).x);
        }
    }
    textureStore(result, id.xy, sum / total);
    textureStore(result_depth, id.xy, vec4f(depth));
}
