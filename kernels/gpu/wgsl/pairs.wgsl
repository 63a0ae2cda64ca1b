// Every row with every column: one thread per column, which walks through a strip of rows. Results of several numbers go
// plane by plane (`put_pair`, generated).

@compute @workgroup_size(GROUP)
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    let own = own_at(params.own_start + min(column, params.own_count - 1u));
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    for (var start = first; start < end; start += STEP) {
        bring(group.x * GROUP, start, end, here);
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            let y = body_at(own, i);
            if column < params.own_count {
                put_pair(y, params.out_start + (start + i) * params.stride + column);
            }
        }
    }
}
