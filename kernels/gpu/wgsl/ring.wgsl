// Measures of rings and their adjoints, as sums over edges: what all of them share.

struct Params {
    count: u32,
}

// Sums over the edges of a ring, or of a part of it.
struct Edges {
    twice: f32,
    around: f32,
    moment: vec2f,
    sum: vec2f,
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
    // The first vertex; of no meaning where there is none.
    origin: vec2f,
    scale: f32,
}

fn halfway(ring: Local, i: u32) -> vec2f {
    return vertices[ring.first + i] * 0.5 - ring.origin * 0.5;
}

// Half the way, of which the scale is not known yet.
fn unscaled(ring: u32) -> Local {
    let first = offsets[ring];
    return Local(first, offsets[ring + 1u] - first, vertices[first], 1.0);
}

fn reach(ring: Local, i: u32) -> f32 {
    let at = halfway(ring, i);
    return most(abs(at.x), abs(at.y));
}

fn scale_of(extent: f32) -> f32 {
    let point = extent <= 0.0;
    return choose(point, 1.0, binade(choose(point, 1.0, extent)));
}

fn local_new(ring: u32) -> Local {
    let whole = unscaled(ring);
    var extent = 0.0;
    for (var i = 0u; i < whole.count; i++) {
        extent = most(extent, reach(whole, i));
    }
    return Local(whole.first, whole.count, whole.origin, scale_of(extent));
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

// Edge i alone.
fn edge(ring: Local, i: u32) -> Edges {
    let start = local_at(ring, i);
    let end = local_at(ring, after(ring, i));
    let cross = perp_dot(start, end);
    var own = Edges(cross, 0.0, vec2f(), vec2f());
    if MOMENTS {
        own.moment = (start + end) * cross;
        own.sum = start;
    }
    if LENGTHS {
        own.around = hypot(end.x - start.x, end.y - start.y);
    }
    return own;
}

fn plus(x: Edges, y: Edges) -> Edges {
    return Edges(x.twice + y.twice, x.around + y.around, x.moment + y.moment, x.sum + y.sum);
}

fn edges(ring: Local) -> Edges {
    var sums = Edges();
    for (var i = 0u; i < ring.count; i++) {
        sums = plus(sums, edge(ring, i));
    }
    return sums;
}
