//! slot: sample_map
//! help: Nobody asked.

fn map_ray(pixel: vec2u, ray: Ray, walk: Walk) {}
