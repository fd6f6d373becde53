// How much two images of one size differ, as 8-bit colours for a screen. One invocation a pixel.

struct Parameters {
    // What differences are multiplied with.
    gain: f32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var first: texture_2d<f32>;
@group(0) @binding(2) var second: texture_2d<f32>;
@group(0) @binding(3) var result: texture_storage_2d<rgba8unorm, write>;

const NOT_A_NUMBER = vec3f(1.0, 0.0, 1.0);

// WGSL may assume that NaN and infinity do not occur; their bits tell.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result)) {
        return;
    }
    let difference = textureLoad(first, id.xy, 0) - textureLoad(second, id.xy, 0);
    let finite = is_finite(difference.x) && is_finite(difference.y) && is_finite(difference.z) && is_finite(difference.w);
    // A difference of opacity alone is a grey.
    let color = max(abs(difference.rgb), vec3f(abs(difference.a) * 0.5)) * parameters.gain;
    textureStore(result, id.xy, vec4f(select(NOT_A_NUMBER, min(color, vec3f(1.0)), finite), 1.0));
}
