// length_of_polyline FoldDerivatives: generated from the Rust source, after `ad/program/prelude.wgsl`. To read, not to edit:
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

fn fold_edge_vjp(x: array<f32, 5>) -> array<f32, 4> {
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
    let v21 = v10 < v19;
    let v22 = x[4];
    let v23 = v14 * v22;
    let v24 = 5e-1f;
    let v25 = v23 * v24;
    let v26 = select(v0, v20, v21);
    let v27 = v25 / v26;
    let v28 = select(v10, v27, v21);
    let v29 = v15 * v28;
    let v30 = v29 + v29;
    let v31 = v13 * v30;
    let v32 = -v31;
    let v33 = select(v10, v32, v21);
    let v34 = v33 + 0.0;
    let v35 = v17 * v28;
    let v36 = v35 + v35;
    let v37 = v13 * v36;
    let v38 = -v37;
    let v39 = select(v10, v38, v21);
    let v40 = v39 + 0.0;
    let v41 = select(v10, v31, v21);
    let v42 = v41 + 0.0;
    let v43 = select(v10, v37, v21);
    let v44 = v43 + 0.0;
    return array<f32, 4>(v34, v40, v42, v44);
}
fn fold_join_vjp(x: array<f32, 3>) -> array<f32, 2> {
    let v0 = x[2];
    let v1 = v0 + 0.0;
    return array<f32, 2>(v1, v1);
}
fn fold_finish_vjp(x: array<f32, 2>) -> array<f32, 1> {
    let v0 = 3.4028235e38f;
    let v1 = x[0];
    let v2 = v0 < v1;
    let v3 = select(v1, v0, v2);
    let v4 = -3.4028235e38f;
    let v5 = v3 < v4;
    let v6 = !v5;
    let v7 = !v2;
    let v8 = v6 & v7;
    let v9 = x[1];
    let v10 = 0e0f;
    let v11 = select(v10, v9, v8);
    let v12 = v11 + 0.0;
    return array<f32, 1>(v12);
}
@group(0) @binding(0) var<uniform> params: array<vec4u, 1>;
@group(0) @binding(1) var<storage, read> offsets: array<u32>;
@group(0) @binding(2) var<storage, read> vertices: array<vec2f>;
@group(0) @binding(3) var<storage, read> shared_numbers: array<f32>;
@group(0) @binding(4) var<storage, read> upstream: array<f32>;
@group(0) @binding(5) var<storage, read_write> before: array<f32>;
@group(0) @binding(6) var<storage, read_write> context_bars: array<f32>;
@group(0) @binding(7) var<storage, read_write> path_bars: array<f32>;

@compute @workgroup_size(64)
fn fold_slopes_main(@builtin(global_invocation_id) thread: vec3u) {
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
        before[(start + k) * 1u + 0u] = state0;
        let next = select(k + 1u, 0u, k + 1u == count);
        let tail = vertices[start + k];
        let tip = vertices[start + next];
        let told = fold_edge(array<f32, 4>(tail.x, tail.y, tip.x, tip.y));
        let joined = fold_join(array<f32, 2>(state0, told[0]));
        state0 = joined[0];
    }
    let ended = fold_finish_vjp(array<f32, 2>(state0, upstream[path * 1u + 0u]));
    var bar0 = ended[0];
    for (var i = edges; i > 0u; i--) {
        let k = i - 1u;
        state0 = before[(start + k) * 1u + 0u];
        let next = select(k + 1u, 0u, k + 1u == count);
        let tail = vertices[start + k];
        let tip = vertices[start + next];
        let told = fold_edge(array<f32, 4>(tail.x, tail.y, tip.x, tip.y));
        let pulled = fold_join_vjp(array<f32, 3>(state0, told[0], bar0));
        bar0 = pulled[0];
        let slopes = fold_edge_vjp(array<f32, 5>(tail.x, tail.y, tip.x, tip.y, pulled[1]));
        path_bars[2u * (start + k) + 0u] += slopes[0];
        path_bars[2u * (start + k) + 1u] += slopes[1];
        path_bars[2u * (start + next) + 0u] += slopes[2];
        path_bars[2u * (start + next) + 1u] += slopes[3];
    }
    context_bars[path] = 0.0;
}
