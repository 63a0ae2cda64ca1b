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
