//! slot: classification
//! label: Threshold
//! help: One colour and opacity between two values, nothing outside.
//! visible: lower..upper
//! param lower: f32 = 0.5 [-1e30, 1e30] unit data -- lowest visible value
//! param upper: f32 = 1e30 [-1e30, 1e30] unit data -- highest visible value
//! param color: color = 1, 0.9, 0.8 -- colour of what is visible
//! param extinction: f32 = 1 [0, 100] unit 1/reference -- optical depth a reference length

fn classify(s: Sample) -> vec4f {
    let inside = s.value >= params.lower && s.value <= params.upper;
    return vec4f(params.color, 1.0) * select(0.0, params.extinction, inside);
}
