// Scores of a matrix that is there already.

alias Own = u32;

// Rows that threads stand for are brought close a few columns at a time: a thread that read its own
// row from memory would share no memory access with its neighbours. One column more than there are
// keeps threads on different banks.
var<workgroup> near: array<f32, GROUP * (STEP + 1u)>;

fn own_at(item: u32) -> u32 {
    return item;
}

fn bring(own: u32, start: u32, end: u32, here: u32) {
    if !OWN_ROWS {
        return;
    }
    workgroupBarrier();
    for (var k = here; k < GROUP * STEP; k += GROUP) {
        let row = params.own_start + min(own + k / STEP, params.own_count - 1u);
        let column = min(start + k % STEP, end - 1u);
        near[k / STEP * (STEP + 1u) + k % STEP] = upstream[row * params.loop_count + column];
    }
    workgroupBarrier();
}

fn score_at(own: u32, start: u32, i: u32, here: u32) -> f32 {
    if OWN_ROWS {
        return near[here * (STEP + 1u) + i];
    }
    return upstream[(start + i) * params.own_count + own];
}
