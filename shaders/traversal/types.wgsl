/// What is the same for every ray of a picture. Mirrored by the host. Distances are counted in reference lengths.
struct Frame {
    /// From the plane on which rays begin to that on which they end, world directions: at the middle of the picture, and how that
    /// changes to its right and upper edge.
    chord: array<vec4f, 3>,
    /// Pixel -> normalised device coordinates, x right and y up: pixel * xy + zw.
    pixel_to_device: vec4f,
    /// Unit vector towards the light, world space.
    light_direction: vec3f,
    /// Gradient magnitude (normalised value per voxel) at which shading is half faded out.
    gradient_fade: f32,
    light_color: vec3f,
    /// Accumulated opacity at which early termination stops a ray.
    termination_opacity: f32,
    image_size: vec2u,
    /// Distance from one sample to the next.
    step: f32,
    /// 1 lights both sides: normals are turned to the viewer (surfaces) or to the light (media).
    two_sided: f32,
    /// View depth of the planes on which rays begin (x) and end (y), world units.
    depths: vec2f,
    jitter_seed: u32,
    /// Row of the picture at which the dispatch begins.
    first_row: u32,
}

/// One volume that rays pass through. Mirrored by the host.
struct Source {
    /// The planes on which rays begin and end, volume coordinates: their middle, and half axes to the right and up.
    near: array<vec4f, 3>,
    far: array<vec4f, 3>,
    /// Gradient along voxel axes -> world direction, in normalised value per mean voxel spacing.
    gradient_to_world: mat3x3f,
    /// Texel * scale + offset = normalised value.
    texel_scale: vec4f,
    texel_offset: vec4f,
    /// Voxels along each axis.
    dims: vec3f,
    /// 1 / largest gradient magnitude of the 2-D transfer function (mean voxel spacings per normalised value).
    gradient_scale: f32,
    /// Bricks of the skipping map per unit of volume coordinates.
    brick_scale: vec3f,
    /// Smallest label, and the span of values that the label texture's 0..1 stands for.
    label_minimum: f32,
    label_span: f32,
}

/// A ray. Distances along it are world distances in reference lengths, from where its line enters the volumes' boxes.
struct Ray {
    /// Unit vector towards the viewer, world space.
    view: vec3f,
    /// Where entry and exit points let it begin and end.
    begin: f32,
    end: f32,
    /// Its samples: number `first`, a whole one, up to but without `last`. None for a ray that misses.
    first: f32,
    last: f32,
    /// How far the lattice is moved towards the viewer, in steps, at least 0 and less than 1.
    shift: f32,
    /// How much of the first and of the last segment is cut off.
    cut: vec2f,
    /// View depth at distance 0, and its growth with distance, world units.
    depth: f32,
    depth_slope: f32,
#each source
    /// The volume coordinates at distance 0, and their growth with distance.
    SRC_origin: vec3f,
    SRC_direction: vec3f,
    /// The distances at which the line enters and leaves the volume's box.
    SRC_span: vec2f,
#end
}

/// What a sample stands for: its place on the ray and the length of its segment.
struct Place {
    distance: f32,
    length: f32,
}

/// A sample on a ray. Fields that nothing reads are never computed.
struct Sample {
    /// Distance from the begin of the lattice.
    distance: f32,
    /// Length of the segment that the sample stands for.
    length: f32,
    /// Volume coordinates.
    position: vec3f,
    /// Normalised values of all channels.
    voxel: vec4f,
    /// Normalised value of the selected channel.
    value: f32,
    /// The value at the previous sample, and where that was.
    previous: f32,
    previous_distance: f32,
    /// World-space gradient, normalised value per mean voxel spacing.
    gradient: vec3f,
    /// (emission, extinction) per reference length, classified and shaded.
    medium: vec4f,
    /// Whether there is a value.
    known: bool,
}

/// How far a ray has come.
struct Walk {
    /// Number of the next sample.
    index: f32,
    /// The last value, where it was, and whether values have been missing since.
    previous: f32,
    previous_distance: f32,
    after_gap: bool,
    /// Samples taken, and those of them that contribute.
    taken: u32,
    contributing: u32,
    /// Whether the ray came to its end, or stopped because nothing further could matter.
    ended: bool,
}

/// The geometry that a shading snippet needs: unit vectors in world space.
struct Surface {
    normal: vec3f,
    view: vec3f,
    light: vec3f,
    light_color: vec3f,
}

/// What an output stores: premultiplied colour, and the distance of its place on the ray (negative: nothing was hit).
struct Result {
    color: vec4f,
    distance: f32,
}
