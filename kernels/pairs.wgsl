// Every row with every column: one thread per column, which walks through STEP rows.

@compute @workgroup_size(GROUP)
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    let first = group.y * STEP;
    let count = min(STEP, params.loop_count - first);
    bring(first, params.loop_count, here);
    let b = load_b(params.own_start + min(column, params.own_count - 1u));
    for (var i = 0u; i < count; i++) {
        let value = value_of(walked_frame(i), b);
        if column < params.own_count {
            values[(first + i) * params.own_count + column] = value;
        }
    }
}

// Where a slope goes: one matrix per field of a, then one per field of b.
fn plane(field: u32, row: u32, column: u32) -> u32 {
    return (field * params.loop_count + row) * params.own_count + column;
}

@compute @workgroup_size(GROUP)
fn pairs_grad_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    let first = group.y * STEP;
    let count = min(STEP, params.loop_count - first);
    bring(first, params.loop_count, here);
    let b = load_b(params.own_start + min(column, params.own_count - 1u));
    for (var i = 0u; i < count; i++) {
        let grad = grad_of(walked_frame(i), b);
        if column < params.own_count {
            let row = first + i;
            values[row * params.own_count + column] = grad.value;
            for (var field = 0u; field < 4u; field++) {
                a_bars[plane(field, row, column)] = grad.a.quad[field];
                a_bars[plane(FIELDS + field, row, column)] = grad.b.quad[field];
            }
            if FIELDS > 4u {
                a_bars[plane(4u, row, column)] = grad.a.rest;
                a_bars[plane(FIELDS + 4u, row, column)] = grad.b.rest;
            }
        }
    }
}
