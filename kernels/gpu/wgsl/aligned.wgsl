// Row i with row i: one thread per pair.

@compute @workgroup_size(GROUP)
fn aligned_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    if item < params.own_count {
        values[item] = value_of(load_a(item), load_b(item));
    }
}

@compute @workgroup_size(GROUP)
fn aligned_grad_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    if item < params.own_count {
        let grad = grad_of(load_a(item), load_b(item));
        values[item] = grad.value;
        put_a(item, grad.a);
        put_b(item, grad.b);
    }
}

@compute @workgroup_size(GROUP)
fn aligned_vjp_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    if item < params.own_count {
        let grad = grad_of(load_a(item), load_b(item));
        let factor = upstream[item];
        put_a(item, times(grad.a, factor));
        put_b(item, times(grad.b, factor));
    }
}
