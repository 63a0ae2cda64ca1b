// Axis-aligned boxes in a batch.

alias Frame = Aabb2;

fn frame_of(first: vec4f, second: vec4f) -> Aabb2 {
    return Aabb2(first.xy, first.zw);
}

fn value_of(a: Aabb2, b: Aabb2) -> f32 {
    return score_aabb2(a, b);
}

fn bar_of(bar: Aabb2) -> Bar {
    return Bar(vec4f(bar.min, bar.max), 0.0);
}

fn grad_of(a: Aabb2, b: Aabb2) -> Grad {
    let grad = score_aabb2_grad(a, b);
    return Grad(grad.value, bar_of(grad.a_bar), bar_of(grad.b_bar));
}
