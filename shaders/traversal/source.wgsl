@group(0) @binding(auto) var<uniform> source: Source;
@group(0) @binding(auto) var volume: texture_3d<f32>;
@group(0) @binding(auto) var transfer_table: texture_2d<f32>;
@group(0) @binding(auto) var transfer_table_2d: texture_2d<f32>;
@group(0) @binding(auto) var preintegrated_table: texture_2d<f32>;
@group(0) @binding(auto) var label_volume: texture_3d<f32>;
@group(0) @binding(auto) var label_table: texture_2d<f32>;
@group(0) @binding(auto) var skip_map: texture_3d<u32>;

#constants

/// Volume coordinates at a distance along a ray.
fn position_along(ray: Ray, distance: f32) -> vec3f {
    return ray.SRC_origin + ray.SRC_direction * distance;
}

/// How the volume coordinates grow along a ray, with each reference length.
fn direction_of_ray(ray: Ray) -> vec3f {
    return ray.SRC_direction;
}

/// Normalised values of all channels at `p` (volume coordinates).
fn voxel_at(p: vec3f) -> vec4f {
    return sample_volume(p) * source.texel_scale + source.texel_offset;
}

/// Normalised value of the selected channel at `p` (volume coordinates).
fn value_at(p: vec3f) -> f32 {
    return voxel_at(p)[CHANNEL];
}

/// World-space gradient at `p`, normalised value per mean voxel spacing.
fn world_gradient(p: vec3f, voxel: vec4f) -> vec3f {
    return source.gradient_to_world * gradient_at(p, voxel);
}

/// The values at a place of the ray.
fn sample_at(ray: Ray, place: Place) -> Sample {
    var s: Sample;
    s.distance = place.distance;
    s.length = place.length;
    s.position = position_along(ray, place.distance);
    s.voxel = voxel_at(s.position);
    s.value = s.voxel[CHANNEL];
    s.known = !in_gap(s.position);
    s.gradient = sample_gradient(s);
    return s;
}

/// The classified and shaded medium at a distance along the ray.
fn medium_at(ray: Ray, distance: f32) -> vec4f {
    var s = sample_at(ray, Place(distance, 0.0));
    s.previous = s.value;
    return lit(classify(s), ray, s.position, s.voxel, frame.light_direction);
}

/// The medium of a bare normalised value: no place, no gradient, no shading.
fn classify_value(value: f32) -> vec4f {
    var s: Sample;
    s.value = value;
    s.previous = value;
    s.voxel = vec4f(value);
    return classify(s);
}

/// An opaque surface of the given colour at a distance along the ray: shaded, premultiplied, opacity 1.
fn surface_at(ray: Ray, distance: f32, color: vec3f) -> vec4f {
    let p = position_along(ray, distance);
    return lit(vec4f(color, 1.0), ray, p, voxel_at(p), ray.view);
}

/// The stretch from the last sample to the end of the ray, as a sample there: surfaces are looked for up to the end.
/// Both values are read again, so that it does not matter whether the last sample was skipped.
fn last_stretch(ray: Ray) -> Sample {
    let last = sample_at(ray, place_of(ray, ray.last - 1.0));
    var s = sample_at(ray, Place(ray.end, 0.0));
    s.previous_distance = last.distance;
    // Nothing is known of what lies between where a value is missing: no surface is crossed.
    s.previous = select(s.value, last.value, last.known && s.known);
    return s;
}
