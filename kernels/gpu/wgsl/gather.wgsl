// Puts the strips of a reduction together.

@group(0) @binding(8) var<storage, read> strip_indices: array<u32>;

// The largest of all strips and of what is there already; the first one of several.
@compute @workgroup_size(GROUP)
fn best_of_strips_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    if item >= params.own_count {
        return;
    }
    var best = LEAST;
    var best_at = 0u;
    if params.more == 1u {
        best = values[params.out_start + item];
        best_at = indices[params.out_start + item];
    }
    for (var part = 0u; part < params.parts; part++) {
        let value = upstream[part * params.own_count + item];
        if value > best || (params.more == 0u && part == 0u) {
            best = value;
            best_at = strip_indices[part * params.own_count + item];
        }
    }
    values[params.out_start + item] = best;
    indices[params.out_start + item] = best_at;
}

var<workgroup> sums: array<u32, GROUP>;

// Turns counts into places: each becomes the sum of all before it, and the last entry the sum of
// all. One workgroup walks through the list, every thread with a run of its own.
@compute @workgroup_size(GROUP)
fn places_main(@builtin(local_invocation_index) here: u32) {
    var before = 0u;
    for (var start = 0u; start < params.own_count; start += GROUP * RUN) {
        let first = start + here * RUN;
        let end = min(first + RUN, params.own_count);
        var count = 0u;
        for (var item = first; item < end; item++) {
            count += indices[item];
        }
        workgroupBarrier();
        sums[here] = count;
        for (var reach = 1u; reach < GROUP; reach *= 2u) {
            workgroupBarrier();
            var left = 0u;
            if here >= reach {
                left = sums[here - reach];
            }
            workgroupBarrier();
            sums[here] += left;
        }
        workgroupBarrier();
        var at = before + sums[here] - count;
        for (var item = first; item < end; item++) {
            let own = indices[item];
            indices[item] = at;
            at += own;
        }
        before += sums[GROUP - 1u];
    }
    if here == 0u {
        indices[params.own_count] = before;
    }
}

// Numbers to another buffer.
@compute @workgroup_size(GROUP)
fn copy_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < params.own_count {
        let item = params.own_start + thread.x;
        values[item] = upstream[item];
    }
}
