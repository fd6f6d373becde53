/// The sample with this number: place and values.
fn sample_ray(ray: Ray, index: u32) -> Sample {
    let place = segment(ray, index);
    var s: Sample;
    s.along = place.x;
    s.position = position_along(ray, place.x);
    s.length = place.y * ray.step_length;
    s.voxel = voxel_at(s.position);
    s.value = selected(s.voxel);
    return s;
}
#if gradient

/// World-space gradient at `p`, normalised value a mean voxel spacing.
fn world_gradient(p: vec3f, voxel: vec4f) -> vec3f {
    return frame.gradient_to_world * gradient_at(p, voxel);
}
#endif
#if shading

/// Shades a medium at `p`. Where the gradient vanishes there is no surface to light, and the unlit medium shows.
/// Two-sided lighting turns normals to the side of `facing`: the viewer for surfaces, whose front is what is seen. A medium has
/// no front, and it turns to the light: turning to the viewer would jump where a normal is seen edge-on, inside of what the ray
/// integrates, and cost an order of convergence.
fn lit(medium: vec4f, ray: Ray, p: vec3f, voxel: vec4f, facing: vec3f) -> vec4f {
    var surface: Surface;
    surface.view = ray.view;
    surface.light = frame.light_direction;
    surface.light_color = frame.light_color;
#if shaded_gradient
    let gradient = world_gradient(p, voxel);
    let magnitude = length(gradient);
    surface.normal = -gradient / max(magnitude, 1e-20);
    if frame.two_sided > 0.5 && dot(surface.normal, facing) < 0.0 {
        surface.normal = -surface.normal;
    }
    let weight = magnitude / (magnitude + frame.gradient_fade);
    return mix(medium, shade(medium, surface), weight);
#else
    surface.normal = ray.view;
    return shade(medium, surface);
#endif
}
#endif
#if medium_at

/// The classified and shaded medium after `along` steps.
fn medium_at(ray: Ray, along: f32) -> vec4f {
    var s: Sample;
    s.along = along;
    s.position = position_along(ray, along);
    s.voxel = voxel_at(s.position);
    s.value = selected(s.voxel);
    s.previous = s.value;
#if classified_gradient
    s.gradient = world_gradient(s.position, s.voxel);
#endif
    let medium = classify(s);
#if shading
    return lit(medium, ray, s.position, s.voxel, frame.light_direction);
#else
    return medium;
#endif
}
#endif
#if classify_value

/// The medium of a bare normalised value: no place, no gradient, no shading.
fn classify_value(value: f32) -> vec4f {
    var s: Sample;
    s.value = value;
    s.previous = value;
    s.voxel = vec4f(value);
    return classify(s);
}
#endif
#if surface

/// An opaque surface of the given colour after `along` steps: shaded, premultiplied, opacity 1.
fn surface_at(ray: Ray, along: f32, color: vec3f) -> vec4f {
#if shading
    let p = position_along(ray, along);
    return lit(vec4f(color, 1.0), ray, p, voxel_at(p), ray.view);
#else
    return vec4f(color, 1.0);
#endif
}
#endif
#if slot_refinement

/// The stretch from the last sample to the exit point, as a sample there: surfaces are looked for up to the end of the ray.
/// Both values are read anew, so that it does not matter whether the last sample was skipped.
fn last_stretch(ray: Ray) -> Sample {
    var s: Sample;
    s.previous_along = segment(ray, ray.count - 1u).x;
    s.previous = value_at(position_along(ray, s.previous_along));
    s.along = ray.steps;
    s.value = value_at(position_along(ray, s.along));
#if gaps
    if in_gap(position_along(ray, s.previous_along)) || in_gap(position_along(ray, s.along)) {
        s.previous = s.value;
    }
#endif
    return s;
}
#endif
#if counting

/// Whether a sample counts as contributing: visible medium, or, where nothing is classified in the loop, any sample.
fn contributes(s: Sample) -> bool {
#if medium
    return s.medium.w > 0.0;
#else
    return true;
#endif
}
#endif
