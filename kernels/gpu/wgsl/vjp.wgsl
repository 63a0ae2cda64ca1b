// The adjoint of all pairs for a body that gives the derivatives of both shapes at once, without atomics.
//
// One thread per two columns walks through a strip of rows. What belongs to its columns it sums in
// registers; what belongs to a row is summed across the threads (`row_sum`), tile by tile, which is
// dear, so each thread sums its two columns before. Both go out as partial sums: one per strip for
// columns, one per workgroup for rows, which `fold_main` adds in a fixed order. The factor of a pair's derivatives
// (`seed_at`) is in other files.

var<workgroup> slot_sums: array<f32, STEP * SLOTS * WALKED_BAR>;

// What a thread knows of one column.
struct Column {
    own: Own,
    index: u32,
    sum: OwnBar,
    total: f32,
}

fn column_at(index: u32) -> Column {
    let own = own_at(params.own_start + min(index, params.own_count - 1u));
    return Column(own, index, OwnBar(), 0.0);
}

// One pair: adds to the column, and to what belongs to the row.
fn pull(row: u32, i: u32, column: ptr<function, Column>, bar: ptr<function, WalkedBar>) {
    if (*column).index >= params.own_count {
        return;
    }
    let y = body_at((*column).own, i, seed_at(row, (*column).index));
    (*column).total += y[0];
    var sum = (*column).sum;
    add_own(&sum, y);
    (*column).sum = sum;
    add_walked(bar, y);
}

fn put_column(strip: u32, column: Column) {
    if column.index >= params.own_count {
        return;
    }
    put_total(strip, column.index, column.total);
    put_own(column.sum, column.index, strip);
}

fn sweep_vjp(group: vec3u, here: u32, slot: u32, lane: u32) {
    let rows = params.loop_count;
    let first = group.y * STRIP;
    let end = min(first + STRIP, rows);
    var left = column_at(group.x * 2u * GROUP + here);
    var right = column_at(group.x * 2u * GROUP + GROUP + here);
    for (var start = first; start < end; start += STEP) {
        let count = min(STEP, end - start);
        bring(group.x * 2u * GROUP, start, end, here);
        for (var i = 0u; i < count; i++) {
            var bar = WalkedBar();
            pull(start + i, i, &left, &bar);
            pull(start + i, i, &right, &bar);
            row_sum(i, bar, here, slot, lane);
        }
        workgroupBarrier();
        for (var k = here; k < count * WALKED_BAR; k += GROUP) {
            let i = k / WALKED_BAR;
            let field = k % WALKED_BAR;
            var sum = 0.0;
            for (var s = 0u; s < SLOTS; s++) {
                sum += slot_sums[(i * SLOTS + s) * WALKED_BAR + field];
            }
            walked_bars[(group.x * WALKED_BAR + field) * rows + start + i] = sum;
        }
    }
    put_column(group.y, left);
    put_column(group.y, right);
}
