//! slot: compositing
//! label: Translucent isosurfaces
//! help: Up to three surfaces, composited in the order in which the ray meets them. An opacity of 0 turns a surface off. Depth: the first surface.
//! reads: previous, refinement, surface
//! terminates: opacity
//! empty: no_crossing isovalue_a isovalue_b isovalue_c
//! forbids: classification reads previous -- a surface has no thickness to integrate over
//! param isovalue_a: f32 = 0.3 [-1e30, 1e30] unit data -- value of the first surface
//! param color_a: color = 0.9, 0.6, 0.5 -- its colour
//! param opacity_a: f32 = 0.3 [0, 1] -- its opacity
//! param isovalue_b: f32 = 0.6 [-1e30, 1e30] unit data -- value of the second surface
//! param color_b: color = 0.9, 0.9, 0.8 -- its colour
//! param opacity_b: f32 = 0.6 [0, 1] -- its opacity
//! param isovalue_c: f32 = 0.9 [-1e30, 1e30] unit data -- value of the third surface
//! param color_c: color = 0.6, 0.8, 1.0 -- its colour
//! param opacity_c: f32 = 0 [0, 1] -- its opacity

struct State {
    color: vec4f,
    first: f32,
}

fn begin() -> State {
    return State(vec4f(0.0), -1.0);
}

fn cross_surface(state: ptr<function, State>, ray: Ray, s: Sample, isovalue: f32, color: vec3f, opacity: f32) {
    let fa = s.previous - isovalue;
    let fb = s.value - isovalue;
    if opacity > 0.0 && (fa >= 0.0) != (fb >= 0.0) {
        let distance = refine(ray, s.previous_distance, s.distance, fa, fb, isovalue);
        let behind = 1.0 - (*state).color.w;
        (*state).color += behind * opacity * surface_at(ray, distance, color);
        (*state).first = select((*state).first, distance, (*state).first < 0.0);
    }
}

fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    var isovalues = array<f32, 3>(params.isovalue_a, params.isovalue_b, params.isovalue_c);
    var colors = array<vec4f, 3>(vec4f(params.color_a, params.opacity_a), vec4f(params.color_b, params.opacity_b), vec4f(params.color_c, params.opacity_c));
    // Along rising values the ray meets the lowest isovalue first, along falling values the highest.
    let order = select(-1.0, 1.0, s.value >= s.previous);
    if order * (isovalues[1] - isovalues[0]) < 0.0 {
        swap_surfaces(&isovalues, &colors, 0, 1);
    }
    if order * (isovalues[2] - isovalues[1]) < 0.0 {
        swap_surfaces(&isovalues, &colors, 1, 2);
    }
    if order * (isovalues[1] - isovalues[0]) < 0.0 {
        swap_surfaces(&isovalues, &colors, 0, 1);
    }
    cross_surface(state, ray, s, isovalues[0], colors[0].rgb, colors[0].a);
    cross_surface(state, ray, s, isovalues[1], colors[1].rgb, colors[1].a);
    cross_surface(state, ray, s, isovalues[2], colors[2].rgb, colors[2].a);
}

fn swap_surfaces(isovalues: ptr<function, array<f32, 3>>, colors: ptr<function, array<vec4f, 3>>, i: i32, j: i32) {
    let isovalue = (*isovalues)[i];
    let color = (*colors)[i];
    (*isovalues)[i] = (*isovalues)[j];
    (*colors)[i] = (*colors)[j];
    (*isovalues)[j] = isovalue;
    (*colors)[j] = color;
}

fn done(state: State) -> bool {
    return state.color.w >= frame.termination_opacity;
}

fn finish(state: State, ray: Ray) -> Result {
    var last = state;
    if !done(last) {
        add(&last, ray, last_stretch(ray));
    }
    return Result(last.color, last.first);
}
