// The score of a pair.

fn put_pair(a: Frame, b: Frame, row: u32, column: u32) {
    let value = value_of(a, b);
    if column < params.own_count {
        values[row * params.own_count + column] = value;
    }
}
