// The adjoint of all pairs, without atomics.
//
// One thread per column walks through a strip of rows. What belongs to its column it sums in
// registers; what belongs to a row is summed across the threads (`row_sum`), tile by tile. Both go
// out as partial sums: one per strip for columns, one per workgroup for rows, which `fold_main`
// adds in a fixed order. What slopes are multiplied by (`seed_at`) is in other files.

var<workgroup> slot_quad: array<vec4f, STEP * SLOTS>;
var<workgroup> slot_rest: array<f32, STEP * SLOTS>;

fn sweep_vjp(group: vec3u, here: u32, slot: u32, lane: u32) {
    let column = group.x * GROUP + here;
    let columns = params.own_count;
    let rows = params.loop_count;
    let first = group.y * STRIP;
    let end = min(first + STRIP, rows);
    let b = load_b(params.own_start + min(column, columns - 1u));
    var column_sum = Bar();
    var total = 0.0;
    for (var start = first; start < end; start += STEP) {
        let count = min(STEP, end - start);
        bring_walked(start, end, here);
        for (var i = 0u; i < count; i++) {
            var a_bar = Bar();
            if column < columns {
                let factor = seed_at(start + i, column);
                let grad = grad_of(walked_frame(i), b);
                total += grad.value;
                a_bar = times(grad.a, factor);
                column_sum = plus(column_sum, times(grad.b, factor));
            }
            row_sum(i, a_bar, here, slot, lane);
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
    if column < columns {
        put_total(group.y, column, total);
        b_bars[(group.y * FIELDS) * columns + column] = column_sum.quad.x;
        b_bars[(group.y * FIELDS + 1u) * columns + column] = column_sum.quad.y;
        b_bars[(group.y * FIELDS + 2u) * columns + column] = column_sum.quad.z;
        b_bars[(group.y * FIELDS + 3u) * columns + column] = column_sum.quad.w;
        if FIELDS > 4u {
            b_bars[(group.y * FIELDS + 4u) * columns + column] = column_sum.rest;
        }
    }
}
