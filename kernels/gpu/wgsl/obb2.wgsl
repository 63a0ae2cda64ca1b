// Rotated boxes: a pair is the numbers of both frames, for derivatives followed by their factor. Sines and cosines are the
// sums of their parts, two numbers less to read.

fn first_of(x: array<f32, TAKES>) -> Framed {
    return Framed(vec2f(x[0], x[1]), vec2f(x[2], x[3]), x[6] + x[7], x[8] + x[9], x[6], x[7], x[8], x[9]);
}

fn second_of(x: array<f32, TAKES>) -> Framed {
    return Framed(vec2f(x[10], x[11]), vec2f(x[12], x[13]), x[16] + x[17], x[18] + x[19], x[16], x[17], x[18], x[19]);
}

fn value_of(x: array<f32, TAKES>) -> array<f32, 1> {
    return array<f32, 1>(score_framed(first_of(x), second_of(x)));
}

// The score, then the derivatives of both boxes.
fn grad_of(x: array<f32, TAKES>) -> array<f32, 11> {
    let grad = score_framed_grad(first_of(x), second_of(x));
    let seed = x[TAKES - 1u];
    let a = grad.a_bar;
    let b = grad.b_bar;
    return array<f32, 11>(
        grad.value,
        a.center.x * seed,
        a.center.y * seed,
        a.size.x * seed,
        a.size.y * seed,
        a.heading * seed,
        b.center.x * seed,
        b.center.y * seed,
        b.size.x * seed,
        b.size.y * seed,
        b.heading * seed,
    );
}
