// Writes scores above the threshold down as (row, column, score), each strip from its place on.

struct Taken {
    row: u32,
    to: u32,
    is_own: bool,
}

fn taken_new(item: u32, first: u32, strip: u32, is_own: bool) -> Taken {
    var to = 0u;
    if is_own {
        to = indices[item * params.parts + strip];
    }
    return Taken(params.own_base + item, to, is_own);
}

fn take(taken: ptr<function, Taken>, score: f32, at: u32) {
    if score > params.factor && (*taken).is_own {
        let to = 3u * (*taken).to;
        values[to] = bitcast<f32>((*taken).row);
        values[to + 1u] = bitcast<f32>(params.loop_base + at);
        values[to + 2u] = score;
        (*taken).to += 1u;
    }
}

fn step_done(taken: ptr<function, Taken>) {}

fn put(taken: Taken, item: u32, strip: u32) {}
