// Sums across threads where there are no subgroup operations: halves onto halves.

var<workgroup> thread_quad: array<vec4f, GROUP>;
var<workgroup> thread_rest: array<f32, GROUP>;

fn row_sum(i: u32, bar: Bar, here: u32, slot: u32, lane: u32) {
    workgroupBarrier();
    thread_quad[here] = bar.quad;
    thread_rest[here] = bar.rest;
    for (var half = GROUP / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if here < half {
            thread_quad[here] += thread_quad[here + half];
            thread_rest[here] += thread_rest[here + half];
        }
    }
    if here == 0u {
        slot_quad[i * SLOTS] = thread_quad[0];
        slot_rest[i * SLOTS] = thread_rest[0];
    }
}

@compute @workgroup_size(GROUP)
fn pairs_vjp_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    sweep_vjp(group, here, 0u, here);
}
