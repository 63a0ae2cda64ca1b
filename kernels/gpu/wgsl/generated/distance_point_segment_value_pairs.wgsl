// distance_point_segment Value Pairs: generated from the Rust source, after `ad/program/prelude.wgsl`. To read, not to edit:
// `tests/gpu/committed.rs` says how it is written.

fn body(x: array<f32, 11>) -> array<f32, 1> {
    let a_x = x[0];
    let a_made = x[1];
    let a_y = x[2];
    let a_made_2 = x[3];
    let a_made_3 = x[4];
    let b_to_x = x[5];
    let b_from_x = x[6];
    let b_made = x[7];
    let b_from_y = x[8];
    let b_to_y = x[9];
    let b_made_2 = x[10];
    let v11 = 0e0f;
    let v12 = 1e0f;
    let v13 = b_from_x - a_x;
    let v14 = abs(v13);
    let v15 = b_from_y - a_y;
    let v16 = abs(v15);
    let v17 = max(v14, v16);
    let v18 = b_to_x - a_x;
    let v19 = abs(v18);
    let v20 = b_to_y - a_y;
    let v21 = abs(v20);
    let v22 = max(v19, v21);
    let v23 = max(v17, v22);
    let v24 = max(a_made_3, v23);
    let v25 = v24 <= v11;
    let v26 = select(v24, v12, v25);
    let v27 = program_binade(v26);
    let v28 = b_made * v27;
    let v29 = v28 * v28;
    let v30 = b_made_2 * v27;
    let v31 = v30 * v30;
    let v32 = v29 + v31;
    let v33 = 2.019484e-28f;
    let v34 = v32 <= v33;
    let v35 = 5e-1f;
    let v36 = a_made * v27;
    let v37 = v13 * v27;
    let v38 = v36 - v37;
    let v39 = v28 * v38;
    let v40 = a_made_2 * v27;
    let v41 = v15 * v27;
    let v42 = v40 - v41;
    let v43 = v30 * v42;
    let v44 = v39 + v43;
    let v45 = select(v32, v12, v34);
    let v46 = v44 / v45;
    let v47 = select(v46, v35, v34);
    let v48 = v11 < v47;
    let v49 = v47 < v12;
    let v50 = v48 & v49;
    let v51 = !v34;
    let v52 = v50 & v51;
    let v53 = v28 * v42;
    let v54 = v30 * v38;
    let v55 = v53 - v54;
    let v56 = v55 / v45;
    let v57 = v30 * v56;
    let v58 = -v57;
    let v59 = max(v47, v11);
    let v60 = min(v59, v12);
    let v61 = v28 * v60;
    let v62 = v38 - v61;
    let v63 = select(v62, v58, v52);
    let v64 = -v63;
    let v65 = abs(v64);
    let v66 = v28 * v56;
    let v67 = v30 * v60;
    let v68 = v42 - v67;
    let v69 = select(v68, v66, v52);
    let v70 = -v69;
    let v71 = abs(v70);
    let v72 = max(v65, v71);
    let v73 = v72 <= v11;
    let v74 = select(v72, v12, v73);
    let v75 = program_binade(v74);
    let v76 = v12 / v75;
    let v77 = v63 * v75;
    let v78 = v77 * v77;
    let v79 = v69 * v75;
    let v80 = v79 * v79;
    let v81 = v78 + v80;
    let v82 = program_root(v81);
    let v83 = v76 * v82;
    let v84 = v83 / v27;
    let v85 = v84 + 0.0;
    let v86 = v11 < v85;
    let v87 = select(v11, v85, v86);
    let v88 = v87 + 0.0;
    return array<f32, 1>(v88);
}

const GROUP: u32 = 64u;
const STEP: u32 = 16u;
const STRIP: u32 = 16u;
const LEAST: f32 = -3.4028234663852886e38f;
const OWN_ROWS: bool = false;
const SLOTS: u32 = 1u;
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
// The buffers of kernels over two lists, or over a matrix. Shapes are rows of quads of numbers.

@group(0) @binding(1) var<storage, read> a_quads: array<vec4f>;
@group(0) @binding(2) var<storage, read> b_quads: array<vec4f>;
@group(0) @binding(3) var<storage, read> upstream: array<f32>;
@group(0) @binding(4) var<storage, read_write> values: array<f32>;
@group(0) @binding(5) var<storage, read_write> own_bars: array<f32>;
@group(0) @binding(6) var<storage, read_write> walked_bars: array<f32>;
@group(0) @binding(7) var<storage, read_write> indices: array<u32>;
// Two lists of shapes, around any `body`. All threads read the same walked shape, where it lies: one access serves all,
// and no thread waits for others. The functions that name single numbers (`own_at`, `walked_at`, `body_at`) are generated.

fn walked_of(i: u32) -> Walked {
    return walked_at(params.loop_start + i);
}

alias Own = array<f32, 6>;

fn own_at(item: u32) -> Own {
    let q0 = b_quads[item * 2u + 0u];
    let q1 = b_quads[item * 2u + 1u];
    return Own(q0.x, q0.y, q0.z, q0.w, q1.x, q1.y);
}

alias Walked = array<f32, 5>;

fn walked_at(item: u32) -> Walked {
    let q0 = a_quads[item * 2u + 0u];
    let q1 = a_quads[item * 2u + 1u];
    return Walked(q0.x, q0.y, q0.z, q0.w, q1.x);
}

fn body_at(own: Own, walked: Walked) -> array<f32, 1> {
    return body(array<f32, 11>(walked[0], walked[1], walked[2], walked[3], walked[4], own[0], own[1], own[2], own[3], own[4], own[5]));
}
// Every row with every column: one thread per column, which walks through a strip of rows. Results of several numbers go
// plane by plane (`put_pair`, generated).

@compute @workgroup_size(GROUP)
fn pairs_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let column = group.x * GROUP + here;
    if column >= params.own_count {
        return;
    }
    let own = own_at(params.own_start + column);
    let first = group.y * STRIP;
    let end = min(first + STRIP, params.loop_count);
    for (var i = first; i < end; i++) {
        put_pair(body_at(own, walked_of(i)), params.out_start + i * params.stride + column);
    }
}

fn put_pair(y: array<f32, 1>, at: u32) {
    values[at + 0u * params.plane] = y[0];
}
