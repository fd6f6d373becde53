/// What is the same for every ray of a frame. Mirrored by the host.
struct Frame {
    /// Volume coordinates -> world directions, lengths in reference lengths.
    volume_to_world: mat3x3f,
    /// Gradient along voxel axes -> world direction, in normalised value a mean voxel spacing.
    gradient_to_world: mat3x3f,
    /// View depth (world length) of a point in volume coordinates: dot(depth_plane, vec4(p, 1)).
    depth_plane: vec4f,
    /// Texel * scale + offset = normalised value.
    texel_scale: vec4f,
    texel_offset: vec4f,
    /// Voxels along each axis.
    dims: vec3f,
    samples_per_voxel: f32,
    /// Unit vector towards the light, world space.
    light_direction: vec3f,
    /// Gradient magnitude (normalised value a voxel) at which shading is half faded out.
    gradient_fade: f32,
    light_color: vec3f,
    /// Accumulated opacity at which early termination stops a ray.
    termination_opacity: f32,
    /// Bricks of the skipping map a unit of volume coordinates.
    brick_scale: vec3f,
    /// 1 lights both sides: normals are turned to the viewer (surfaces) or to the light (media).
    two_sided: f32,
    image_size: vec2u,
    /// Upper bound of samples a ray.
    max_samples: u32,
    /// 1 / largest gradient magnitude of the 2-D transfer function (mean voxel spacings a normalised value).
    gradient_scale: f32,
    /// Largest label, and the span of values that the label texture's 0..1 stands for.
    label_minimum: f32,
    label_span: f32,
    jitter_seed: u32,
    /// Row of the picture at which the dispatch begins.
    first_row: u32,
}

/// A ray in volume coordinates.
struct Ray {
    entry: vec3f,
    /// One sample step.
    step: vec3f,
    /// Length of the ray in sample steps, not a whole number.
    steps: f32,
    /// Number of samples; 0 for a ray that misses.
    count: u32,
    /// Length of a whole step in reference lengths.
    step_length: f32,
    /// Unit vector towards the viewer, world space.
    view: vec3f,
#if jitter
    /// How far the lattice is moved towards the entry point, in steps, at least 0 and less than 1.
    shift: f32,
#endif
}

/// A sample on a ray. Fields that nothing reads are never computed.
struct Sample {
    /// Steps from the entry point.
    along: f32,
    /// Volume coordinates.
    position: vec3f,
    /// Length of the segment that the sample stands for, in reference lengths.
    length: f32,
    /// Normalised values of all channels.
    voxel: vec4f,
    /// Normalised value of the selected channel.
    value: f32,
    /// The value at the previous sample, and where that was.
    previous: f32,
    previous_along: f32,
    /// World-space gradient, normalised value a mean voxel spacing.
    gradient: vec3f,
    /// (emission, extinction) a reference length, classified and shaded.
    medium: vec4f,
}

/// The geometry that a shading snippet needs: unit vectors in world space.
struct Surface {
    normal: vec3f,
    view: vec3f,
    light: vec3f,
    light_color: vec3f,
}

/// What an output stores: premultiplied colour, and its place on the ray in steps (negative: nothing was hit).
struct Result {
    color: vec4f,
    along: f32,
}
