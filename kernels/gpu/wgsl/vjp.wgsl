// The adjoint of all pairs, without atomics.
//
// One thread per two columns walks through a strip of rows. What belongs to its columns it sums in
// registers; what belongs to a row is summed across the threads (`row_sum`), tile by tile, which is
// dear, so each thread sums its two columns before. Both go out as partial sums: one per strip for
// columns, one per workgroup for rows, which `fold_main` adds in a fixed order. What slopes are
// multiplied by (`seed_at`) is in other files.

var<workgroup> slot_quad: array<vec4f, STEP * SLOTS>;
var<workgroup> slot_rest: array<f32, STEP * SLOTS>;

// What a thread knows of one column.
struct Column {
    b: Frame,
    index: u32,
    sum: Bar,
    total: f32,
}

fn column_at(index: u32) -> Column {
    let b = load_b(params.own_start + min(index, params.own_count - 1u));
    return Column(b, index, Bar(), 0.0);
}

// One pair: adds to the column, and gives what belongs to the row.
fn pull(a: Frame, row: u32, column: ptr<function, Column>) -> Bar {
    if (*column).index >= params.own_count {
        return Bar();
    }
    let factor = seed_at(row, (*column).index);
    let grad = grad_of(a, (*column).b);
    (*column).total += grad.value;
    (*column).sum = plus((*column).sum, times(grad.b, factor));
    return times(grad.a, factor);
}

fn put_column(strip: u32, column: Column) {
    if column.index >= params.own_count {
        return;
    }
    put_total(strip, column.index, column.total);
    let at = strip * FIELDS * params.own_count + column.index;
    b_bars[at] = column.sum.quad.x;
    b_bars[at + params.own_count] = column.sum.quad.y;
    b_bars[at + 2u * params.own_count] = column.sum.quad.z;
    b_bars[at + 3u * params.own_count] = column.sum.quad.w;
    if FIELDS > 4u {
        b_bars[at + 4u * params.own_count] = column.sum.rest;
    }
}

fn sweep_vjp(group: vec3u, here: u32, slot: u32, lane: u32) {
    let rows = params.loop_count;
    let first = group.y * STRIP;
    let end = min(first + STRIP, rows);
    var left = column_at(group.x * 2u * GROUP + here);
    var right = column_at(group.x * 2u * GROUP + GROUP + here);
    for (var start = first; start < end; start += STEP) {
        let count = min(STEP, end - start);
        bring_walked(start, end, here);
        for (var i = 0u; i < count; i++) {
            let a = walked_frame(i);
            let by_left = pull(a, start + i, &left);
            let by_right = pull(a, start + i, &right);
            row_sum(i, plus(by_left, by_right), here, slot, lane);
        }
        workgroupBarrier();
        for (var k = here; k < count * FIELDS; k += GROUP) {
            let i = k / FIELDS;
            let field = k % FIELDS;
            var sum = 0.0;
            for (var s = 0u; s < SLOTS; s++) {
                if field < 4u {
                    sum += slot_quad[i * SLOTS + s][field];
                } else {
                    sum += slot_rest[i * SLOTS + s];
                }
            }
            a_bars[(group.x * FIELDS + field) * rows + start + i] = sum;
        }
    }
    put_column(group.y, left);
    put_column(group.y, right);
}
