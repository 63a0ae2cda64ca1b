// The score of an own shape with one that is read where it lies.

fn score_of(own: Own, item: u32) -> f32 {
    return body_at(own, place(item, WALKED))[0];
}
