//! slot: refinement
//! label: Secant
//! help: Follows the straight line between the ends of the interval and keeps the half that holds the crossing (Illinois false position): a few samples reach float precision.
//! param steps: u32 = 3 [1, 16] -- number of samples

fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32 {
    var low = a;
    var high = b;
    var f_low = fa;
    var f_high = fb;
    var was_before = false;
    for (var i = 0u; i < params.steps; i++) {
        let t = mix(low, high, clamp(f_low / (f_low - f_high), 0.0, 1.0));
        let f = value_at(position_along(ray, t)) - isovalue;
        let before = (f >= 0.0) == (f_low >= 0.0);
        // An end that two steps in a row have kept is given half its weight, or false position would creep.
        let weight = select(1.0, 0.5, i > 0u && before == was_before);
        if before {
            low = t;
            f_low = f;
            f_high *= weight;
        } else {
            high = t;
            f_high = f;
            f_low *= weight;
        }
        was_before = before;
    }
    return mix(low, high, clamp(f_low / (f_low - f_high), 0.0, 1.0));
}
