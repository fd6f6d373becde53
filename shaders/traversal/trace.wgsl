/// One sample as the ray probe notes it. Mirrored by the host.
struct Traced {
    /// Number of the sample on its ray.
    index: u32,
    /// Its distance on the ray.
    distance: f32,
    /// Length of the sample's segment in reference lengths.
    length: f32,
    /// Normalised value of the selected channel.
    value: f32,
    /// World-space gradient, normalised value a mean voxel spacing.
    gradient: vec4f,
    /// (emission, extinction) before and after shading.
    classified: vec4f,
    shaded: vec4f,
    /// What each output would be if the ray ended after this sample's segment.
    accumulated: array<vec4f, 3>,
}

/// One ray. The host says which; the shader notes the rest. Mirrored by the host.
struct Trace {
    pixel: vec2u,
    /// Samples taken; those beyond the length of `samples` are not noted.
    taken: u32,
    /// 1 when further samples could no longer matter and the ray was left early.
    stopped: u32,
    origin: vec3f,
    first: u32,
    direction: vec3f,
    last: u32,
    begin: f32,
    end: f32,
    step: f32,
    shift: f32,
    /// The pixel of each output, and the distance of its depth on the ray (x, y, z).
    results: array<vec4f, 3>,
    places: vec4f,
    samples: array<Traced>,
}
@group(0) @binding(auto) var<storage, read_write> trace: Trace;

fn trace_ray(ray: Ray) {
    trace.origin = ray.origin;
    trace.direction = ray.direction;
    trace.first = u32(ray.first);
    trace.last = u32(ray.last);
    trace.begin = ray.begin;
    trace.end = ray.end;
    trace.step = frame.step;
    trace.shift = ray.shift;
}

/// Notes a sample.
fn trace_sample(ray: Ray, s: Sample, index: f32) {
    let at = trace.taken;
    trace.taken = at + 1u;
    if at >= arrayLength(&trace.samples) {
        return;
    }
    var traced: Traced;
    traced.index = u32(index);
    traced.distance = s.distance;
    traced.length = s.length;
    traced.value = s.value;
#if gradient
    traced.gradient = vec4f(world_gradient(s.position, s.voxel), 0.0);
#endif
#if medium
    traced.classified = classify(s);
    traced.shaded = s.medium;
#else
#if medium_at
    // Nothing is classified in the loop; this is what the sample would be.
    var point = s;
    point.previous = s.value;
    traced.classified = classify(point);
    traced.shaded = medium_at(ray, s.distance);
#else
#if classify_value
    traced.classified = classify_value(s.value);
    traced.shaded = traced.classified;
#endif
#endif
#endif
    trace.samples[at] = traced;
}

/// Whether the last sample taken was noted.
fn trace_has_room() -> bool {
    return trace.taken > 0u && trace.taken <= arrayLength(&trace.samples);
}

fn trace_accumulated(output: u32, color: vec4f) {
    if trace_has_room() {
        trace.samples[trace.taken - 1u].accumulated[output] = color;
    }
}

/// The ray as if it ended before sample `index`.
fn ray_until(ray: Ray, index: f32) -> Ray {
    var part = ray;
    if index < ray.last {
        part.last = index;
        part.end = (index - ray.shift) * frame.step;
    }
    return part;
}

fn trace_result(output: u32, result: Result) {
    trace.results[output] = result.color;
    trace.places[output] = result.distance;
}
