//! slot: gaps
//! help: Every voxel has a value.

fn in_gap(p: vec3f) -> bool {
    return false;
}
