//! slot: compositing
//! label: Direct volume rendering
//! help: Emission and absorption, front to back. Depth: the first visible sample.
//! reads: medium
//! terminates: opacity
//! empty: transparent

struct State {
    color: vec4f,
#if long_rays
    /// The latest samples, as long as they are faint beside the colour.
    faint: vec4f,
#endif
    first: f32,
}

fn begin() -> State {
    var state: State;
    state.first = -1.0;
    return state;
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    let color = (*state).color;
#if long_rays
    // Faint samples are summed up on their own first: added one by one, each would be rounded to the places of the whole.
    let faint = (*state).faint + (1.0 - color.w - (*state).faint.w) * absorb(s.medium, s.length);
    let enough = faint.w * 64.0 >= color.w;
    (*state).color = select(color, color + faint, enough);
    (*state).faint = select(faint, vec4f(0.0), enough);
#else
    (*state).color = color + (1.0 - color.w) * absorb(s.medium, s.length);
#endif
    (*state).first = select((*state).first, s.distance, (*state).first < 0.0 && s.medium.w > 0.0);
}

fn done(state: State) -> bool {
#if long_rays
    return state.color.w + state.faint.w >= frame.termination_opacity;
#else
    return state.color.w >= frame.termination_opacity;
#endif
}

fn finish(state: State, ray: Ray) -> Result {
#if long_rays
    return Result(state.color + state.faint, state.first);
#else
    return Result(state.color, state.first);
#endif
}
