// Reductions of all pairs: one thread per own row (or column), which walks through a strip of the
// others. Where scores come from (`score_at`) and what is taken of them (`take`, `put`) is in other
// files. Strips are put together in a fixed order.

@compute @workgroup_size(GROUP)
fn reduce_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let is_own = item < params.own_count;
    let own = own_at(params.own_start + min(item, params.own_count - 1u));
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    var taken = taken_new(item, first, group.y, is_own);
    for (var start = first; start < end; start += STEP) {
        bring(group.x * GROUP, start, end, here);
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            take(&taken, score_at(own, start, i, here), start + i);
        }
        step_done(&taken);
    }
    if is_own {
        put(taken, item, group.y);
    }
}
