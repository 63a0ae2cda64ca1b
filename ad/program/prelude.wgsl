// What programs ask of a number beyond WGSL's own functions, for 32-bit floats.

fn program_root(x: f32) -> f32 {
    return select(0.0, sqrt(max(x, 0.0)), x > 0.0);
}

// The angle of the vector (x, y); of the zero vector 0. Zeros lose their sign first.
fn program_atan2(y: f32, x: f32) -> f32 {
    let origin = (y == 0.0) & (x == 0.0);
    return select(atan2(y + 0.0, select(x + 0.0, 1.0, origin)), 0.0, origin);
}

// The power of two that brings a positive number into [2, 4): exponent field e becomes
// 2 · bias + 1 − e.
fn program_binade(x: f32) -> f32 {
    let normal = select(x, 1.1754944e-38, x < 1.1754944e-38);
    let field = (bitcast<u32>(normal) >> 23u) << 23u;
    return bitcast<f32>((255u << 23u) - field);
}

// The high half of the significand. Bits are masked, which no optimizer can re-associate away.
fn program_high(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

fn program_sin_high(x: f32) -> f32 {
    return program_high(sin(x));
}

fn program_sin_low(x: f32) -> f32 {
    let sine = sin(x);
    return sine - program_high(sine);
}

fn program_cos_high(x: f32) -> f32 {
    return program_high(cos(x));
}

fn program_cos_low(x: f32) -> f32 {
    let cosine = cos(x);
    return cosine - program_high(cosine);
}

// What reaches a of the cotangent of the smaller of a and b.
fn program_split(a: f32, b: f32, bar: f32) -> f32 {
    return select(select(0.0, bar * 0.5, a == b), bar, a < b);
}

// What reaches b of it.
fn program_rest(a: f32, b: f32, bar: f32) -> f32 {
    return select(select(bar, bar * 0.5, a == b), 0.0, a < b);
}
