// Every row with every column: one thread per column, which walks through STEP rows. What is put
// down of a pair (`put_pair`) is in other files.

@compute @workgroup_size(GROUP)
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    let first = group.y * STEP;
    let count = min(STEP, params.loop_count - first);
    bring_walked(first, params.loop_count, here);
    let b = load_b(params.own_start + min(column, params.own_count - 1u));
    for (var i = 0u; i < count; i++) {
        put_pair(walked_frame(i), b, first + i, column);
    }
}
