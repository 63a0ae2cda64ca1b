// Results of two lists of shapes by a generated `body`, computed as they are needed. Shapes are numbers in tiles; what is
// walked is near the threads, number after number, so that neighbours read neighbours. The functions that name single
// numbers (`own_at`, `score_at`) are generated.

@group(0) @binding(1) var<storage, read> a_numbers: array<f32>;
@group(0) @binding(2) var<storage, read> b_numbers: array<f32>;
@group(0) @binding(4) var<storage, read_write> values: array<f32>;
@group(0) @binding(7) var<storage, read_write> indices: array<u32>;

var<workgroup> near: array<f32, STEP * WALKED>;

fn place(item: u32, fields: u32) -> u32 {
    return item / 16u * 16u * fields + item % 16u;
}

fn bring(own: u32, start: u32, end: u32, here: u32) {
    workgroupBarrier();
    for (var k = here; k < STEP * WALKED; k += GROUP) {
        let item = params.loop_start + min(start + k % STEP, end - 1u);
        near[k] = walked_number(place(item, WALKED) + k / STEP * 16u);
    }
    workgroupBarrier();
}
