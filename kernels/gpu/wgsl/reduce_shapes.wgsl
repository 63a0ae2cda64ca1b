// Scores of two lists of shapes, computed as they are needed.

alias Own = Frame;

fn own_at(item: u32) -> Frame {
    if OWN_ROWS {
        return load_a(item);
    }
    return load_b(item);
}

fn bring(own: u32, start: u32, end: u32, here: u32) {
    bring_walked(start, end, here);
}

// In the order a, b.
fn score_at(own: Frame, start: u32, i: u32, here: u32) -> f32 {
    if OWN_ROWS {
        return value_of(own, walked_frame(i));
    }
    return value_of(walked_frame(i), own);
}
