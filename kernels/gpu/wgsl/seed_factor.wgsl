// One factor for the derivatives of all pairs.

fn seed_at(walked: u32, own: u32) -> f32 {
    return params.factor;
}
