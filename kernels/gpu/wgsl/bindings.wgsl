// The buffers of kernels over two lists, or over a matrix. Shapes are rows of quads of numbers.

@group(0) @binding(1) var<storage, read> a_quads: array<vec4f>;
@group(0) @binding(2) var<storage, read> b_quads: array<vec4f>;
@group(0) @binding(3) var<storage, read> upstream: array<f32>;
@group(0) @binding(4) var<storage, read_write> values: array<f32>;
@group(0) @binding(5) var<storage, read_write> own_bars: array<f32>;
@group(0) @binding(6) var<storage, read_write> walked_bars: array<f32>;
@group(0) @binding(7) var<storage, read_write> indices: array<u32>;
