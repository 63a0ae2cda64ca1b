// length_of_polyline Fold: generated from the Rust source, after `ad/program/prelude.wgsl`. To read, not to edit:
// `tests/gpu/committed.rs` says how it is written.

fn fold_edge(x: array<f32, 4>) -> array<f32, 1> {
    let v0 = 1e0f;
    let v1 = x[2];
    let v2 = x[0];
    let v3 = v1 - v2;
    let v4 = abs(v3);
    let v5 = x[3];
    let v6 = x[1];
    let v7 = v5 - v6;
    let v8 = abs(v7);
    let v9 = max(v4, v8);
    let v10 = 0e0f;
    let v11 = v9 <= v10;
    let v12 = select(v9, v0, v11);
    let v13 = program_binade(v12);
    let v14 = v0 / v13;
    let v15 = v3 * v13;
    let v16 = v15 * v15;
    let v17 = v7 * v13;
    let v18 = v17 * v17;
    let v19 = v16 + v18;
    let v20 = program_root(v19);
    let v21 = v14 * v20;
    let v22 = v21 + 0.0;
    return array<f32, 1>(v22);
}

fn fold_join(x: array<f32, 2>) -> array<f32, 1> {
    let v0 = x[0];
    let v1 = x[1];
    let v2 = v0 + v1;
    let v3 = v2 + 0.0;
    return array<f32, 1>(v3);
}

fn fold_finish(x: array<f32, 1>) -> array<f32, 1> {
    let v0 = 3.4028234663852886e38f;
    let v1 = x[0];
    let v2 = v0 < v1;
    let v3 = select(v1, v0, v2);
    let v4 = -3.4028234663852886e38f;
    let v5 = v3 < v4;
    let v6 = select(v3, v4, v5);
    let v7 = v6 + 0.0;
    return array<f32, 1>(v7);
}
@group(0) @binding(0) var<uniform> params: array<vec4u, 1>;
@group(0) @binding(1) var<storage, read> offsets: array<u32>;
@group(0) @binding(2) var<storage, read> vertices: array<vec2f>;
@group(0) @binding(3) var<storage, read> shared_numbers: array<f32>;
@group(0) @binding(4) var<storage, read_write> outputs: array<f32>;

@compute @workgroup_size(64)
fn fold_main(@builtin(global_invocation_id) thread: vec3u) {
    let path = thread.x;
    if path >= params[0].x {
        return;
    }
    let start = offsets[path];
    let count = offsets[path + 1u] - start;
    let edges = max(count, 1u) - 1u;
    _ = shared_numbers[0];
    var state0 = bitcast<f32>(0u);
    for (var k = 0u; k < edges; k++) {
        let next = select(k + 1u, 0u, k + 1u == count);
        let tail = vertices[start + k];
        let tip = vertices[start + next];
        let edge = fold_edge(array<f32, 4>(tail.x, tail.y, tip.x, tip.y));
        let joined = fold_join(array<f32, 2>(state0, edge[0]));
        state0 = joined[0];
    }
    let y = fold_finish(array<f32, 1>(state0));
    outputs[path * 1u + 0u] = y[0];
}
