// distance_point_segment ValueGrad Aligned: generated from the Rust source, after `ad/program/prelude.wgsl`. To read, not to edit:
// `tests/gpu/committed.rs` says how it is written.

fn body(x: array<f32, 6>) -> array<f32, 7> {
    let a_x = x[0];
    let a_y = x[1];
    let b_to_x = x[2];
    let b_from_x = x[3];
    let b_from_y = x[4];
    let b_to_y = x[5];
    let v6 = 0e0f;
    let v7 = 1e0f;
    let v8 = b_to_x - b_from_x;
    let v9 = a_x - a_x;
    let v10 = abs(v9);
    let v11 = a_y - a_y;
    let v12 = abs(v11);
    let v13 = max(v10, v12);
    let v14 = b_from_x - a_x;
    let v15 = abs(v14);
    let v16 = b_from_y - a_y;
    let v17 = abs(v16);
    let v18 = max(v15, v17);
    let v19 = b_to_x - a_x;
    let v20 = abs(v19);
    let v21 = b_to_y - a_y;
    let v22 = abs(v21);
    let v23 = max(v20, v22);
    let v24 = max(v18, v23);
    let v25 = max(v13, v24);
    let v26 = v25 <= v6;
    let v27 = select(v25, v7, v26);
    let v28 = program_binade(v27);
    let v29 = v8 * v28;
    let v30 = v29 * v29;
    let v31 = b_to_y - b_from_y;
    let v32 = v31 * v28;
    let v33 = v32 * v32;
    let v34 = v30 + v33;
    let v35 = 2.019484e-28f;
    let v36 = v34 <= v35;
    let v37 = 5e-1f;
    let v38 = v9 * v28;
    let v39 = v14 * v28;
    let v40 = v38 - v39;
    let v41 = v29 * v40;
    let v42 = v11 * v28;
    let v43 = v16 * v28;
    let v44 = v42 - v43;
    let v45 = v32 * v44;
    let v46 = v41 + v45;
    let v47 = select(v34, v7, v36);
    let v48 = v46 / v47;
    let v49 = select(v48, v37, v36);
    let v50 = v6 < v49;
    let v51 = v49 < v7;
    let v52 = v50 & v51;
    let v53 = !v36;
    let v54 = v52 & v53;
    let v55 = v29 * v44;
    let v56 = v32 * v40;
    let v57 = v55 - v56;
    let v58 = v57 / v47;
    let v59 = v32 * v58;
    let v60 = -v59;
    let v61 = max(v49, v6);
    let v62 = min(v61, v7);
    let v63 = v29 * v62;
    let v64 = v40 - v63;
    let v65 = select(v64, v60, v54);
    let v66 = -v65;
    let v67 = abs(v66);
    let v68 = v29 * v58;
    let v69 = v32 * v62;
    let v70 = v44 - v69;
    let v71 = select(v70, v68, v54);
    let v72 = -v71;
    let v73 = abs(v72);
    let v74 = max(v67, v73);
    let v75 = v74 <= v6;
    let v76 = select(v74, v7, v75);
    let v77 = program_binade(v76);
    let v78 = v7 / v77;
    let v79 = v65 * v77;
    let v80 = v79 * v79;
    let v81 = v71 * v77;
    let v82 = v81 * v81;
    let v83 = v80 + v82;
    let v84 = program_root(v83);
    let v85 = v78 * v84;
    let v86 = v85 / v28;
    let v87 = v86 + 0.0;
    let v88 = v6 < v87;
    let v89 = select(v6, v87, v88);
    let v90 = v89 + 0.0;
    let v91 = v6 < v90;
    let v92 = v85 <= v6;
    let v93 = select(v85, v7, v92);
    let v94 = v65 / v93;
    let v95 = -v94;
    let v96 = select(v6, v95, v91);
    let v97 = -v96;
    let v98 = v97 + 0.0;
    let v99 = v71 / v93;
    let v100 = -v99;
    let v101 = select(v6, v100, v91);
    let v102 = -v101;
    let v103 = v102 + 0.0;
    let v104 = v62 * v96;
    let v105 = v96 - v104;
    let v106 = v105 + 0.0;
    let v107 = v62 * v101;
    let v108 = v101 - v107;
    let v109 = v108 + 0.0;
    let v110 = v104 + 0.0;
    let v111 = v107 + 0.0;
    return array<f32, 7>(v90, v98, v103, v106, v109, v110, v111);
}

fn place(item: u32, fields: u32) -> u32 {
    return item / 16u * 16u * fields + item % 16u;
}
@group(0) @binding(0) var<uniform> params: array<vec4u, 6>;
@group(0) @binding(1) var<storage, read> inputs: array<f32>;
@group(0) @binding(2) var<storage, read_write> outputs: array<f32>;

@compute @workgroup_size(64)
fn aligned_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    if item >= params[0].x {
        return;
    }
    let c0 = params[1].x + place(item * params[1].y, 2u);
    let c1 = params[2].x + place(item * params[2].y, 4u);
    let y = body(array<f32, 6>(inputs[c0 + 0u], inputs[c0 + 16u], inputs[c1 + 0u], inputs[c1 + 16u], inputs[c1 + 32u], inputs[c1 + 48u]));
    let r0 = params[3].x + place(item, 1u);
    outputs[r0 + 0u] = y[0];
    let r1 = params[4].x + place(item, 2u);
    outputs[r1 + 0u] = y[1];
    outputs[r1 + 16u] = y[2];
    let r2 = params[5].x + place(item, 4u);
    outputs[r2 + 0u] = y[3];
    outputs[r2 + 16u] = y[4];
    outputs[r2 + 32u] = y[5];
    outputs[r2 + 48u] = y[6];
}
