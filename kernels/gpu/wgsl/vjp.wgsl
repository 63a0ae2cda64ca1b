// The adjoint of all pairs for a body that gives the derivatives of both shapes at once, without atomics.
//
// One thread per two columns walks through a strip of rows. What belongs to its columns it sums in
// registers; what belongs to a row is summed across the threads (`row_sum`), tile by tile, which is
// dear, so each thread sums its two columns before. Both go out as partial sums: one per strip for
// columns, one per workgroup for rows, which `fold_main` adds in a fixed order. The factor of a pair's derivatives
// (`seed_at`) is in other files.

var<workgroup> slot_sums: array<WalkedBar, STEP * SLOTS>;

fn put_column(strip: u32, column: u32, sum: OwnBar, total: f32) {
    if column < params.own_count {
        put_total(strip, column, total);
        put_own(sum, column, strip);
    }
}

fn sweep_vjp(group: vec3u, here: u32, slot: u32, lane: u32) {
    let rows = params.loop_count;
    let first = group.y * STRIP;
    let end = min(first + STRIP, rows);
    let column = group.x * 2u * GROUP + here;
    let other_column = column + GROUP;
    let own = own_at(params.own_start + min(column, params.own_count - 1u));
    let other = own_at(params.own_start + min(other_column, params.own_count - 1u));
    var sum = OwnBar();
    var other_sum = OwnBar();
    var total = 0.0;
    var other_total = 0.0;
    for (var start = first; start < end; start += STEP) {
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            let row = start + i;
            let walked = walked_of(row);
            var bar = WalkedBar();
            if column < params.own_count {
                let y = body_at(own, walked, seed_at(row, column));
                total += y[0];
                add_own(&sum, y);
                add_walked(&bar, y);
            }
            if other_column < params.own_count {
                let y = body_at(other, walked, seed_at(row, other_column));
                other_total += y[0];
                add_own(&other_sum, y);
                add_walked(&bar, y);
            }
            row_sum(i, bar, here, slot, lane);
        }
        workgroupBarrier();
        for (var k = here; k < count * WALKED_BAR; k += GROUP) {
            let i = k / WALKED_BAR;
            let field = k % WALKED_BAR;
            var sum_of_row = 0.0;
            for (var s = 0u; s < SLOTS; s++) {
                sum_of_row += slot_sums[i * SLOTS + s][field];
            }
            walked_bars[(group.x * WALKED_BAR + field) * rows + start + i] = sum_of_row;
        }
        // The next step writes to the slots.
        workgroupBarrier();
    }
    put_column(group.y, column, sum, total);
    put_column(group.y, other_column, other_sum, other_total);
}
