// How many scores are above the threshold.

struct Taken {
    count: u32,
}

fn taken_new(item: u32, first: u32, strip: u32, is_own: bool) -> Taken {
    return Taken(0u);
}

fn take(taken: ptr<function, Taken>, score: f32, at: u32) {
    (*taken).count += select(0u, 1u, score > params.factor);
}

fn step_done(taken: ptr<function, Taken>) {}

fn put(taken: Taken, item: u32, strip: u32) {
    indices[item * params.parts + strip] = taken.count;
}
