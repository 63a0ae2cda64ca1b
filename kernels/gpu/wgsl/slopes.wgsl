// Sums of derivatives of the shapes of one list: one thread per own shape, which walks through a strip of the other list
// and writes a partial sum, which `fold_main` adds in a fixed order. The factor of a pair's derivatives (`seed_at`) is in
// other files.

@compute @workgroup_size(GROUP)
fn slopes_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    if item >= params.own_count {
        return;
    }
    let own = own_at(params.own_start + item);
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    var total = OwnBar();
    for (var start = first; start < end; start += STEP) {
        // A step by itself, so that rounding grows slowly.
        var sum = OwnBar();
        for (var i = start; i < min(start + STEP, end); i++) {
            add_own(&sum, body_at(own, walked_of(i), seed_at(i, item)));
        }
        add_own_bar(&total, sum);
    }
    put_own(total, item, group.y);
}
