// Entry and exit points of a mesh. The rasteriser says which triangle a pixel sees; where its ray meets that triangle's
// plane is computed from the ray itself, so the precision does not depend on interpolation.

struct Rays {
    volume_to_clip: mat4x4f,
    // Centre, half axis to the right, half axis up of the planes on which rays start and end, volume coordinates.
    near: array<vec4f, 3>,
    far: array<vec4f, 3>,
    pixel_to_device: vec4f,
}

@group(0) @binding(0) var<uniform> rays: Rays;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) anchor: vec3f,
    @location(1) @interpolate(flat) normal: vec3f,
    @location(2) position: vec3f,
}

/// `anchor` is a corner of the triangle and `normal` its outward normal, volume coordinates.
@vertex
fn project(@location(0) position: vec3f, @location(1) anchor: vec3f, @location(2) normal: vec3f) -> Corner {
    return Corner(rays.volume_to_clip * vec4f(position, 1.0), anchor, normal, position);
}

struct PixelRay {
    start: vec3f,
    chord: vec3f,
    // The part of the ray within the unit box.
    low: f32,
    high: f32,
}

fn ray_of(pixel: vec2f) -> PixelRay {
    let device = pixel * rays.pixel_to_device.xy + rays.pixel_to_device.zw;
    let start = rays.near[0].xyz + rays.near[1].xyz * device.x + rays.near[2].xyz * device.y;
    let end = rays.far[0].xyz + rays.far[1].xyz * device.x + rays.far[2].xyz * device.y;
    var ray = PixelRay(start, end - start, 0.0, 1.0);
    for (var axis = 0; axis < 3; axis++) {
        let slope = ray.chord[axis];
        // Parallel to a pair of faces: that pair does not bound the ray.
        if abs(slope) > 1e-20 {
            let a = (0.0 - start[axis]) / slope;
            let b = (1.0 - start[axis]) / slope;
            ray.low = max(ray.low, min(a, b));
            ray.high = min(ray.high, max(a, b));
        }
    }
    return ray;
}

/// Where the ray meets the triangle's plane, within the unit box.
fn meet(ray: PixelRay, corner: Corner) -> vec3f {
    let across = dot(corner.normal, ray.chord);
    if abs(across) < 1e-20 {
        return clamp(corner.position, vec3f(0.0), vec3f(1.0));
    }
    let t = dot(corner.normal, corner.anchor - ray.start) / across;
    return clamp(ray.start + ray.chord * clamp(t, ray.low, max(ray.low, ray.high)), vec3f(0.0), vec3f(1.0));
}

struct Entry {
    @location(0) point: vec4f,
    @builtin(frag_depth) depth: f32,
}

/// The nearest face. Seen from outside it is where the ray enters; seen from inside the ray starts within the mesh.
/// Where a front and a back face meet at a silhouette they are equally near: the back face yields.
@fragment
fn entry(corner: Corner) -> Entry {
    let ray = ray_of(corner.clip.xy);
    if dot(corner.normal, ray.chord) < 0.0 {
        return Entry(vec4f(meet(ray, corner), 1.0), corner.clip.z);
    }
    let start = ray.start + ray.chord * ray.low;
    return Entry(vec4f(clamp(start, vec3f(0.0), vec3f(1.0)), 1.0), corner.clip.z * (1.0 - 1e-5));
}

/// The farthest face that is seen from inside.
@fragment
fn exit(corner: Corner) -> @location(0) vec4f {
    let ray = ray_of(corner.clip.xy);
    if dot(corner.normal, ray.chord) < 0.0 {
        discard;
    }
    return vec4f(meet(ray, corner), 1.0);
}
