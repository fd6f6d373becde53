//! slot: stepping
//! help: Every sample, with its values: nothing classifies it in the loop.

fn find_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) -> bool {
    return advance(ray, walk);
}

fn take_sample(ray: Ray, walk: ptr<function, Walk>, s: ptr<function, Sample>) {
    *s = sample_at(ray, place_of(ray, (*walk).index));
    link(walk, s);
    (*walk).contributing += select(0u, 1u, (*s).known);
}
