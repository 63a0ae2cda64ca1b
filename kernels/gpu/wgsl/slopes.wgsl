// Sums of derivatives of the shapes of one list: one thread per own shape, which walks through a strip of the other list
// and writes a partial sum, which `fold_main` adds in a fixed order. The factor of a pair's derivatives (`seed_at`) is in
// other files.

@compute @workgroup_size(GROUP)
fn slopes_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let own = own_at(params.own_start + min(item, params.own_count - 1u));
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    var total = OwnBar();
    for (var start = first; start < end; start += STEP) {
        bring(group.x * GROUP, start, end, here);
        let count = min(STEP, end - start);
        // A step by itself, so that rounding grows slowly.
        var sum = OwnBar();
        if item < params.own_count {
            for (var i = 0u; i < count; i++) {
                add_own(&sum, body_at(own, i, seed_at(start + i, item)));
            }
        }
        add_own_bar(&total, sum);
    }
    if item < params.own_count {
        put_own(total, item, group.y);
    }
}
