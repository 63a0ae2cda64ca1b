// Reductions of all pairs that never write the matrix: one thread per own shape (row or column),
// which walks through a strip of the other list. Strips are put together in a fixed order.

fn strip_start(group: vec3u) -> u32 {
    return group.y * STRIP;
}

fn strip_end(group: vec3u) -> u32 {
    return min(group.y * STRIP + STRIP, params.loop_count);
}

// The largest score of each strip and where it is; the first one of several.
@compute @workgroup_size(GROUP)
fn best_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let own = load_own(params.own_start + min(item, params.own_count - 1u));
    let end = strip_end(group);
    var best = -LARGEST;
    var best_at = strip_start(group);
    for (var start = strip_start(group); start < end; start += STEP) {
        bring(start, end, here);
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            let value = score(own, walked_frame(i));
            if value > best {
                best = value;
                best_at = start + i;
            }
        }
    }
    if item < params.own_count {
        values[group.y * params.own_count + item] = best;
        indices[group.y * params.own_count + item] = params.loop_base + best_at;
    }
}

// How many scores of each strip are above the threshold.
@compute @workgroup_size(GROUP)
fn count_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let own = load_own(params.own_start + min(item, params.own_count - 1u));
    let end = strip_end(group);
    var found = 0u;
    for (var start = strip_start(group); start < end; start += STEP) {
        bring(start, end, here);
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            found += select(0u, 1u, score(own, walked_frame(i)) > params.threshold);
        }
    }
    if item < params.own_count {
        indices[item * params.parts + group.y] = found;
    }
}

// Writes them down as (row, column, value), each strip from its place on.
@compute @workgroup_size(GROUP)
fn write_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let own = load_own(params.own_start + min(item, params.own_count - 1u));
    let end = strip_end(group);
    var to = 0u;
    if item < params.own_count {
        to = indices[item * params.parts + group.y];
    }
    for (var start = strip_start(group); start < end; start += STEP) {
        bring(start, end, here);
        let count = min(STEP, end - start);
        for (var i = 0u; i < count; i++) {
            let value = score(own, walked_frame(i));
            if value > params.threshold && item < params.own_count {
                values[3u * to] = bitcast<f32>(params.own_base + item);
                values[3u * to + 1u] = bitcast<f32>(params.loop_base + start + i);
                values[3u * to + 2u] = value;
                to += 1u;
            }
        }
    }
}

// The sum of the scores of each strip, STEP by STEP so that rounding grows slowly.
@compute @workgroup_size(GROUP)
fn sum_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {
    let item = group.x * GROUP + here;
    let own = load_own(params.own_start + min(item, params.own_count - 1u));
    let end = strip_end(group);
    var total = 0.0;
    for (var start = strip_start(group); start < end; start += STEP) {
        bring(start, end, here);
        let count = min(STEP, end - start);
        var sum = 0.0;
        for (var i = 0u; i < count; i++) {
            sum += score(own, walked_frame(i));
        }
        total += sum;
    }
    if item < params.own_count {
        values[group.y * params.own_count + item] = total;
    }
}
