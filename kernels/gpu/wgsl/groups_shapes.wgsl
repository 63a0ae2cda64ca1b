// The score of an own shape with a walked one.

fn score_of(own: Own, i: u32) -> f32 {
    return body_at(own, walked_of(i))[0];
}
