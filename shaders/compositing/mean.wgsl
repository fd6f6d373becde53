//! slot: compositing
//! label: Mean
//! help: The mean value along the ray, each sample weighted with its segment's length, classified over one reference length. No depth.
//! reads: classify_value
//! forbids: classification reads previous -- the mean has no previous sample
//! forbids: classification = labels -- a mean of values has no place and so no label

struct State {
    sum: f32,
    length: f32,
}

fn begin() -> State {
    return State(0.0, 0.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    (*state).sum += s.value * s.length;
    (*state).length += s.length;
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    if state.length <= 0.0 {
        return Result(vec4f(0.0), -1.0);
    }
    return Result(absorb(classify_value(state.sum / state.length), 1.0), -1.0);
}
