//! slot: compositing
//! label: Maximum opacity
//! help: The sample of greatest opacity on the ray, over one reference length. Depth: where it is.
//! reads: medium
//! empty: transparent

struct State {
    medium: vec4f,
    distance: f32,
}

fn begin() -> State {
    return State(vec4f(0.0), -1.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if s.medium.w > (*state).medium.w {
        *state = State(s.medium, s.distance);
    }
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    return Result(absorb(state.medium, 1.0), state.distance);
}
