// Two lists of shapes, around any `body`. Walked shapes are near the threads, number after number, so that neighbours read
// neighbours. The functions that name single numbers (`own_at`, `walked_number`, `body_at`) are generated.

var<workgroup> near: array<f32, STEP * WALKED>;

fn bring(own: u32, start: u32, end: u32, here: u32) {
    workgroupBarrier();
    for (var k = here; k < STEP * WALKED; k += GROUP) {
        let item = params.loop_start + min(start + k % STEP, end - 1u);
        near[k] = walked_number(place(item, WALKED) + k / STEP * 16u);
    }
    workgroupBarrier();
}
