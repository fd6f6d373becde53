//! slot: compositing
//! label: Isosurface
//! help: The first surface on which the value is the isovalue, opaque. It is refined, shaded and coloured once, after the loop. Depth: the surface.
//! reads: previous, refinement, surface
//! terminates: hit
//! empty: no_crossing isovalue
//! forbids: classification reads previous -- a surface has no thickness to integrate over
//! param isovalue: f32 = 0.5 [-1e30, 1e30] unit data -- value of the surface
//! param color: color = 0.9, 0.85, 0.75 -- colour of the surface

struct State {
    found: bool,
    a: f32,
    b: f32,
    fa: f32,
    fb: f32,
}

fn begin() -> State {
    return State(false, 0.0, 0.0, 0.0, 0.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    let fa = s.previous - params.isovalue;
    let fb = s.value - params.isovalue;
    // A value equal to the isovalue is inside: plateaus give one surface.
    if !(*state).found && (fa >= 0.0) != (fb >= 0.0) {
        *state = State(true, s.previous_distance, s.distance, fa, fb);
    }
}

fn done(state: State) -> bool {
    return state.found;
}

fn finish(state: State, ray: Ray) -> Result {
    var last = state;
    if !last.found {
        add(&last, ray, last_stretch(ray));
    }
    if !last.found {
        return Result(vec4f(0.0), -1.0);
    }
    let distance = refine(ray, last.a, last.b, last.fa, last.fb, params.isovalue);
    return Result(surface_at(ray, distance, params.color), distance);
}
