//! slot: stepping
//! help: The next visible sample, looked for before it is lit: rays of a group shade together.

fn find_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) -> bool {
    var visible = false;
    while !visible && advance(ray, walk) {
        *s = sample_at(ray, place_of(ray, (*walk).index));
        (*s).medium = classify(*s);
        visible = (*s).known && (*s).medium.w > 0.0;
        (*walk).index += 1.0;
        (*walk).taken += 1u;
    }
    return visible;
}

fn take_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) {
    (*s).medium = lit((*s).medium, ray, (*s).position, (*s).voxel, frame.light_direction);
    (*walk).contributing += 1u;
}
