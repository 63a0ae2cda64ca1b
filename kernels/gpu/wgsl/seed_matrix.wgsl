// A factor for every pair, out of a matrix.

fn seed_at(walked: u32, own: u32) -> f32 {
    if OWN_ROWS {
        return upstream[params.out_start + own * params.stride + walked];
    }
    return upstream[params.out_start + walked * params.stride + own];
}
