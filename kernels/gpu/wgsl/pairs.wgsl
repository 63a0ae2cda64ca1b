// Every row with every column: one thread per column, which walks through a strip of rows. Results of several numbers go
// plane by plane (`put_pair`, generated).

@compute @workgroup_size(GROUP)
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    if column >= params.own_count {
        return;
    }
    let own = own_at(params.own_start + column);
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    for (var i = first; i < end; i++) {
        put_pair(body_at(own, walked_of(i)), params.out_start + i * params.stride + column);
    }
}
