// Direct volume rendering written by hand, with the maths of the assembled loop and nothing else.
// The yardstick for the assembled shader: same samples, same table, same arithmetic.

struct Scene {
    volume_to_world: mat3x3f,
    depth_plane: vec4f,
    dims: vec3f,
    rate: f32,
    image_size: vec2u,
    texel_scale: f32,
    texel_offset: f32,
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(0) @binding(1) var volume: texture_3d<f32>;
@group(0) @binding(2) var linear: sampler;
@group(0) @binding(3) var entries: texture_2d<f32>;
@group(0) @binding(4) var exits: texture_2d<f32>;
@group(0) @binding(5) var table: texture_2d<f32>;
@group(0) @binding(6) var color: texture_storage_2d<rgba32float, write>;
@group(0) @binding(7) var depth: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn dvr(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= scene.image_size) {
        return;
    }
    let entry = textureLoad(entries, id.xy, 0);
    let exit = textureLoad(exits, id.xy, 0);
    let chord = exit.xyz - entry.xyz;
    let length_in_world = length(scene.volume_to_world * chord);
    let steps = max(length(chord * scene.dims) * scene.rate, 1e-6);
    let step = chord / steps;
    let step_length = length_in_world / steps;
    var count = max(1u, u32(ceil(steps - 1e-4)));
    if entry.w < 0.5 || exit.w < 0.5 || length_in_world <= 0.0 {
        count = 0u;
    }
    let last = i32(textureDimensions(table).x) - 1;
    var result = vec4f(0.0);
    var first = -1.0;
    for (var i = 0u; i < count; i++) {
        let start = f32(i);
        let span = select(1.0, steps - start, i + 1u == count);
        let along = start + 0.5 * span;
        let value = textureSampleLevel(volume, linear, entry.xyz + step * along, 0.0).x * scene.texel_scale + scene.texel_offset;
        let u = clamp(value, 0.0, 1.0) * f32(last);
        let k = min(i32(u), last - 1);
        let medium = mix(textureLoad(table, vec2i(k, 0), 0), textureLoad(table, vec2i(k + 1, 0), 0), u - f32(k));
        let distance = span * step_length;
        let x = medium.w * distance;
        let small = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))));
        let safe = max(x, 0.25);
        let factor = distance * select(small, (1.0 - exp(-safe)) / safe, x > 0.25);
        result += (1.0 - result.w) * (medium * factor);
        first = select(first, along, first < 0.0 && medium.w > 0.0);
    }
    textureStore(color, id.xy, result);
    let z = dot(scene.depth_plane, vec4f(entry.xyz + step * first, 1.0));
    textureStore(depth, id.xy, vec4f(select(z, 3.0e38, first < 0.0)));
}
