// The perimeter of a ring and its slope at one vertex.

fn measure(local: Local, all: Edges) -> vec2f {
    return vec2f(saturated(outer(local, all.around)), 0.0);
}

fn measure_vjp(local: Local, all: Edges, i: u32, out_bar: vec2f) -> vec2f {
    let here = local_at(local, i);
    let pull = normalize_or_zero(here - local_at(local, before(local, i)))
        + normalize_or_zero(here - local_at(local, after(local, i)));
    return pull * out_bar.x;
}
