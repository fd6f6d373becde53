//! slot: statistics
//! help: Nobody asked.

fn count_ray(ray: Ray, walk: Walk) {}
