// The sum of all scores, column by column and strip by strip.

fn put_total(strip: u32, column: u32, total: f32) {
    values[strip * params.own_count + column] = total;
}
