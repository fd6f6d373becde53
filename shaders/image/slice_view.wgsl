// A plane through a volume. One invocation a pixel.

const NEAREST: u32 = 1u;

struct Parameters {
    // Volume coordinates (0 to 1 in the box) = origin + pixel centre . (per_x, per_y).
    origin: vec4f,
    per_x: vec4f,
    per_y: vec4f,
    // Normalised value = texel * scale + offset.
    scale: vec4f,
    offset: vec4f,
    channel: u32,
    interpolation: u32,
    // 1: colours are shown without their opacity.
    is_opaque: u32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var volume: texture_3d<f32>;
// One row: extinction times red, green and blue, extinction; per reference length, over the normalised value.
@group(0) @binding(2) var table: texture_2d<f32>;
@group(0) @binding(3) var result: texture_storage_2d<rgba32float, write>;

fn voxel(index: vec3i) -> f32 {
    let last = vec3i(textureDimensions(volume)) - 1;
    return textureLoad(volume, clamp(index, vec3i(0), last), 0)[parameters.channel];
}

// The texel value at a position in voxels (centres at integers), trilinear in full precision.
fn sample(position: vec3f) -> f32 {
    if parameters.interpolation == NEAREST {
        return voxel(vec3i(floor(position + 0.5)));
    }
    let corner = floor(position);
    let share = position - corner;
    let i = vec3i(corner);
    let y0 = mix(mix(voxel(i), voxel(i + vec3i(1, 0, 0)), share.x),
                 mix(voxel(i + vec3i(0, 1, 0)), voxel(i + vec3i(1, 1, 0)), share.x), share.y);
    let y1 = mix(mix(voxel(i + vec3i(0, 0, 1)), voxel(i + vec3i(1, 0, 1)), share.x),
                 mix(voxel(i + vec3i(0, 1, 1)), voxel(i + vec3i(1, 1, 1)), share.x), share.y);
    return mix(y0, y1, share.z);
}

// Emission times extinction and extinction at a normalised value.
fn medium(value: f32) -> vec4f {
    let last = textureDimensions(table).x - 1u;
    let position = clamp(value, 0.0, 1.0) * f32(last);
    let low = min(u32(position), last - 1u);
    return mix(textureLoad(table, vec2u(low, 0u), 0), textureLoad(table, vec2u(low + 1u, 0u), 0), position - f32(low));
}

// What the classified value looks like: one reference length of it, or its colour alone.
fn shown(medium: vec4f) -> vec4f {
    if medium.a <= 0.0 {
        return vec4f(0.0);
    }
    let color = medium.rgb / medium.a;
    let opacity = select(1.0 - exp(-medium.a), 1.0, parameters.is_opaque == 1u);
    return vec4f(color * opacity, opacity);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(result)) {
        return;
    }
    let center = vec2f(id.xy) + 0.5;
    let place = parameters.origin.xyz + center.x * parameters.per_x.xyz + center.y * parameters.per_y.xyz;
    var color = vec4f(0.0);
    if all(place >= vec3f(0.0)) && all(place <= vec3f(1.0)) {
        let texel = sample(place * vec3f(textureDimensions(volume)) - 0.5);
        color = shown(medium(texel * parameters.scale[parameters.channel] + parameters.offset[parameters.channel]));
    }
    textureStore(result, id.xy, color);
}
