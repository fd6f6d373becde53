/// A ray before its first sample.
fn begin_walk(ray: Ray) -> Walk {
    var walk: Walk;
    walk.index = ray.first;
    walk.previous_distance = ray.begin;
    let p = position_along(ray, ray.begin);
    walk.previous = value_at(p);
    walk.after_gap = in_gap(p);
    return walk;
}

/// Goes to the next sample that may contribute; whether there is one.
fn advance(ray: Ray, walk: ptr<function, Walk>) -> bool {
    (*walk).index = max((*walk).index, skip_empty(ray, (*walk).index));
    (*walk).ended = (*walk).index >= ray.last;
    return !(*walk).ended;
}

/// Tells a sample what came before it, and the walk about the sample.
fn link(walk: ptr<function, Walk>, s: ptr<function, Sample>) {
    (*walk).index += 1.0;
    (*walk).taken += 1u;
    (*s).previous_distance = (*walk).previous_distance;
    // After a gap the value stands for the whole segment, and no surface is crossed.
    (*s).previous = select((*walk).previous, (*s).value, (*walk).after_gap);
    (*walk).previous_distance = (*s).distance;
    (*walk).previous = (*s).value;
    (*walk).after_gap = !(*s).known;
}
