// The area of a ring, whichever way it turns, and its slope at one vertex.

fn measure(local: Local, all: Edges) -> vec2f {
    return vec2f(saturated(outer(local, outer(local, abs(halved(all.twice))))), 0.0);
}

fn measure_vjp(local: Local, all: Edges, i: u32, out_bar: vec2f) -> vec2f {
    let across = (local_at(local, after(local, i)) - local_at(local, before(local, i))) * 0.5;
    let turned = sign(halved(all.twice)) * out_bar.x;
    return limited(outer(local, across.y) * turned, -(outer(local, across.x) * turned));
}
