const MISS_DEPTH = 3.0e38;
/// A cut this close to where a lattice begins, or a segment ends, is rounding: shares of a step, and of the way through the boxes.
const SLACK_OF_STEP = 1e-4;
const SLACK_OF_WAY = 1e-6;

@group(0) @binding(auto) var entry_points: texture_2d<f32>;
@group(0) @binding(auto) var exit_points: texture_2d<f32>;

/// The point of a plane that a ray passes, given by the middle and the half axes of the plane.
fn on_plane(plane: array<vec4f, 3>, device: vec2f) -> vec3f {
    return plane[0].xyz + plane[1].xyz * device.x + plane[2].xyz * device.y;
}

/// The distances at which a line enters (x) and leaves (y) the unit box; x > y when it misses.
fn box_span(origin: vec3f, direction: vec3f) -> vec2f {
    let moving = abs(direction) > vec3f(1e-20);
    let slope = select(vec3f(1.0), direction, moving);
    let a = -origin / slope;
    let b = (1.0 - origin) / slope;
    // A line parallel to a pair of faces is between them all along, or nowhere.
    let between = (origin >= vec3f(0.0)) & (origin <= vec3f(1.0));
    let low = select(select(vec3f(3e38), vec3f(-3e38), between), min(a, b), moving);
    let high = select(select(vec3f(-3e38), vec3f(3e38), between), max(a, b), moving);
    return vec2f(max(low.x, max(low.y, low.z)), min(high.x, min(high.y, high.z)));
}

/// The ray of a pixel: its line comes from the camera, entry and exit points cut it.
fn ray_through(pixel: vec2u) -> Ray {
    let device = (vec2f(pixel) + 0.5) * frame.pixel_to_device.xy + frame.pixel_to_device.zw;
    let chord = on_plane(frame.chord, device);
    let reach = length(chord);
    var ray: Ray;
    ray.view = -chord / max(reach, 1e-30);
    // From the plane on which it begins to the boxes.
    var way = vec2f(3e38, -3e38);
#each source
    let SRC_near = on_plane(SRC_source.near, device);
    ray.SRC_direction = (on_plane(SRC_source.far, device) - SRC_near) / reach;
    ray.SRC_span = box_span(SRC_near, ray.SRC_direction);
    way = select(way, vec2f(min(way.x, ray.SRC_span.x), max(way.y, ray.SRC_span.y)), ray.SRC_span.x < ray.SRC_span.y);
#end
    let entry = textureLoad(entry_points, pixel, 0);
    let exit = textureLoad(exit_points, pixel, 0);
    let cut = vec2f(distance_of(entry.xyz, near, ray.direction), distance_of(exit.xyz, near, ray.direction));
    if entry.w < 0.5 || exit.w < 0.5 || !(way.x < way.y) {
        return ray;
    }
#each source
    let SRC_start = SRC_near + ray.SRC_direction * way.x;
    // Where the way begins on the box itself, rounding must not leave the face.
    ray.SRC_origin = select(SRC_start, clamp(SRC_start, vec3f(0.0), vec3f(1.0)), ray.SRC_span.x == way.x);
    ray.SRC_span -= way.x;
#end
    ray.depth_slope = (frame.depths.y - frame.depths.x) / reach;
    ray.depth = frame.depths.x + ray.depth_slope * way.x;
    ray.shift = lattice_shift(pixel);
    let slack = SLACK_OF_STEP * frame.step + SLACK_OF_WAY * (way.y - way.x);
    let begin = cut.x - way.x;
    ray.begin = select(begin, 0.0, begin < slack);
    ray.end = select(cut.y, way.y, cut.y > way.y - slack) - way.x;
    if ray.begin < ray.end {
        ray.first = floor(ray.begin / frame.step + ray.shift + SLACK_OF_STEP);
        ray.last = max(ray.first + 1.0, ceil(ray.end / frame.step + ray.shift - SLACK_OF_STEP));
        ray.cut = vec2f(ray.begin, -ray.end) - (vec2f(ray.first, -ray.last) - vec2f(ray.shift, -ray.shift)) * frame.step;
    }
    return ray;
}

/// How far a point of a line is from the line's origin.
fn distance_of(point: vec3f, origin: vec3f, direction: vec3f) -> f32 {
    return dot(point - origin, direction) / max(dot(direction, direction), 1e-37);
}

/// The segment that a sample stands for, and its place there. The first and the last segment may be cut short.
fn place_of(ray: Ray, index: f32) -> Place {
    let before = select(0.0, ray.cut.x, index <= ray.first);
    let after = select(0.0, ray.cut.y, index >= ray.last - 1.0);
    let whole = (index - ray.shift + select(0.5, 1.0, SEGMENT_ENDS)) * frame.step;
    return Place(whole + select(0.5 * (before - after), -after, SEGMENT_ENDS), frame.step - (before + after));
}

/// View depth, world units.
fn depth_at(ray: Ray, distance: f32) -> f32 {
    return ray.depth + ray.depth_slope * distance;
}

/// The depth that an output stores.
fn stored_depth(ray: Ray, distance: f32) -> f32 {
    return select(depth_at(ray, distance), MISS_DEPTH, distance < 0.0);
}
