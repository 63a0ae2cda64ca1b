// The largest score and where it is; the first one of several.

struct Taken {
    best: f32,
    at: u32,
}

fn taken_new(item: u32, first: u32, strip: u32, is_own: bool) -> Taken {
    return Taken(LEAST, first);
}

fn take(taken: ptr<function, Taken>, score: f32, at: u32) {
    if score > (*taken).best {
        (*taken).best = score;
        (*taken).at = at;
    }
}

fn step_done(taken: ptr<function, Taken>) {}

fn put(taken: Taken, item: u32, strip: u32) {
    values[strip * params.own_count + item] = taken.best;
    indices[strip * params.own_count + item] = params.loop_base + taken.at;
}
