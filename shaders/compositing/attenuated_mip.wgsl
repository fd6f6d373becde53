//! slot: compositing
//! label: Attenuated MIP
//! help: The largest value after dimming by what lies in front: value times exp(-attenuation x integral of the value so far), classified over one reference length. Depth: where it is.
//! reads: classify_value
//! forbids: classification reads previous -- a maximum is a point, not a segment
//! forbids: classification = labels -- a dimmed value has no label
//! param attenuation: f32 = 0.02 [0, 100] unit 1/reference -- how strongly values in front dim those behind; 0 is MIP

struct State {
    value: f32,
    distance: f32,
    sum: f32,
}

fn begin() -> State {
    return State(-3.0e38, -1.0, 0.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    // The integral up to the middle of this segment, so that the step size does not matter to first order.
    let depth = (*state).sum + 0.5 * s.value * s.length;
    let dimmed = s.value * exp(-params.attenuation * max(depth, 0.0));
    if dimmed > (*state).value {
        (*state).value = dimmed;
        (*state).distance = s.distance;
    }
    (*state).sum += s.value * s.length;
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.distance < 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    return Result(absorb(classify_value(state.value), 1.0), state.distance);
}
