//! slot: compositing
//! label: Direct volume rendering
//! help: Emission and absorption, front to back. Depth: the first visible sample.
//! reads: medium
//! terminates: opacity
//! empty: transparent

struct State {
    color: vec4f,
    first: f32,
}

fn begin() -> State {
    return State(vec4f(0.0), -1.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    let color = (*state).color;
    (*state).color = color + (1.0 - color.w) * absorb(s.medium, s.length);
    (*state).first = select((*state).first, s.along, (*state).first < 0.0 && s.medium.w > 0.0);
}

fn done(state: State) -> bool {
    return state.color.w >= frame.termination_opacity;
}

fn finish(state: State, ray: Ray) -> Result {
    return Result(state.color, state.first);
}
