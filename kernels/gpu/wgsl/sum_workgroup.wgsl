// Sums across threads where there are no subgroup operations: halves onto halves.

var<workgroup> thread_sums: array<WalkedBar, GROUP>;

fn row_sum(i: u32, bar: WalkedBar, here: u32, slot: u32, lane: u32) {
    workgroupBarrier();
    thread_sums[here] = bar;
    for (var half = GROUP / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if here < half {
            var sum = thread_sums[here];
            add_walked_bar(&sum, thread_sums[here + half]);
            thread_sums[here] = sum;
        }
    }
    if here == 0u {
        slot_sums[i * SLOTS] = thread_sums[0];
    }
}

@compute @workgroup_size(GROUP)
fn pairs_vjp_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    sweep_vjp(group, here, 0u, here);
}
