// The centroid of a ring and its slope at one vertex.

fn measure(local: Local, all: Edges) -> vec2f {
    if local.count == 0u {
        return vec2f();
    }
    let is_flat = all.twice == 0.0;
    let thrice = 3.0 * choose(is_flat, 1.0, all.twice);
    let at = select(all.moment / thrice, all.sum / f32(local.count), is_flat);
    return limited(local.origin.x + outer(local, at.x), local.origin.y + outer(local, at.y));
}

fn measure_vjp(local: Local, all: Edges, i: u32, out_bar: vec2f) -> vec2f {
    let is_flat = all.twice == 0.0;
    let per = 1.0 / (3.0 * choose(is_flat, 1.0, all.twice));
    let thrice_at = inner(all.moment, out_bar) * per * 3.0;
    let mean = 1.0 / f32(local.count);
    let earlier = local_at(local, before(local, i));
    let later = local_at(local, after(local, i));
    let here = local_at(local, i);
    let arrive = (inner(earlier + here, out_bar) - thrice_at) * per;
    let leave = (inner(here + later, out_bar) - thrice_at) * per;
    let cross = (perp_dot(earlier, here) + perp_dot(here, later)) * per;
    let solid = vec2f(-earlier.y, earlier.x) * arrive + vec2f(later.y, -later.x) * leave
        + cross * out_bar;
    let pull = select(solid, out_bar * mean, is_flat);
    return limited(pull.x, pull.y);
}
