// The layout of a batch: bindings, loads and stores.
//
// Frames are stored as quads of four numbers, gradients as single fields; both in tiles of TILE
// items, quad after quad (field after field) within a tile, so that neighbouring threads read and
// write neighbouring memory and any run of whole tiles can be bound on its own.

struct Params {
    // Items of the list that threads stand for.
    own_count: u32,
    // Items of the list that every thread walks through.
    loop_count: u32,
    // Where both begin in the bound buffers.
    own_start: u32,
    loop_start: u32,
    // The index of the first walked item in its whole list, and of the first own one.
    loop_base: u32,
    own_base: u32,
    // Partial results to be put together; whether they add to what is there.
    parts: u32,
    more: u32,
    // What scores are compared with, or slopes multiplied by.
    factor: f32,
    fields: u32,
    // Where results of own items begin.
    out_start: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> a_quads: array<vec4f>;
@group(0) @binding(2) var<storage, read> b_quads: array<vec4f>;
@group(0) @binding(3) var<storage, read> upstream: array<f32>;
@group(0) @binding(4) var<storage, read_write> values: array<f32>;
@group(0) @binding(5) var<storage, read_write> a_bars: array<f32>;
@group(0) @binding(6) var<storage, read_write> b_bars: array<f32>;
@group(0) @binding(7) var<storage, read_write> indices: array<u32>;

var<workgroup> walked: array<vec4f, STEP * QUADS>;

// Slopes with respect to one shape, of up to five fields.
struct Bar {
    quad: vec4f,
    rest: f32,
}

struct Grad {
    value: f32,
    a: Bar,
    b: Bar,
}

fn times(bar: Bar, factor: f32) -> Bar {
    return Bar(bar.quad * factor, bar.rest * factor);
}

fn plus(x: Bar, y: Bar) -> Bar {
    return Bar(x.quad + y.quad, x.rest + y.rest);
}

fn place(item: u32, field: u32, fields: u32) -> u32 {
    return (item / TILE * fields + field) * TILE + item % TILE;
}

fn load_a(item: u32) -> Frame {
    return frame_of(a_quads[place(item, 0u, QUADS)], a_quads[place(item, QUADS - 1u, QUADS)]);
}

fn load_b(item: u32) -> Frame {
    return frame_of(b_quads[place(item, 0u, QUADS)], b_quads[place(item, QUADS - 1u, QUADS)]);
}

// Brings STEP walked shapes close to the threads.
fn bring_walked(start: u32, end: u32, here: u32) {
    workgroupBarrier();
    for (var k = here; k < STEP * QUADS; k += GROUP) {
        let item = params.loop_start + min(start + k / QUADS, end - 1u);
        if OWN_ROWS {
            walked[k] = b_quads[place(item, k % QUADS, QUADS)];
        } else {
            walked[k] = a_quads[place(item, k % QUADS, QUADS)];
        }
    }
    workgroupBarrier();
}

fn walked_frame(k: u32) -> Frame {
    return frame_of(walked[k * QUADS], walked[k * QUADS + QUADS - 1u]);
}
