//! slot: endings
//! help: No loop of a user's own is in the shader: rays come to their ends.

fn ray_ended(walk: Walk) {}
