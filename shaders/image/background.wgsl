#include "image/common.wgsl"

// A background behind an image. One invocation a pixel.

const COLOR: u32 = 0u;
const GRADIENT: u32 = 1u;
const CHECKERBOARD: u32 = 2u;

struct Parameters {
    // Premultiplied colours.
    first: vec4f,
    second: vec4f,
    // The gradient's share of the second colour is dot(slope, pixel centre) + start.
    slope: vec2f,
    start: f32,
    // Side of a square, pixels.
    square: f32,
    // Position in the picture, in its pixels, is pixel centre * picture_scale + picture_offset.
    picture_scale: vec2f,
    picture_offset: vec2f,
    mode: u32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var image: texture_2d<f32>;
@group(0) @binding(2) var picture: texture_2d<f32>;
@group(0) @binding(3) var result: texture_storage_2d<rgba32float, write>;

// The picture at a position in its pixels, interpolated linearly; the first colour outside of it.
fn picture_at(position: vec2f) -> vec4f {
    let size = vec2f(textureDimensions(picture));
    if any(position < vec2f(0.0)) || any(position >= size) {
        return parameters.first;
    }
    let last = vec2i(size) - 1;
    let corner = floor(position - 0.5);
    let share = position - 0.5 - corner;
    let low = clamp(vec2i(corner), vec2i(0), last);
    let high = clamp(vec2i(corner) + 1, vec2i(0), last);
    let top = mix(textureLoad(picture, low, 0), textureLoad(picture, vec2i(high.x, low.y), 0), share.x);
    let bottom = mix(textureLoad(picture, vec2i(low.x, high.y), 0), textureLoad(picture, high, 0), share.x);
    let behind = parameters.first;
    return over(mix(top, bottom, share.y), behind);
}

fn background_at(center: vec2f) -> vec4f {
    switch parameters.mode {
        case COLOR: {
            return parameters.first;
        }
        case GRADIENT: {
            let share = clamp(dot(parameters.slope, center) + parameters.start, 0.0, 1.0);
            return mix(parameters.first, parameters.second, share);
        }
        case CHECKERBOARD: {
            let square = vec2i(floor(center / parameters.square));
            return select(parameters.first, parameters.second, ((square.x + square.y) & 1) == 1);
        }
        default: {
            return picture_at(center * parameters.picture_scale + parameters.picture_offset);
        }
    }
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result)) {
        return;
    }
    let front = texel_at(image, id.xy);
    textureStore(result, id.xy, over(front, background_at(vec2f(id.xy) + 0.5)));
}
