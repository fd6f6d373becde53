//! slot: stepping
//! help: Every sample, classified and lit where it is visible.

fn find_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) -> bool {
    return advance(ray, walk);
}

fn take_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) {
    *s = sample_at(ray, place_of(ray, (*walk).index));
    link(walk, s);
    (*s).medium = classify(*s);
    if (*s).known && (*s).medium.w > 0.0 {
        (*s).medium = lit((*s).medium, ray, (*s).position, (*s).voxel, frame.light_direction);
        (*walk).contributing += 1u;
    }
}
