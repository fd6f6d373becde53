// Turns an image of any kind into 8-bit colours for a screen. One invocation a pixel.

const COLORS: u32 = 0u;
// 1 to 4: one channel as grey.
const DEPTH: u32 = 5u;
const COORDINATES: u32 = 6u;

struct Parameters {
    // The values shown black and white.
    range: vec2f,
    show: u32,
    // Side of a square of the checkerboard behind colours, pixels; 0: black.
    checker: u32,
    // 1: values outside of the range, or of 0 to 1 where the picture has no range of its own, are marked.
    mark: u32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var image: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_2d<f32>;
@group(0) @binding(3) var result: texture_storage_2d<rgba8unorm, write>;

const NOT_A_NUMBER = vec3f(1.0, 0.0, 1.0);
const BELOW = vec3f(0.1, 0.3, 1.0);
const ABOVE = vec3f(1.0, 0.15, 0.1);
const MISS = 3.0e38;

// WGSL may assume that NaN and infinity do not occur; their bits tell.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

fn backdrop(pixel: vec2u) -> vec3f {
    if parameters.checker == 0u {
        return vec3f(0.0);
    }
    let square = pixel / parameters.checker;
    return select(vec3f(0.32), vec3f(0.42), ((square.x + square.y) & 1u) == 0u);
}

fn grey(value: f32) -> vec3f {
    let width = max(parameters.range.y - parameters.range.x, 1e-30);
    return vec3f(clamp((value - parameters.range.x) / width, 0.0, 1.0));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result)) {
        return;
    }
    let texel = textureLoad(image, id.xy, 0);
    var color = vec3f(0.0);
    var low = any(texel < vec4f(0.0));
    var high = any(texel > vec4f(1.0));
    var finite = is_finite(texel.x) && is_finite(texel.y) && is_finite(texel.z) && is_finite(texel.w);
    if parameters.show == DEPTH {
        let distance = textureLoad(depth, id.xy, 0).x;
        finite = is_finite(distance);
        low = distance < parameters.range.x;
        high = distance > parameters.range.y && distance < MISS;
        color = select(backdrop(id.xy), 1.0 - grey(distance), distance < MISS);
    } else if parameters.show == COORDINATES {
        color = select(backdrop(id.xy), texel.rgb, texel.a > 0.0);
    } else if parameters.show == COLORS {
        color = texel.rgb + (1.0 - texel.a) * backdrop(id.xy);
    } else {
        let value = texel[parameters.show - 1u];
        low = value < parameters.range.x;
        high = value > parameters.range.y;
        color = grey(value);
    }
    color = clamp(color, vec3f(0.0), vec3f(1.0));
    color = select(color, BELOW, parameters.mark == 1u && low);
    color = select(color, ABOVE, parameters.mark == 1u && high);
    textureStore(result, id.xy, vec4f(select(NOT_A_NUMBER, color, finite), 1.0));
}
