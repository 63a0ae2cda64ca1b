// Scores of two lists of shapes, computed as they are needed.

fn bring(own: u32, start: u32, end: u32, here: u32) {}

fn score_at(own: Own, start: u32, i: u32, here: u32) -> f32 {
    return body_at(own, walked_of(start + i))[0];
}
