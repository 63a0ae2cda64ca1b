//! Graphics: colours and tones.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, dot, literals, step};
use geograd::Scalar;
use std::array::from_fn;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(luminance, luminance_derivatives, [[0.0, 1.0], [0.0, 1.0], [0.0, 1.0]],
        wrong ["linear part forgotten": luminance_power_only, "gamma taken as 2.2": luminance_plain_gamma]),
    row!(filmic_tone, filmic_tone_derivatives, [[0.0, 10.0], [0.2, 2.0]],
        wrong ["only the numerator": filmic_tone_numerator]),
    row!(reinhard_tone, reinhard_tone_derivatives, [[0.0, 10.0], [1.0, 5.0]],
        wrong ["white point squared once more": reinhard_tone_white]),
    row!(saturation, saturation_derivatives, [[0.1, 1.0], [0.1, 1.0], [0.1, 1.0]],
        kinks [[0.5, 0.5, 0.25], [0.5, 0.25, 0.25], [0.5, 0.5, 0.5]],
        wrong ["smallest channel forgotten": saturation_no_least]),
    row!(lightness, lightness_derivatives, [[0.0, 1.0], [0.8, 1.2]],
        wrong ["white point has no derivative": lightness_fixed_white]),
];

const CHANNELS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// A channel of sRGB as linear light.
fn linear<S: Scalar>(c: S) -> S {
    // At the joint of the two parts the published constants leave a step of 3e-9.
    let power = (S::lit(2.4) * ((c + S::lit(0.055)) / S::lit(1.055)).ln()).exp();
    S::select(c.at_most(S::lit(0.04045)), c / S::lit(12.92), power)
}
fn linear_derivative<S: Scalar>(c: S) -> S {
    let base = (c + S::lit(0.055)) / S::lit(1.055);
    let power = S::lit(2.4 / 1.055) * (S::lit(1.4) * base.ln()).exp();
    S::select(c.at_most(S::lit(0.04045)), S::one() / S::lit(12.92), power)
}
/// The luminance of a colour in sRGB.
fn luminance<S: Scalar>(c: [S; 3]) -> S {
    dot(literals::<S, _>(CHANNELS), c.map(linear))
}
fn luminance_derivatives<S: Scalar>(c: [S; 3]) -> [S; 3] {
    let w = literals::<S, _>(CHANNELS);
    from_fn(|i| w[i] * linear_derivative(c[i]))
}
fn luminance_power_only(c: [f64; 3]) -> [f64; 3] {
    from_fn(|i| CHANNELS[i] * 2.4 / 1.055 * ((c[i] + 0.055) / 1.055).powf(1.4))
}
fn luminance_plain_gamma(c: [f64; 3]) -> [f64; 3] {
    from_fn(|i| CHANNELS[i] * 2.2 * c[i].powf(1.2))
}

/// A filmic tone curve between zero and one: light and exposure.
fn filmic_tone<S: Scalar>([light, exposure]: [S; 2]) -> S {
    let [a, b, c, d, e] = literals::<S, _>([2.51, 0.03, 2.43, 0.59, 0.14]);
    let x = light * exposure;
    (x * (a * x + b) / (x * (c * x + d) + e)).clamp(S::zero(), S::one())
}
fn filmic_tone_derivatives<S: Scalar>([light, exposure]: [S; 2]) -> [S; 2] {
    let [a, b, c, d, e, two] = literals::<S, _>([2.51, 0.03, 2.43, 0.59, 0.14, 2.0]);
    let x = light * exposure;
    let (p, q) = (x * (a * x + b), x * (c * x + d) + e);
    let g = ((two * a * x + b) * q - p * (two * c * x + d)) / (q * q);
    let free = step(S::one() - p / q);
    [g * exposure * free, g * light * free]
}
fn filmic_tone_numerator([light, exposure]: [f64; 2]) -> [f64; 2] {
    let x = light * exposure;
    let g = (5.02 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    [g * exposure, g * light]
}

/// Reinhard's tone curve with a white point.
fn reinhard_tone<S: Scalar>([light, white]: [S; 2]) -> S {
    light * (S::one() + light / (white * white)) / (S::one() + light)
}
fn reinhard_tone_derivatives<S: Scalar>([light, white]: [S; 2]) -> [S; 2] {
    let (one, square, below) = (S::one(), white * white, S::one() + light);
    [
        (one + light * (S::lit(2.0) + light) / square) / (below * below),
        -S::lit(2.0) * light * light / (square * white * below),
    ]
}
fn reinhard_tone_white(x: [f64; 2]) -> [f64; 2] {
    let g = reinhard_tone_derivatives(x);
    [g[0], g[1] / x[1]]
}

/// The saturation of a colour: the difference of the largest and smallest channel over the largest.
fn saturation<S: Scalar>([r, g, b]: [S; 3]) -> S {
    let (most, least) = (r.most(g).most(b), r.least(g).least(b));
    (most - least) / most
}
/// Which share of the largest of three each of them is, ties by halves.
fn largest<S: Scalar>([r, g, b]: [S; 3]) -> [S; 3] {
    let (first, second) = (step(r - g), step(r.most(g) - b));
    [
        first * second,
        (S::one() - first) * second,
        S::one() - second,
    ]
}
fn saturation_derivatives<S: Scalar>(c: [S; 3]) -> [S; 3] {
    let most = c[0].most(c[1]).most(c[2]);
    let least = c[0].least(c[1]).least(c[2]);
    let (top, bottom) = (largest(c), largest(c.map(|c| -c)));
    from_fn(|i| (top[i] * least / most - bottom[i]) / most)
}
fn saturation_no_least(c: [f64; 3]) -> [f64; 3] {
    let (most, least) = (c[0].max(c[1]).max(c[2]), c[0].min(c[1]).min(c[2]));
    largest(c).map(|top| top * least / (most * most))
}

/// The lightness of a luminance under a white point, up to 100.
fn lightness<S: Scalar>([y, white]: [S; 2]) -> S {
    let ratio = y / white;
    let edge = 6.0_f64 / 29.0;
    let dark = ratio.at_most(S::lit(edge * edge * edge));
    let root = (S::select(dark, S::one(), ratio).ln() / S::lit(3.0)).exp();
    let line = ratio / S::lit(3.0 * edge * edge) + S::lit(4.0 / 29.0);
    S::lit(116.0) * S::select(dark, line, root) - S::lit(16.0)
}
fn lightness_derivatives<S: Scalar>([y, white]: [S; 2]) -> [S; 2] {
    let ratio = y / white;
    let edge = 6.0_f64 / 29.0;
    let dark = ratio.at_most(S::lit(edge * edge * edge));
    let safe = S::select(dark, S::one(), ratio);
    let root = (safe.ln() / S::lit(3.0)).exp() / (S::lit(3.0) * safe);
    let g = S::lit(116.0) * S::select(dark, S::lit(1.0 / (3.0 * edge * edge)), root);
    [g / white, -g * ratio / white]
}
fn lightness_fixed_white(x: [f64; 2]) -> [f64; 2] {
    [lightness_derivatives(x)[0], 0.0]
}
