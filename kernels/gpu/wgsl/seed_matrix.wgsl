// Slopes are multiplied by an upstream matrix.

fn seed_at(row: u32, column: u32) -> f32 {
    return upstream[row * params.own_count + column];
}

fn put_total(strip: u32, column: u32, total: f32) {}
