// The scalar: what the generic source asks of a number, for 32-bit floats.

// `yes` where the mask is true, else `no`.
fn choose(mask: bool, yes: f32, no: f32) -> f32 {
    return select(no, yes, mask);
}

// One instruction where a comparison and a choice are two. Nothing here is ever NaN, and of two
// zeros either will do.
fn least(x: f32, other: f32) -> f32 {
    return min(x, other);
}

fn most(x: f32, other: f32) -> f32 {
    return max(x, other);
}

// The Rust name is `clamp`, which WGSL already gives to something else.
fn clamped(x: f32, low: f32, high: f32) -> f32 {
    return least(most(x, low), high);
}

fn halved(x: f32) -> f32 {
    return x * 0.5;
}

fn signed_as(x: f32, side: f32) -> f32 {
    return choose(side < 0.0, -x, x);
}

fn saturated(x: f32) -> f32 {
    return choose(x < -LARGEST, -LARGEST, choose(x > LARGEST, LARGEST, x));
}

fn root(x: f32) -> f32 {
    return choose(x > 0.0, sqrt(most(x, 0.0)), 0.0);
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes
// 2 · bias + 1 − e.
fn binade(x: f32) -> f32 {
    let normal = choose(x < SMALLEST_NORMAL, SMALLEST_NORMAL, x);
    let field = (bitcast<u32>(normal) >> 23u) << 23u;
    return bitcast<f32>((255u << 23u) - field);
}

// The high half of the significand. Bits are masked, which no optimizer can re-associate away.
fn high_half(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & HIGH_HALF);
}

// The number itself. A driver that reorders sums does not see through it: the bits of one NaN would change.
fn kept(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    return bitcast<f32>(bits ^ select(0u, 1u, bits == 0x7fffffffu));
}

fn hypot(x: f32, other: f32) -> f32 {
    let large = most(abs(x), abs(other));
    let scale = binade(choose(large <= 0.0, 1.0, large));
    let back = 1.0 / scale;
    return root((x * scale) * (x * scale) + (other * scale) * (other * scale)) * back;
}
