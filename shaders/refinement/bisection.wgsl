//! slot: refinement
//! label: Bisection
//! help: Halves the interval again and again: the error is the step divided by 2 to the number of halvings.
//! param halvings: u32 = 8 [1, 24] -- number of halvings, one sample each

fn refine(ray: Ray, a: f32, b: f32, fa: f32, fb: f32, isovalue: f32) -> f32 {
    var low = a;
    var high = b;
    for (var i = 0u; i < params.halvings; i++) {
        let middle = 0.5 * (low + high);
        let inside = value_at(position_along(ray, middle)) - isovalue >= 0.0;
        if inside == (fa >= 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}
