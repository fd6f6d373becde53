/// Slope of the value along one voxel axis between `back` and `ahead` voxels from `p`, a voxel.
/// Positions stay between the outermost voxel centres, and the difference is divided by the distance really covered,
/// so that a linear field has the same slope at the border.
fn slope(p: vec3f, axis: vec3f, back: f32, ahead: f32) -> f32 {
    let size = dot(source.dims, axis);
    let x = clamp(dot(p, axis) * size, 0.5, size - 0.5);
    var low = max(x - back, 0.5);
    var high = min(x + ahead, size - 0.5);
    // A one-sided operator looks the other way where less than half of its way is left.
    if high - low < 0.5 * (back + ahead) {
        low = max(x - ahead, 0.5);
        high = min(x + back, size - 0.5);
    }
    let rest = p * (1.0 - axis);
    let difference = value_at(rest + axis * (high / size)) - value_at(rest + axis * (low / size));
    return select(0.0, difference / max(high - low, 1e-6), high - low > 1e-4);
}

fn slopes(p: vec3f, back: f32, ahead: f32) -> vec3f {
    return vec3f(slope(p, vec3f(1.0, 0.0, 0.0), back, ahead), slope(p, vec3f(0.0, 1.0, 0.0), back, ahead), slope(p, vec3f(0.0, 0.0, 1.0), back, ahead));
}
