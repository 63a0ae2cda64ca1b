// Rotated boxes in a batch.

alias Frame = Framed;

fn frame_of(first: vec4f, second: vec4f) -> Framed {
    return Framed(
        first.xy,
        first.zw,
        second.x + second.y,
        second.z + second.w,
        second.x,
        second.y,
        second.z,
        second.w,
    );
}

fn value_of(a: Framed, b: Framed) -> f32 {
    return score_framed(a, b);
}

fn bar_of(bar: Obb2) -> Bar {
    return Bar(vec4f(bar.center, bar.size), bar.heading);
}

fn grad_of(a: Framed, b: Framed) -> Grad {
    let grad = score_framed_grad(a, b);
    return Grad(grad.value, bar_of(grad.a_bar), bar_of(grad.b_bar));
}
