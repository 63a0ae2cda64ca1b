// The score of a pair and its slopes: one matrix per field of a, then one per field of b.

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

fn put_pair(a: Frame, b: Frame, row: u32, column: u32) {
    let grad = grad_of(a, b);
    if column < params.own_count {
        values[row * params.own_count + column] = grad.value;
        put_planes(0u, row, column, grad.a);
        put_planes(FIELDS, row, column, grad.b);
    }
}
