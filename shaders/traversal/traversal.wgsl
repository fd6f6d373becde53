//! The ray traversal: walks every ray from its entry to its exit point and combines what it finds into pixels.
//!
//! Coordinates. Volume coordinates run from 0 to 1 across the volume's box. Positions along a ray are counted in
//! sample steps from the entry point. Lengths are counted in reference lengths, the unit of a transfer function's
//! opacity. Values are normalised: 0 and 1 are the ends of the data range.
//! Where there are no values (NaN voxels, and all that interpolation with them touches) there are no samples.
//! Samples sit on one lattice a ray, at the middle of segments 0, 1, 2, ...; the last segment is shortened.
//! A medium is (emission, extinction): rgb is colour times extinction, w the extinction a reference length.
//!
//! slot skipping:
//! fn skip_empty(ray: Ray, index: u32) -> u32
//!   index: number of the next sample. Result: the first sample at or after it that may contribute.
//! slot sampling:
//! fn sample_volume(p: vec3f) -> vec4f
//!   p: volume coordinates. Result: the stored texel values at p, all channels.
//! slot gradient:
//! fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f
//!   p: volume coordinates; voxel: the sample there. Result: change of the normalised value a voxel, along the three voxel axes.
//! slot classification:
//! fn classify(s: Sample) -> vec4f
//!   Result: the medium (emission, extinction) at the sample, or its mean between the previous sample and this one.
//! slot shading:
//! fn shade(medium: vec4f, surface: Surface) -> vec4f
//!   medium: (emission, extinction); surface: unit vectors in world space. Result: the lit medium, extinction unchanged.
//! slot refinement:
//! fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32
//!   a, b: steps before and after a crossing; fa, fb: value minus isovalue there. Result: steps at the crossing.
//! slot compositing:
//! struct State
//!   What one output remembers along a ray.
//! fn begin() -> State
//!   The state before the first sample.
//! fn add(state: ptr<function, State>, ray: Ray, s: Sample)
//!   Takes in the next sample.
//! fn done(state: State) -> bool
//!   Whether further samples can no longer matter (within the error that early termination allows).
//! fn finish(state: State, ray: Ray) -> Result
//!   The pixel: premultiplied colour, and where it is on the ray for the depth image.

#include "traversal/types.wgsl"
#include "traversal/bindings.wgsl"
#parameters
#if bounded
#include "traversal/bounds.wgsl"
#endif
#include "traversal/ray.wgsl"
#include "traversal/medium.wgsl"
#snippet sampling
#include "traversal/values.wgsl"
#if gradient
#snippet gradient
#endif
#if slot_classification
#snippet classification
#endif
#if shading
#snippet shading
#endif
#include "traversal/evaluate.wgsl"
#if slot_refinement
#snippet refinement
#endif
#if skipping
#snippet skipping
#endif
#each output
#snippet compositing
#end
#if trace
#include "traversal/trace.wgsl"

@compute @workgroup_size(1)
fn traverse() {
    let id = vec3u(trace.pixel, 0u);
#else

@compute @workgroup_size(8, 8)
fn traverse(@builtin(global_invocation_id) invocation: vec3u) {
    let id = invocation + vec3u(0u, frame.first_row, 0u);
#endif
    if any(id.xy >= frame.image_size) {
        return;
    }
    let ray = ray_through(id.xy);
#if trace
    trace_ray(ray);
#endif
#each output
    var OUT_state = OUT_begin();
#end
#if counting
    var taken = 0u;
    var contributing = 0u;
#endif
#if previous
    var previous = 0.0;
    var previous_along = 0.0;
    if ray.count > 0u {
        previous = value_at(ray.entry);
    }
#if gaps
    var after_gap = in_gap(ray.entry);
#endif
#endif
    var index = 0u;
    while index < ray.count {
#if search
        // Find the next visible sample before shading it: rays of a group shade together.
        var s: Sample;
        var visible = false;
        while index < ray.count && !visible {
#if skipping
#if own
            index = max(index, skip_empty(ray, index));
#else
            index = skip_empty(ray, index);
#endif
            if index >= ray.count {
                break;
            }
#endif
            s = sample_ray(ray, index);
#if loop_gradient
            s.gradient = world_gradient(s.position, s.voxel);
#endif
            s.medium = classify(s);
            visible = s.medium.w > 0.0;
#if gaps
            visible = visible && !in_gap(s.position);
#endif
#if trace
#if gaps
            if !in_gap(s.position) {
                trace_sample(ray, s, index);
            }
#else
            trace_sample(ray, s, index);
#endif
#each output
            trace_accumulated(OUT_INDEX, OUT_finish(OUT_state, ray_until(ray, index + 1u)).color);
#end
#endif
            index += 1u;
#if counting
            taken += 1u;
#endif
        }
        if !visible {
            break;
        }
        s.medium = lit(s.medium, ray, s.position, s.voxel, frame.light_direction);
#else
#if skipping
#if own
        index = max(index, skip_empty(ray, index));
#else
        index = skip_empty(ray, index);
#endif
        if index >= ray.count {
            break;
        }
#endif
        var s = sample_ray(ray, index);
#if gaps
        if in_gap(s.position) {
            index += 1u;
#if previous
            previous_along = s.along;
            after_gap = true;
#endif
#if counting
            taken += 1u;
#endif
            continue;
        }
#endif
#if previous
        s.previous = previous;
        s.previous_along = previous_along;
#if gaps
        // Nothing is known of what lies between: no surface is crossed, and the value stands for the segment.
        s.previous = select(previous, s.value, after_gap);
        after_gap = false;
#endif
#endif
#if loop_gradient
        s.gradient = world_gradient(s.position, s.voxel);
#endif
#if medium
        s.medium = classify(s);
#endif
#if trace
        trace_sample(ray, s, index);
#endif
#if medium
#if shading
        if s.medium.w > 0.0 {
            s.medium = lit(s.medium, ray, s.position, s.voxel, frame.light_direction);
        }
#endif
#endif
        index += 1u;
#if previous
        previous = s.value;
        previous_along = s.along;
#endif
#if counting
        taken += 1u;
#endif
#endif
#if counting
        contributing += select(0u, 1u, contributes(s));
#endif
#each output
        OUT_add(&OUT_state, ray, s);
#if trace
        trace_accumulated(OUT_INDEX, OUT_finish(OUT_state, ray_until(ray, index)).color);
#endif
#end
#if trace
#if medium
        trace_shaded(s.medium);
#endif
#endif
#if stop
        var open = false;
#each output
        open = open || !OUT_done(OUT_state);
#end
        if !open {
#if trace
            trace.stopped = 1u;
#endif
            break;
        }
#endif
    }
#each output
    var OUT_result = Result(vec4f(0.0), -1.0);
    if ray.count > 0u {
        OUT_result = OUT_finish(OUT_state, ray);
    }
#if trace
    trace_result(OUT_INDEX, OUT_result);
#else
    textureStore(OUT_color, id.xy, OUT_result.color);
    textureStore(OUT_depth, id.xy, vec4f(depth_along(ray, OUT_result.along)));
#endif
#end
#if statistics
    count_samples(ray, taken, contributing);
#endif
#if sample_map
    let met = select(0.0, 1.0, ray.count > 0u);
    textureStore(sample_map, id.xy, vec4f(f32(taken), f32(contributing), 0.0, met));
#endif
}
