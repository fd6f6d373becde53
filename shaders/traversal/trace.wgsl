/// One sample as the ray probe notes it. Mirrored by the host.
struct Traced {
    /// Number of the sample on its ray.
    index: u32,
    /// Steps from the entry point.
    along: f32,
    /// Length of the sample's segment in reference lengths.
    length: f32,
    /// Normalised value of the selected channel.
    value: f32,
    /// World-space gradient, normalised value a mean voxel spacing.
    gradient: vec4f,
    /// (emission, extinction) before and after shading.
    classified: vec4f,
    shaded: vec4f,
    /// What each output would be if the ray ended behind this sample's segment.
    accumulated: array<vec4f, 3>,
}

/// One ray. The host says which; the shader tells the rest. Mirrored by the host.
struct Trace {
    pixel: vec2u,
    /// Samples taken; those beyond the length of `samples` are not noted.
    taken: u32,
    /// 1 when further samples could no longer matter and the ray was left early.
    stopped: u32,
    entry: vec3f,
    count: u32,
    step: vec3f,
    steps: f32,
    /// The pixel of each output, and where its depth is on the ray (x, y, z, in steps).
    results: array<vec4f, 3>,
    places: vec4f,
    samples: array<Traced>,
}
@group(0) @binding(16) var<storage, read_write> trace: Trace;

fn trace_ray(ray: Ray) {
    trace.entry = ray.entry;
    trace.count = ray.count;
    trace.step = ray.step;
    trace.steps = ray.steps;
}

/// Notes a sample as it is before shading.
fn trace_sample(ray: Ray, s: Sample, index: u32) {
    let at = trace.taken;
    trace.taken = at + 1u;
    if at >= arrayLength(&trace.samples) {
        return;
    }
    var traced: Traced;
    traced.index = index;
    traced.along = s.along;
    traced.length = s.length;
    traced.value = s.value;
#if gradient
    traced.gradient = vec4f(world_gradient(s.position, s.voxel), 0.0);
#endif
#if medium
    traced.classified = s.medium;
    traced.shaded = s.medium;
#else
#if medium_at
    // Nothing is classified in the loop; this is what the sample would be.
    var point = s;
    point.previous = s.value;
#if classified_gradient
    point.gradient = traced.gradient.xyz;
#endif
    traced.classified = classify(point);
    traced.shaded = medium_at(ray, s.along);
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

fn trace_shaded(medium: vec4f) {
    if trace_has_room() {
        trace.samples[trace.taken - 1u].shaded = medium;
    }
}

fn trace_accumulated(output: u32, color: vec4f) {
    if trace_has_room() {
        trace.samples[trace.taken - 1u].accumulated[output] = color;
    }
}

/// The ray as if it ended behind its first `count` segments.
fn ray_until(ray: Ray, count: u32) -> Ray {
    var part = ray;
    if count < ray.count {
        part.count = count;
#if jitter
        part.steps = f32(count) - ray.shift;
#else
        part.steps = f32(count);
#endif
    }
    return part;
}

fn trace_result(output: u32, result: Result) {
    trace.results[output] = result.color;
    trace.places[output] = result.along;
}
