//! The ray probe: walks the ray of one pixel as the ray traversal does, and notes every sample. It has the slots of the traversal,
//! and their contracts.
//!
//! slot skipping:
//! fn skip_empty(ray: Ray, index: f32) -> f32
//! slot sampling:
//! fn sample_volume(p: vec3f) -> vec4f
//! slot gradient:
//! fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f
//! slot classification:
//! fn classify(s: Sample) -> vec4f
//! slot shading:
//! fn shade(medium: vec4f, surface: Surface) -> vec4f
//! slot refinement:
//! fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32
//! slot compositing:
//! struct State
//! fn begin() -> State
//! fn add(state: ptr<function, State>, ray: Ray, s: Sample)
//! fn done(state: State) -> bool
//! fn finish(state: State, ray: Ray) -> Result
//! slot lattice:
//! fn lattice_shift(pixel: vec2u) -> f32
//! slot stepping:
//! fn find_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) -> bool
//! fn take_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>)
//! slot gaps:
//! fn in_gap(p: vec3f) -> bool
//! slot slope:
//! fn sample_gradient(s: Sample) -> vec3f
//! slot lighting:
//! fn lit(medium: vec4f, ray: Ray, p: vec3f, voxel: vec4f, facing: vec3f) -> vec4f
//! slot endings:
//! fn ray_ended(walk: Walk)
//! slot statistics:
//! fn count_ray(ray: Ray, walk: Walk)
//! slot sample_map:
//! fn map_ray(pixel: vec2u, ray: Ray, walk: Walk)

#include "traversal/parts.wgsl"
#include "traversal/trace.wgsl"
#each output
#snippet compositing
#end

@compute @workgroup_size(1)
fn traverse() {
    let ray = ray_through(trace.pixel);
    trace_ray(ray);
#each output
    var OUT_state = OUT_begin();
#end
    var walk = begin_walk(ray);
    var s: Sample;
    while find_sample(ray, &walk, &s) {
        take_sample(ray, &walk, &s);
        if !s.known {
            continue;
        }
        trace_sample(ray, s, walk.index - 1.0);
        var open = !MAY_STOP;
#each output
        OUT_add(&OUT_state, ray, s);
        open = open || !OUT_done(OUT_state);
        trace_accumulated(OUT_INDEX, OUT_finish(OUT_state, ray_until(ray, walk.index)).color);
#end
        if !open {
            trace.stopped = 1u;
            break;
        }
    }
#each output
    var OUT_result = Result(vec4f(0.0), -1.0);
    if ray.last > ray.first {
        OUT_result = OUT_finish(OUT_state, ray);
    }
    trace_result(OUT_INDEX, OUT_result);
#end
}
