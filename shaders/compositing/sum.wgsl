//! slot: compositing
//! label: Sum
//! help: The integral of the normalised value along the ray times a gain, classified over one reference length: like an X-ray film. No depth.
//! reads: classify_value
//! forbids: classification reads previous -- the sum has no previous sample
//! forbids: classification = labels -- a sum of values has no place and so no label
//! param gain: f32 = 0.01 [0, 1000] unit 1/reference -- factor of the integral

struct State {
    sum: f32,
}

fn begin() -> State {
    return State(0.0);
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    (*state).sum += s.value * s.length;
}

fn done(state: State) -> bool {
    return false;
}

fn finish(state: State, ray: Ray) -> Result {
    return Result(absorb(classify_value(params.gain * state.sum), 1.0), -1.0);
}
