// The parameters of kernels over two lists, or over a matrix of their pairs.

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
    // The threshold of scores, or the factor of derivatives.
    factor: f32,
    fields: u32,
    // Where results of own items, or numbers of a matrix, begin.
    out_start: u32,
    // Numbers of a row of a matrix, and of a whole plane of it.
    stride: u32,
    plane: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
