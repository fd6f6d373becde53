//! slot: compositing
//! label: First-hit point
//! help: Volume coordinates of the first visible sample as red, green and blue. Depth: that sample.
//! reads: medium
//! terminates: hit
//! empty: transparent
//! forbids: classification reads previous -- a hit is a point, not a segment

struct State {
    distance: f32,
}

fn begin() -> State {
    return State(-1.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if (*state).distance < 0.0 && s.medium.w > 0.0 {
        *state = State(s.distance);
    }
}

fn done(state: State) -> bool {
    return state.distance >= 0.0;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.distance < 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    return Result(vec4f(position_along(ray, state.distance), 1.0), state.distance);
}
