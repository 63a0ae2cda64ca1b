// Batches of rings: one thread per short ring.

fn put_measure(ring: u32, value: vec2f) {
    values[FIELDS * ring] = value.x;
    if FIELDS > 1u {
        values[FIELDS * ring + 1u] = value.y;
    }
}

fn out_bar(ring: u32) -> vec2f {
    return vec2f(upstream[FIELDS * ring], upstream[FIELDS * ring + FIELDS - 1u]);
}

fn is_short(ring: u32) -> bool {
    return ring < params.count && offsets[ring + 1u] - offsets[ring] < LONG;
}

@compute @workgroup_size(GROUP)
fn ragged_main(@builtin(global_invocation_id) thread: vec3u) {
    if is_short(thread.x) {
        let local = local_new(thread.x);
        put_measure(thread.x, measure(local, edges(local)));
    }
}

@compute @workgroup_size(GROUP)
fn ragged_vjp_main(@builtin(global_invocation_id) thread: vec3u) {
    if is_short(thread.x) {
        let local = local_new(thread.x);
        let all = edges(local);
        let pull = out_bar(thread.x);
        for (var i = 0u; i < local.count; i++) {
            bars[local.first + i] = measure_vjp(local, all, i, pull);
        }
    }
}
