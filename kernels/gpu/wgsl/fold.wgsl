// Adds partial sums in a fixed order: one thread per item and field.

@compute @workgroup_size(GROUP)
fn fold_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    let field = thread.y;
    if item >= params.own_count {
        return;
    }
    var sum = 0.0;
    for (var part = 0u; part < params.parts; part++) {
        sum += upstream[(part * params.fields + field) * params.own_count + item];
    }
    values[field * params.own_count + item] = sum;
}
