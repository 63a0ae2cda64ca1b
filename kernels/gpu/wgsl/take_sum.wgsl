// The sum of the scores, a step at a time so that rounding grows slowly.

struct Taken {
    total: f32,
    step: f32,
}

fn taken_new(item: u32, first: u32, strip: u32, is_own: bool) -> Taken {
    return Taken();
}

fn take(taken: ptr<function, Taken>, score: f32, at: u32) {
    (*taken).step += score;
}

fn step_done(taken: ptr<function, Taken>) {
    (*taken).total += (*taken).step;
    (*taken).step = 0.0;
}

fn put(taken: Taken, item: u32, strip: u32) {
    values[strip * params.own_count + item] = taken.total;
}
