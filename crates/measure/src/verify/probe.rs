//! Texts of compositing snippets that show what the ray loop reads at the first sample of a ray, unclassified. With
//! `max_samples` 1 that is the middle of the ray, so that reconstruction can be judged point by point.

/// The normalised value, in red, green and blue; opacity 1.
pub const VALUE: &str = "//! slot: compositing
//! help: The normalised value at the first sample.
//! terminates: hit
struct State { shown: vec4f }
fn begin() -> State { return State(vec4f(0.0)); }
fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if (*state).shown.w == 0.0 { (*state).shown = vec4f(vec3f(s.value), 1.0); }
}
fn done(state: State) -> bool { return state.shown.w > 0.0; }
fn finish(state: State, ray: Ray) -> Result { return Result(state.shown, -1.0); }
";

/// The gradient in world directions, normalised values a mean voxel spacing, as red, green and blue; opacity 1.
pub const GRADIENT: &str = "//! slot: compositing
//! help: The gradient at the first sample.
//! reads: gradient
//! terminates: hit
struct State { shown: vec4f }
fn begin() -> State { return State(vec4f(0.0)); }
fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    if (*state).shown.w == 0.0 { (*state).shown = vec4f(s.gradient, 1.0); }
}
fn done(state: State) -> bool { return state.shown.w > 0.0; }
fn finish(state: State, ray: Ray) -> Result { return Result(state.shown, -1.0); }
";
