//! The ray traversal: walks every ray from its entry to its exit point and combines what it finds into pixels.
//!
//! Coordinates. Volume coordinates run from 0 to 1 across a volume's box. Places on a ray are world distances from where the
//! ray's line enters the volumes' boxes. All lengths are counted in reference lengths, the unit of a transfer function's opacity.
//! Values are normalised: 0 and 1 are the ends of the data range.
//! Samples sit on one lattice for each ray, at the middle of segments 0, 1, 2, ... of one length for the whole picture. Entry and
//! exit points cut a range of it, and shorten the segments that they cut; they never move the others.
//! Where there are no values (NaN voxels, and all that interpolation with them touches) there are no samples.
//! A medium is (emission, extinction): rgb is colour times extinction, w the extinction per reference length.
//! Where rays pass through several volumes, the functions of a slot that each of them has work on the data of their own.
//!
//! slot skipping:
//! fn skip_empty(ray: Ray, index: f32) -> f32
//!   index: number of the next sample, a whole one. Result: the first sample at or after it that may contribute.
//! slot sampling:
//! fn sample_volume(p: vec3f) -> vec4f
//!   p: volume coordinates. Result: the stored texel values at p, all channels.
//! slot gradient:
//! fn gradient_at(p: vec3f, voxel: vec4f) -> vec3f
//!   p: volume coordinates; voxel: the sample there. Result: change of the normalised value per voxel, along the three voxel axes.
//! slot classification:
//! fn classify(s: Sample) -> vec4f
//!   Result: the medium (emission, extinction) at the sample, or its mean between the previous sample and this one.
//! slot shading:
//! fn shade(medium: vec4f, surface: Surface) -> vec4f
//!   medium: (emission, extinction); surface: unit vectors in world space. Result: the lit medium, extinction unchanged.
//! slot refinement:
//! fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32
//!   a, b: distances before and after a crossing; fa, fb: value minus isovalue there. Result: the distance of the crossing.
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
//!   The pixel: premultiplied colour, and its distance on the ray for the depth image.
//!
//! The program fills these; what can be absent has a snippet that compiles to nothing.
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
#snippet statistics
#snippet sample_map
#each output
#snippet compositing
#if half_targets
@group(0) @binding(auto) var OUT_color: texture_storage_2d<rgba16float, write>;
#else
@group(0) @binding(auto) var OUT_color: texture_storage_2d<rgba32float, write>;
#endif
@group(0) @binding(auto) var OUT_depth: texture_storage_2d<r32float, write>;
#end

@compute @workgroup_size(8, 8)
fn traverse(@builtin(global_invocation_id) id: vec3u) {
    let pixel = id.xy + vec2u(0u, frame.first_row);
    if any(pixel >= frame.image_size) {
        return;
    }
    let ray = ray_through(pixel);
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
        var open = !MAY_STOP;
#each output
        OUT_add(&OUT_state, ray, s);
        open = open || !OUT_done(OUT_state);
#end
        if !open {
            walk.ended = true;
            break;
        }
    }
#each output
    var OUT_result = Result(vec4f(0.0), -1.0);
    if ray.last > ray.first {
        OUT_result = OUT_finish(OUT_state, ray);
    }
    textureStore(OUT_color, pixel, OUT_result.color);
    textureStore(OUT_depth, pixel, vec4f(stored_depth(ray, OUT_result.distance)));
#end
    ray_ended(walk);
    count_ray(ray, walk);
    map_ray(pixel, ray, walk);
}
