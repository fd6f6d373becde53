// Smallest, largest and mean value of each channel of an image and of its depth, and how many pixels are not numbers or out
// of range. Every workgroup writes one summary of the pixels that it strides over; the few summaries are merged on the CPU.

const THREADS = 128u;
const GROUPS = 64u;
const MISS = 3.0e38;

struct Parameters {
    // 1: the image has depth.
    depth: u32,
    // 1: values outside of 0 to 1 are out of range.
    bounded: u32,
    // 1: only pixels with a positive fourth channel count (coordinates of hits).
    hits_only: u32,
}

// Channels 0 to 3, then depth.
struct Summary {
    smallest: array<f32, 5>,
    largest: array<f32, 5>,
    sum: array<f32, 5>,
    count: array<u32, 5>,
    not_finite: u32,
    out_of_range: u32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var image: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_2d<f32>;
@group(0) @binding(3) var<storage, read_write> result: array<Summary, 64>;

var<workgroup> partial: array<Summary, 128>;

// WGSL may assume that NaN and infinity do not occur; their bits tell.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

fn take(into: ptr<function, Summary>, channel: u32, value: f32) {
    (*into).smallest[channel] = min((*into).smallest[channel], value);
    (*into).largest[channel] = max((*into).largest[channel], value);
    (*into).sum[channel] += value;
    (*into).count[channel] += 1u;
}

fn take_pixel(into: ptr<function, Summary>, pixel: vec2u) {
    let texel = textureLoad(image, pixel, 0);
    let hit = parameters.hits_only == 0u || texel.w > 0.0;
    var all_finite = true;
    var in_range = true;
    for (var channel = 0u; channel < 4u; channel++) {
        let value = texel[channel];
        if !is_finite(value) {
            all_finite = false;
        } else if hit || channel == 3u {
            take(into, channel, value);
            in_range = in_range && value >= -1e-5 && value <= 1.00001;
        }
    }
    if parameters.depth == 1u {
        let distance = textureLoad(depth, pixel, 0).x;
        if !is_finite(distance) {
            all_finite = false;
        } else if distance < MISS {
            take(into, 4u, distance);
        }
    }
    (*into).not_finite += select(1u, 0u, all_finite);
    (*into).out_of_range += select(1u, 0u, in_range || parameters.bounded == 0u);
}

fn merge(into: u32, other: u32) {
    for (var channel = 0u; channel < 5u; channel++) {
        partial[into].smallest[channel] = min(partial[into].smallest[channel], partial[other].smallest[channel]);
        partial[into].largest[channel] = max(partial[into].largest[channel], partial[other].largest[channel]);
        partial[into].sum[channel] += partial[other].sum[channel];
        partial[into].count[channel] += partial[other].count[channel];
    }
    partial[into].not_finite += partial[other].not_finite;
    partial[into].out_of_range += partial[other].out_of_range;
}

@compute @workgroup_size(128)
fn main(@builtin(local_invocation_index) thread: u32, @builtin(workgroup_id) group: vec3u) {
    var mine: Summary;
    for (var channel = 0u; channel < 5u; channel++) {
        mine.smallest[channel] = MISS;
        mine.largest[channel] = -MISS;
    }
    let size = textureDimensions(image);
    for (var index = group.x * THREADS + thread; index < size.x * size.y; index += GROUPS * THREADS) {
        take_pixel(&mine, vec2u(index % size.x, index / size.x));
    }
    partial[thread] = mine;
    for (var reach = THREADS / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if thread < reach {
            merge(thread, thread + reach);
        }
    }
    if thread == 0u {
        result[group.x] = partial[0];
    }
}
