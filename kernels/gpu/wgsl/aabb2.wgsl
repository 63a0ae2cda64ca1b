// Axis-aligned boxes: a pair is the numbers of both, for derivatives followed by their factor.

fn first_of(x: array<f32, TAKES>) -> Aabb2 {
    return Aabb2(vec2f(x[0], x[1]), vec2f(x[2], x[3]));
}

fn second_of(x: array<f32, TAKES>) -> Aabb2 {
    return Aabb2(vec2f(x[4], x[5]), vec2f(x[6], x[7]));
}

fn value_of(x: array<f32, TAKES>) -> array<f32, 1> {
    return array<f32, 1>(score_aabb2(first_of(x), second_of(x)));
}

// The score, then the derivatives of both boxes.
fn grad_of(x: array<f32, TAKES>) -> array<f32, 9> {
    let grad = score_aabb2_grad(first_of(x), second_of(x));
    let seed = x[TAKES - 1u];
    let a = grad.a_bar;
    let b = grad.b_bar;
    return array<f32, 9>(
        grad.value,
        a.min.x * seed,
        a.min.y * seed,
        a.max.x * seed,
        a.max.y * seed,
        b.min.x * seed,
        b.min.y * seed,
        b.max.x * seed,
        b.max.y * seed,
    );
}
