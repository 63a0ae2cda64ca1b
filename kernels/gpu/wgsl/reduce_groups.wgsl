// Reductions within groups: one thread per own row (or column), which walks through its own range of the others, strip
// by strip. Ranges differ between threads, so that what is walked is read where it lies and nobody waits for others.
// The score of a pair (`score_at`) and the result taken of it (`take`, `put`) are in other files.

// The first of the whole other list, and the one after the last, for every own row that has results in the bound piece.
@group(0) @binding(9) var<storage, read> ranges: array<vec2u>;

@compute @workgroup_size(GROUP)
fn reduce_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    if item >= params.own_count {
        return;
    }
    let bound = vec2u(params.loop_base, params.loop_base + params.loop_count);
    let range = clamp(ranges[params.out_start + item], bound.xx, bound.yy) - bound.xx;
    let first = range.x + group.y * STRIP;
    let end = min(first + STRIP, range.y);
    let own = own_at(params.own_start + item);
    var taken = taken_new(item, first, group.y, true);
    for (var at = first; at < end; at++) {
        take(&taken, score_at(own, at, 0u, here), at);
    }
    step_done(&taken);
    put(taken, item, group.y);
}
