// Measures of rings and their adjoints: one thread per ring.

struct Params {
    rings: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> vertices: array<vec2f>;
@group(0) @binding(2) var<storage, read> offsets: array<u32>;
@group(0) @binding(3) var<storage, read> upstream: array<f32>;
@group(0) @binding(4) var<storage, read_write> values: array<f32>;
@group(0) @binding(5) var<storage, read_write> bars: array<vec2f>;

// A ring in its own frame.
struct Local {
    first: u32,
    count: u32,
    scale: f32,
}

fn halfway(ring: Local, i: u32) -> vec2f {
    return vertices[ring.first + i] * 0.5 - vertices[ring.first] * 0.5;
}

fn local_new(ring: u32) -> Local {
    let unscaled = Local(offsets[ring], offsets[ring + 1u] - offsets[ring], 1.0);
    var extent = 0.0;
    for (var i = 0u; i < unscaled.count; i++) {
        let at = halfway(unscaled, i);
        extent = most(most(extent, abs(at.x)), abs(at.y));
    }
    let point = extent <= 0.0;
    let scale = choose(point, 1.0, binade(choose(point, 1.0, extent)));
    return Local(unscaled.first, unscaled.count, scale);
}

fn local_at(ring: Local, i: u32) -> vec2f {
    return halfway(ring, i) * ring.scale;
}

fn after(ring: Local, i: u32) -> u32 {
    return select(i + 1u, 0u, i + 1u == ring.count);
}

fn before(ring: Local, i: u32) -> u32 {
    return select(i - 1u, ring.count - 1u, i == 0u);
}

fn outer(ring: Local, x: f32) -> f32 {
    return (x + x) / ring.scale;
}

fn perp_dot(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.y - a.y * b.x;
}

fn inner(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.x + a.y * b.y;
}

fn limited(x: f32, y: f32) -> vec2f {
    return vec2f(saturated(x), saturated(y));
}

fn normalize_or_zero(v: vec2f) -> vec2f {
    let size = hypot(v.x, v.y);
    let zero = size <= 0.0;
    return select(v / choose(zero, 1.0, size), vec2f(), zero);
}

// Sums over the edges of a ring.
struct Edges {
    twice: f32,
    moment: vec2f,
    sum: vec2f,
    around: f32,
}

fn edges(ring: Local) -> Edges {
    var sums = Edges();
    for (var i = 0u; i < ring.count; i++) {
        let start = local_at(ring, i);
        let end = local_at(ring, after(ring, i));
        let cross = perp_dot(start, end);
        sums.twice += cross;
        if MOMENTS {
            sums.moment += (start + end) * cross;
            sums.sum += start;
        }
        if LENGTHS {
            sums.around += hypot(end.x - start.x, end.y - start.y);
        }
    }
    return sums;
}

fn signed_area(index: u32) -> f32 {
    let local = local_new(index);
    return saturated(outer(local, outer(local, halved(edges(local).twice))));
}

fn perimeter(index: u32) -> f32 {
    let local = local_new(index);
    return saturated(outer(local, edges(local).around));
}

fn centroid(index: u32) -> vec2f {
    let local = local_new(index);
    if local.count == 0u {
        return vec2f();
    }
    let first = vertices[local.first];
    let all = edges(local);
    let is_flat = all.twice == 0.0;
    let thrice = 3.0 * choose(is_flat, 1.0, all.twice);
    let at = select(all.moment / thrice, all.sum / f32(local.count), is_flat);
    return limited(first.x + outer(local, at.x), first.y + outer(local, at.y));
}

fn signed_area_vjp(index: u32, out_bar: f32) {
    let local = local_new(index);
    for (var i = 0u; i < local.count; i++) {
        let across = (local_at(local, after(local, i)) - local_at(local, before(local, i))) * 0.5;
        bars[local.first + i] = limited(
            outer(local, across.y) * out_bar,
            -(outer(local, across.x) * out_bar),
        );
    }
}

fn perimeter_vjp(index: u32, out_bar: f32) {
    let local = local_new(index);
    for (var i = 0u; i < local.count; i++) {
        let here = local_at(local, i);
        let pull = normalize_or_zero(here - local_at(local, before(local, i)))
            + normalize_or_zero(here - local_at(local, after(local, i)));
        bars[local.first + i] = pull * out_bar;
    }
}

fn centroid_vjp(index: u32, out_bar: vec2f) {
    let local = local_new(index);
    let all = edges(local);
    let is_flat = all.twice == 0.0;
    let per = 1.0 / (3.0 * choose(is_flat, 1.0, all.twice));
    let thrice_at = inner(all.moment, out_bar) * per * 3.0;
    let mean = 1.0 / f32(local.count);
    for (var i = 0u; i < local.count; i++) {
        let earlier = local_at(local, before(local, i));
        let later = local_at(local, after(local, i));
        let here = local_at(local, i);
        let arrive = (inner(earlier + here, out_bar) - thrice_at) * per;
        let leave = (inner(here + later, out_bar) - thrice_at) * per;
        let cross = (perp_dot(earlier, here) + perp_dot(here, later)) * per;
        let solid = vec2f(-earlier.y, earlier.x) * arrive + vec2f(later.y, -later.x) * leave
            + cross * out_bar;
        let pull = select(solid, out_bar * mean, is_flat);
        bars[local.first + i] = limited(pull.x, pull.y);
    }
}
