// Long rings: a workgroup per span of SPAN vertices, whose results one thread per ring puts together
// in order. First how far the ring reaches, then its sums, then its value or slopes.

struct Span {
    // Which of the long rings, and the first vertex in it.
    long: u32,
    start: u32,
}

struct Long {
    ring: u32,
    // Its spans.
    first: u32,
    count: u32,
}

struct Whole {
    all: Edges,
    scale: f32,
}

@group(0) @binding(6) var<storage, read> spans: array<Span>;
@group(0) @binding(7) var<storage, read> longs: array<Long>;
@group(0) @binding(8) var<storage, read_write> parts: array<Edges>;
@group(0) @binding(9) var<storage, read_write> wholes: array<Whole>;

var<workgroup> near: array<Edges, GROUP>;

fn larger(x: Edges, y: Edges) -> Edges {
    return Edges(0.0, most(x.around, y.around), vec2f(), vec2f());
}

// Halves onto halves, in the same order every time.
fn gathered(here: u32, own: Edges, of_extents: bool) -> Edges {
    near[here] = own;
    for (var half = GROUP / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if here < half {
            if of_extents {
                near[here] = larger(near[here], near[here + half]);
            } else {
                near[here] = plus(near[here], near[here + half]);
            }
        }
    }
    return near[0];
}

@compute @workgroup_size(GROUP)
fn extent_main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) here: u32) {
    let at = group.y * ROW + group.x;
    let span = spans[min(at, params.count - 1u)];
    let ring = unscaled(longs[span.long].ring);
    var extent = 0.0;
    let end = min(span.start + SPAN, ring.count);
    for (var i = span.start + here; i < end; i += GROUP) {
        extent = most(extent, reach(ring, i));
    }
    let all = gathered(here, Edges(0.0, extent, vec2f(), vec2f()), true);
    if here == 0u && at < params.count {
        parts[at] = all;
    }
}

@compute @workgroup_size(GROUP)
fn scale_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.count {
        let long = longs[thread.x];
        var extent = 0.0;
        for (var i = 0u; i < long.count; i++) {
            extent = most(extent, parts[long.first + i].around);
        }
        wholes[thread.x].scale = scale_of(extent);
    }
}

fn local_of(long: u32) -> Local {
    let ring = unscaled(longs[long].ring);
    return Local(ring.first, ring.count, ring.origin, wholes[long].scale);
}

@compute @workgroup_size(GROUP)
fn sums_main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) here: u32) {
    let at = group.y * ROW + group.x;
    let span = spans[min(at, params.count - 1u)];
    let local = local_of(span.long);
    var own = Edges();
    let end = min(span.start + SPAN, local.count);
    for (var i = span.start + here; i < end; i += GROUP) {
        own = plus(own, edge(local, i));
    }
    let all = gathered(here, own, false);
    if here == 0u && at < params.count {
        parts[at] = all;
    }
}

@compute @workgroup_size(GROUP)
fn whole_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.count {
        let long = longs[thread.x];
        var all = Edges();
        for (var i = 0u; i < long.count; i++) {
            all = plus(all, parts[long.first + i]);
        }
        wholes[thread.x].all = all;
    }
}

@compute @workgroup_size(GROUP)
fn long_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.count {
        put_measure(longs[thread.x].ring, measure(local_of(thread.x), wholes[thread.x].all));
    }
}

@compute @workgroup_size(GROUP)
fn long_vjp_main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) here: u32) {
    let at = group.y * ROW + group.x;
    if at >= params.count {
        return;
    }
    let span = spans[at];
    let local = local_of(span.long);
    let all = wholes[span.long].all;
    let pull = out_bar(longs[span.long].ring);
    let end = min(span.start + SPAN, local.count);
    for (var i = span.start + here; i < end; i += GROUP) {
        bars[local.first + i] = measure_vjp(local, all, i, pull);
    }
}
