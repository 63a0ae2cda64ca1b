// Sums across threads where the hardware adds within subgroups: one slot per subgroup.

fn row_sum(i: u32, bar: Bar, here: u32, slot: u32, lane: u32) {
    var quad = vec4f();
    var rest = 0.0;
    // Most pairs of a large batch are apart.
    if subgroupAny(any(bar.quad != vec4f()) || bar.rest != 0.0) {
        quad = subgroupAdd(bar.quad);
        rest = subgroupAdd(bar.rest);
    }
    if lane == 0u && slot < SLOTS {
        slot_quad[i * SLOTS + slot] = quad;
        slot_rest[i * SLOTS + slot] = rest;
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
        slot_quad[k] = vec4f();
        slot_rest[k] = 0.0;
    }
    workgroupBarrier();
    sweep_vjp(group, here, slot, lane);
}
