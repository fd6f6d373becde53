#include "image/common.wgsl"

// Two images become one. One invocation a pixel.

const DEPTH_TEST: u32 = 0u;
const DEPTH_OVER: u32 = 1u;
const OVER: u32 = 2u;
const WEIGHTED: u32 = 3u;
const DIFFERENCE: u32 = 4u;

struct Parameters {
    mode: u32,
    weight: f32,
    gain: f32,
}

struct Pixel {
    color: vec4f,
    depth: f32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var first_color: texture_2d<f32>;
@group(0) @binding(2) var first_depth: texture_2d<f32>;
@group(0) @binding(3) var second_color: texture_2d<f32>;
@group(0) @binding(4) var second_depth: texture_2d<f32>;
@group(0) @binding(5) var result_color: texture_storage_2d<rgba32float, write>;
@group(0) @binding(6) var result_depth: texture_storage_2d<r32float, write>;

fn composite(a: Pixel, b: Pixel) -> Pixel {
    let nearest = min(a.depth, b.depth);
    switch parameters.mode {
        case DEPTH_TEST: {
            // Neither hits, or both at one depth: the first lies over the second.
            if a.depth == b.depth {
                return Pixel(over(a.color, b.color), nearest);
            }
            return Pixel(select(b.color, a.color, a.depth < b.depth), nearest);
        }
        case DEPTH_OVER: {
            if a.depth <= b.depth {
                return Pixel(over(a.color, b.color), nearest);
            }
            return Pixel(over(b.color, a.color), nearest);
        }
        case OVER: {
            return Pixel(over(a.color, b.color), select(b.depth, a.depth, a.depth < MISS));
        }
        case WEIGHTED: {
            return Pixel(mix(a.color, b.color, parameters.weight), nearest);
        }
        case DIFFERENCE: {
            let difference = parameters.gain * abs(a.color.rgb - b.color.rgb);
            return Pixel(vec4f(difference, 1.0), MISS);
        }
        default: {
            return Pixel(max(a.color, b.color), select(b.depth, a.depth, a.color.a >= b.color.a));
        }
    }
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result_color)) {
        return;
    }
    let a = Pixel(texel_at(first_color, id.xy), texel_at(first_depth, id.xy).r);
    let b = Pixel(texel_at(second_color, id.xy), texel_at(second_depth, id.xy).r);
    let pixel = composite(a, b);
    textureStore(result_color, id.xy, pixel.color);
    textureStore(result_depth, id.xy, vec4f(pixel.depth, 0.0, 0.0, 1.0));
}
