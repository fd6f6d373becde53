//! slot: compositing
//! label: Isosurface in a volume
//! help: Direct volume rendering with a translucent isosurface in it. The segment that holds the surface is split there, so the medium before and behind it gets its own length. Depth: the first of the two.
//! reads: medium, previous, refinement, surface
//! terminates: opacity
//! empty: transparent and no_crossing isovalue
//! forbids: classification reads previous -- the surface splits segments that a pre-integrated table cannot split
//! param isovalue: f32 = 0.5 [-1e30, 1e30] unit data -- value of the surface
//! param color: color = 0.9, 0.85, 0.75 -- colour of the surface
//! param opacity: f32 = 0.8 [0, 1] -- opacity of the surface

struct State {
    color: vec4f,
    first: f32,
    /// Medium and place of the last sample; the stretch up to the next is their mean.
    medium: vec4f,
    distance: f32,
}

fn begin() -> State {
    return State(vec4f(0.0), -1.0, vec4f(-1.0), 0.0);
}

fn blend(state: ptr<function, State>, color: vec4f, distance: f32) {
    (*state).color += (1.0 - (*state).color.w) * color;
    (*state).first = select((*state).first, distance, (*state).first < 0.0 && color.w > 0.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    // Before the first sample the medium is taken to be that of the sample.
    let front = select((*state).medium, s.medium, (*state).medium.w < 0.0);
    let start = select((*state).distance, ray.begin, (*state).medium.w < 0.0);
    let fa = s.previous - params.isovalue;
    let fb = s.value - params.isovalue;
    var cut = s.distance;
    let crossed = (fa >= 0.0) != (fb >= 0.0);
    if crossed {
        cut = refine(ray, s.previous_distance, s.distance, fa, fb, params.isovalue);
    }
    let mean = 0.5 * (front + s.medium);
    blend(state, absorb(mean, (cut - start)), start);
    if crossed {
        blend(state, params.opacity * surface_at(ray, cut, params.color), cut);
        blend(state, absorb(mean, (s.distance - cut)), cut);
    }
    (*state).medium = s.medium;
    (*state).distance = s.distance;
}

fn done(state: State) -> bool {
    return state.color.w >= frame.termination_opacity;
}

fn finish(state: State, ray: Ray) -> Result {
    var last = state;
    if !done(last) {
        // Behind the last sample the medium is taken to be that of the sample; clear where every sample was skipped.
        var s = last_stretch(ray);
        s.medium = max(last.medium, vec4f(0.0));
        add(&last, ray, s);
    }
    return Result(last.color, last.first);
}
