// Sums across threads where the hardware adds within subgroups: one slot per subgroup.

fn row_sum(i: u32, bar: WalkedBar, here: u32, slot: u32, lane: u32) {
    var sums = WalkedBar();
    // Most pairs of a large batch are apart.
    if subgroupAny(!is_zero(bar)) {
        sums = subgroup_sums(bar);
    }
    if lane == 0u && slot < SLOTS {
        slot_sums[i * SLOTS + slot] = sums;
    }
}

@compute @workgroup_size(GROUP)
fn pairs_vjp_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
    @builtin(subgroup_id) slot: u32,
    @builtin(subgroup_invocation_id) lane: u32,
) {
    // A device may use fewer, larger subgroups than it could: what nobody fills must be zero.
    for (var k = here; k < STEP * SLOTS; k += GROUP) {
        slot_sums[k] = WalkedBar();
    }
    workgroupBarrier();
    sweep_vjp(group, here, slot, lane);
}
