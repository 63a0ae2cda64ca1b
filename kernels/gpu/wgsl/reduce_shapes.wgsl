// Scores of two lists of shapes, computed as they are needed.

fn score_at(own: Own, start: u32, i: u32, here: u32) -> f32 {
    return body_at(own, i)[0];
}
