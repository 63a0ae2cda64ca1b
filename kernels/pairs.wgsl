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

// Slopes go out as planes: for each row one run of columns per field.
@compute @workgroup_size(GROUP)
fn pairs_grad_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    let columns = params.own_count;
    let first = group.y * STEP;
    let count = min(STEP, params.loop_count - first);
    bring(first, params.loop_count, here);
    let b = load_b(params.own_start + min(column, columns - 1u));
    for (var i = 0u; i < count; i++) {
        let grad = grad_of(walked_frame(i), b);
        if column < columns {
            let row = first + i;
            values[row * columns + column] = grad.value;
            for (var field = 0u; field < 4u; field++) {
                a_bars[(row * 2u * FIELDS + field) * columns + column] = grad.a.quad[field];
                a_bars[(row * 2u * FIELDS + FIELDS + field) * columns + column] = grad.b.quad[field];
            }
            if FIELDS > 4u {
                a_bars[(row * 2u * FIELDS + 4u) * columns + column] = grad.a.rest;
                a_bars[(row * 2u * FIELDS + FIELDS + 4u) * columns + column] = grad.b.rest;
            }
        }
    }
}
