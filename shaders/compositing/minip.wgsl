//! slot: compositing
//! label: Minimum intensity projection
//! help: The smallest value on the ray, classified over one reference length. Depth: where it is.
//! reads: medium_at
//! forbids: classification reads previous -- a minimum is a point, not a segment

struct State {
    value: f32,
    distance: f32,
}

fn begin() -> State {
    return State(3.0e38, -1.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if s.value < (*state).value {
        *state = State(s.value, s.distance);
    }
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.distance < 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    return Result(absorb(medium_at(ray, state.distance), 1.0), state.distance);
}
