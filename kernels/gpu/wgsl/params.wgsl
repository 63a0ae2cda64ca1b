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
