// What programs ask of a number beyond WGSL's own functions, for 32-bit floats.

fn program_root(x: f32) -> f32 {
    return select(0.0, sqrt(max(x, 0.0)), x > 0.0);
}

// The number itself. A driver that reorders sums does not see through it: the bits of one NaN would change.
fn program_kept(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    return bitcast<f32>(bits ^ select(0u, 1u, bits == 0x7fffffffu));
}

// WGSL promises of its own sines, exponentials, logarithms and angles little (of an angle four thousand
// units in the last place), and drivers use that. These are polynomials of the Cephes library (Moshier
// 1992), right to about two units in the last place on any driver.

// The angle of the vector (x, y); of the zero vector 0. Zeros lose their sign first.
fn program_atan2(y: f32, x: f32) -> f32 {
    let across = abs(x);
    let along = abs(y);
    let large = max(across, along);
    let tangent = min(across, along) / select(large, 1.0, large == 0.0);
    let steep = tangent > 0.41421356;
    let t = select(tangent, (tangent - 1.0) / (tangent + 1.0), steep);
    let z = t * t;
    let part = (((0.0805374449538 * z - 0.138776856032) * z + 0.199777106478) * z - 0.333329491539) * z * t + t;
    let octant = select(part, part + 0.78539816, steep);
    let quadrant = select(octant, 1.5707963 - octant, along > across);
    let half = select(quadrant, 3.1415927 - quadrant, x < 0.0);
    return select(half, -half, y < 0.0);
}

// The quarter turns nearest to an angle, and the rest.
fn program_turned(x: f32) -> vec2f {
    let n = floor(x * 0.63661977 + 0.5);
    let rest = ((x - n * 1.5703125) - n * 0.0004837512969970703125) - n * 7.549789948768648e-8;
    return vec2f(n - 4.0 * floor(n * 0.25), rest);
}

fn program_near_sin(x: f32) -> f32 {
    let z = x * x;
    return ((-0.00019515295891 * z + 0.0083321608736) * z - 0.16666654611) * z * x + x;
}

fn program_near_cos(x: f32) -> f32 {
    let z = x * x;
    return ((0.000024433157118 * z - 0.0013887316255) * z + 0.041666645683) * z * z - 0.5 * z + 1.0;
}

// The sine of a rest after so many quarter turns.
fn program_sin_after(turns: f32, x: f32) -> f32 {
    let is_odd = (turns == 1.0) | (turns == 3.0);
    let sine = select(program_near_sin(x), program_near_cos(x), is_odd);
    return select(sine, -sine, turns > 1.5);
}

fn program_sin(x: f32) -> f32 {
    let turned = program_turned(x);
    return program_sin_after(turned.x, turned.y);
}

fn program_cos(x: f32) -> f32 {
    let turned = program_turned(x);
    return program_sin_after(select(turned.x + 1.0, 0.0, turned.x == 3.0), turned.y);
}

// Two to a whole power, in two steps, as a number alone does not reach both ends.
fn program_scaled(x: f32, power: f32) -> f32 {
    let half = floor(power * 0.5);
    let first = bitcast<f32>(u32(i32(half) + 127) << 23u);
    let second = bitcast<f32>(u32(i32(power - half) + 127) << 23u);
    return x * first * second;
}

fn program_exp(x: f32) -> f32 {
    let inside = clamp(x, -120.0, 120.0);
    let n = floor(1.442695 * inside + 0.5);
    let r = (inside - n * 0.693359375) + n * 0.00021219444;
    let p = ((((0.00019875691500 * r + 0.0013981999507) * r + 0.0083334519073) * r + 0.041665795894) * r
        + 0.16666665459) * r + 0.50000001201;
    return program_scaled(p * r * r + r + 1.0, n);
}

fn program_ln(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    let fraction = bitcast<f32>((bits & 0x7fffffu) | 0x3f000000u);
    let is_low = fraction < 0.70710678;
    let e = f32(i32(bits >> 23u) - 126) - select(0.0, 1.0, is_low);
    let m = select(fraction, fraction + fraction, is_low) - 1.0;
    let z = m * m;
    let p = ((((((((0.070376836292 * m - 0.11514610310) * m + 0.11676998740) * m - 0.12420140846) * m
        + 0.14249322787) * m - 0.16668057665) * m + 0.20000714765) * m - 0.24999993993) * m
        + 0.33333331174) * m * z;
    let near = (m + ((p - 0.00021219444 * e) - 0.5 * z)) + 0.693359375 * e;
    // Zero, negative and infinite numbers as the driver has it.
    return select(log(x), near, (x >= 1.1754944e-38) & (x <= 3.4028234e38));
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
    return program_high(program_sin(x));
}

fn program_sin_low(x: f32) -> f32 {
    let sine = program_sin(x);
    return sine - program_high(sine);
}

fn program_cos_high(x: f32) -> f32 {
    return program_high(program_cos(x));
}

fn program_cos_low(x: f32) -> f32 {
    let cosine = program_cos(x);
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
