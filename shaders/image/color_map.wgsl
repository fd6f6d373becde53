#include "image/common.wgsl"

// Shows numbers of an image as colours. One invocation a pixel.

// What to show: the colours themselves, one of the four channels, or the depth.
const COLORS: u32 = 0u;
const DEPTH: u32 = 5u;

struct Parameters {
    // Opaque colours at equal distances over the range.
    stops: array<vec4f, 8>,
    // The values shown with the first and with the last stop.
    range: vec2f,
    stop_count: u32,
    show: u32,
    // 1: pixels whose fourth channel is 0 hold nothing.
    has_misses: u32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var image: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_2d<f32>;
@group(0) @binding(3) var result: texture_storage_2d<rgba32float, write>;

fn mapped(value: f32) -> vec4f {
    let share = clamp((value - parameters.range.x) / (parameters.range.y - parameters.range.x), 0.0, 1.0);
    let position = share * f32(parameters.stop_count - 1u);
    let low = min(u32(position), parameters.stop_count - 2u);
    return mix(parameters.stops[low], parameters.stops[low + 1u], position - f32(low));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result)) {
        return;
    }
    let texel = texel_at(image, id.xy);
    let distance = texel_at(depth, id.xy).r;
    var color = vec4f(0.0);
    if parameters.show == DEPTH {
        if distance < MISS {
            color = mapped(distance);
        }
    } else if parameters.show == COLORS {
        let width = parameters.range.y - parameters.range.x;
        color = vec4f((texel.rgb - parameters.range.x * texel.a) / width, texel.a);
    } else if parameters.has_misses == 0u || texel.a > 0.0 {
        color = mapped(texel[parameters.show - 1u]);
    }
    textureStore(result, id.xy, color);
}
