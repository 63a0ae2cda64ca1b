// Entry points of the measures of rings.

@compute @workgroup_size(GROUP)
fn signed_area_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        values[thread.x] = signed_area(thread.x);
    }
}

@compute @workgroup_size(GROUP)
fn signed_area_vjp_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        signed_area_vjp(thread.x, upstream[thread.x]);
    }
}

@compute @workgroup_size(GROUP)
fn perimeter_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        values[thread.x] = perimeter(thread.x);
    }
}

@compute @workgroup_size(GROUP)
fn perimeter_vjp_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        perimeter_vjp(thread.x, upstream[thread.x]);
    }
}

@compute @workgroup_size(GROUP)
fn centroid_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        let at = centroid(thread.x);
        values[2u * thread.x] = at.x;
        values[2u * thread.x + 1u] = at.y;
    }
}

@compute @workgroup_size(GROUP)
fn centroid_vjp_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.rings {
        centroid_vjp(thread.x, vec2f(upstream[2u * thread.x], upstream[2u * thread.x + 1u]));
    }
}
