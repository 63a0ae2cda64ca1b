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

fn put_planes(first: u32, row: u32, column: u32, bar: Bar) {
    a_bars[plane(first, row, column)] = bar.quad.x;
    a_bars[plane(first + 1u, row, column)] = bar.quad.y;
    a_bars[plane(first + 2u, row, column)] = bar.quad.z;
    a_bars[plane(first + 3u, row, column)] = bar.quad.w;
    if FIELDS > 4u {
        a_bars[plane(first + 4u, row, column)] = bar.rest;
    }
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
            put_planes(0u, row, column, grad.a);
            put_planes(FIELDS, row, column, grad.b);
        }
    }
}
