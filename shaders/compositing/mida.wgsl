//! slot: compositing
//! label: Maximum intensity difference accumulation
//! help: Between direct volume rendering (gamma -1), MIDA (0) and maximum intensity projection (1): new maxima shine through what is in front (Bruckner and Groeller 2009). Depth: the largest value.
//! reads: medium, medium_at
//! forbids: classification reads previous -- a maximum is a point, not a segment
//! param gamma: f32 = 0 [-1, 1] -- -1 direct volume rendering, 0 MIDA, 1 maximum intensity projection

struct State {
    color: vec4f,
    maximum: f32,
    distance: f32,
}

fn begin() -> State {
    return State(vec4f(0.0), 0.0, -1.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    let rise = max(s.value - (*state).maximum, 0.0);
    let keep = 1.0 - rise * (1.0 + min(params.gamma, 0.0));
    let color = keep * (*state).color;
    (*state).color = color + (1.0 - color.w) * absorb(s.medium, s.length);
    if rise > 0.0 || (*state).distance < 0.0 {
        (*state).maximum = max(s.value, (*state).maximum);
        (*state).distance = s.distance;
    }
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.distance < 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    // Two accumulators, mixed once: the mixture never feeds back into the accumulation.
    let projection = absorb(medium_at(ray, state.distance), 1.0);
    return Result(mix(state.color, projection, max(params.gamma, 0.0)), state.distance);
}
