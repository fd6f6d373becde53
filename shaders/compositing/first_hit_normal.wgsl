//! slot: compositing
//! label: First-hit normal
//! help: Unit normal (against the gradient, world space) at the first visible sample, each component n stored as n / 2 + 1 / 2; where the gradient vanishes the normal is zero.
//! reads: medium, gradient
//! terminates: hit
//! empty: transparent
//! forbids: classification reads previous -- a hit is a point, not a segment

struct State {
    distance: f32,
    gradient: vec3f,
}

fn begin() -> State {
    return State(-1.0, vec3f(0.0));
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if (*state).distance < 0.0 && s.medium.w > 0.0 {
        *state = State(s.distance, s.gradient);
    }
}

fn done(state: State) -> bool {
    return state.distance >= 0.0;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.distance < 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    return Result(vec4f(0.5 - 0.5 * state.gradient / max(length(state.gradient), 1e-20), 1.0), state.distance);
}
