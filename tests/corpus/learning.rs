//! Learning: losses, layers, similarities.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, dot, literals, minus, sigmoid, sign, step, tanh, times};
use geograd::Scalar;
use std::array::from_fn;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(softmax_cross_entropy, softmax_cross_entropy_derivatives, [[-3.0, 3.0]; 4],
        kinks [[1.0, 1.0, 0.5, 1.0]],
        wrong ["one forgotten for the true class": softmax_cross_entropy_no_one]),
    row!(log_sum_exp, log_sum_exp_derivatives, [[-3.0, 3.0], [-3.0, 3.0], [-3.0, 3.0], [0.3, 2.0]],
        wrong ["temperature outside the sum only": log_sum_exp_outside]),
    row!(layer_norm, layer_norm_derivatives, [[-2.0, 0.0], [-1.0, 1.0], [0.0, 2.0], [0.5, 2.0], [-1.0, 1.0]],
        wrong ["mean and variance taken as constants": layer_norm_detached,
               "variance taken as constant": layer_norm_mean_only]),
    row!(attention_row, attention_row_derivatives, [[-1.5, 1.5]; 11],
        wrong ["weights taken as constants": attention_row_detached]),
    row!(huber_loss, huber_loss_derivatives, [[-3.0, 3.0], [-3.0, 3.0], [0.5, 2.0]],
        kinks [[1.0, 0.0, 1.0], [0.5, 0.5, 1.0]],
        wrong ["threshold has no derivative": huber_loss_fixed]),
    row!(focal_loss, focal_loss_derivatives, [[-3.0, 3.0], [0.1, 0.9], [0.5, 3.0]],
        wrong ["modulation taken as constant": focal_loss_detached]),
    row!(gaussian_divergence, gaussian_divergence_derivatives, [[-2.0, 2.0], [0.5, 2.0], [-2.0, 2.0], [0.5, 2.0]],
        wrong ["derivatives by the variance": gaussian_divergence_variance]),
    row!(triplet_loss, triplet_loss_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [0.1, 1.0]],
        kinks [[0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5], [0.0, 0.0, 0.5, 0.0, 0.75, 0.0, 0.3125]],
        wrong ["margin always active": triplet_loss_active,
               "anchor pulled only": triplet_loss_pulled]),
    row!(cosine_similarity, cosine_similarity_derivatives,
        [[0.2, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [0.2, 2.0], [-2.0, 2.0]],
        wrong ["lengths taken as constants": cosine_similarity_detached]),
    row!(swish_gate, swish_gate_derivatives, [[-3.0, 3.0], [-2.0, 2.0], [-2.0, 2.0], [0.5, 2.0]],
        wrong ["sigmoid taken as constant": swish_gate_detached]),
    row!(gelu_neuron, gelu_neuron_derivatives, [[-2.0, 2.0], [-2.0, 2.0], [-1.5, 1.5], [-1.5, 1.5], [-1.0, 1.0]],
        wrong ["cubic term's derivative without its three": gelu_neuron_no_three]),
    row!(logistic_loss, logistic_loss_derivatives, [[-4.0, 4.0], [0.0, 1.0]],
        kinks [[0.0, 0.25]],
        wrong ["label forgotten": logistic_loss_no_label]),
    row!(leaky_neuron, leaky_neuron_derivatives, [[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-1.0, 1.0]],
        kinks [[1.0, -1.0, 0.5, 0.25, -0.25], [0.5, 0.5, 1.0, -1.0, 0.0]],
        wrong ["no leak": leaky_neuron_dry]),
    row!(elastic_net, elastic_net_derivatives, [[-2.0, 2.0], [-2.0, 2.0], [0.1, 1.0], [0.1, 1.0]],
        kinks [[0.0, 1.0, 0.5, 0.5], [0.0, 0.0, 0.5, 0.25]],
        wrong ["absolute value's derivative without its sign": elastic_net_unsigned]),
    row!(lstm_cell, lstm_cell_derivatives, [[-2.0, 2.0]; 5],
        wrong ["cell's hyperbolic tangent forgotten": lstm_cell_no_tanh]),
];

/// The cross entropy of four logits against the second class.
fn softmax_cross_entropy<S: Scalar>(z: [S; 4]) -> S {
    let top = z[0].most(z[1]).most(z[2]).most(z[3]);
    let sum = z.map(|z| (z - top).exp()).into_iter().reduce(|a, b| a + b);
    sum.unwrap_or(S::one()).ln() + top - z[1]
}
fn softmax<S: Scalar, const N: usize>(z: [S; N]) -> [S; N] {
    let e = z.map(S::exp);
    let mut sum = e[0];
    for e in &e[1..] {
        sum += *e;
    }
    e.map(|e| e / sum)
}
fn softmax_cross_entropy_derivatives<S: Scalar>(z: [S; 4]) -> [S; 4] {
    let mut p = softmax(z);
    p[1] -= S::one();
    p
}
fn softmax_cross_entropy_no_one(z: [f64; 4]) -> [f64; 4] {
    softmax(z)
}

/// A smooth maximum of three numbers at a temperature.
fn log_sum_exp<S: Scalar>([a, b, c, t]: [S; 4]) -> S {
    t * ((a / t).exp() + (b / t).exp() + (c / t).exp()).ln()
}
fn log_sum_exp_derivatives<S: Scalar>([a, b, c, t]: [S; 4]) -> [S; 4] {
    let [p, q, r] = softmax([a / t, b / t, c / t]);
    let value = log_sum_exp([a, b, c, t]);
    [p, q, r, (value - p * a - q * b - r * c) / t]
}
fn log_sum_exp_outside(x: [f64; 4]) -> [f64; 4] {
    let g = log_sum_exp_derivatives(x);
    [g[0], g[1], g[2], log_sum_exp(x) / x[3]]
}

const UPSTREAM: [f64; 3] = [0.9, -0.5, 0.7];
const EPS: f64 = 1e-5;

/// Three numbers with mean and variance taken out, scaled and shifted, weighted.
fn layer_norm<S: Scalar>([a, b, c, gain, bias]: [S; 5]) -> S {
    let third = S::lit(1.0 / 3.0);
    let mean = (a + b + c) * third;
    let off = [a - mean, b - mean, c - mean];
    let deviation = (dot(off, off) * third + S::lit(EPS)).root();
    let u = literals::<S, _>(UPSTREAM);
    gain * dot(u, off) / deviation + bias * (u[0] + u[1] + u[2])
}
fn layer_norm_parts<S: Scalar>(
    [a, b, c, gain, _]: [S; 5],
    mean_moves: S,
    variance_moves: S,
) -> [S; 5] {
    let (third, u) = (S::lit(1.0 / 3.0), literals::<S, _>(UPSTREAM));
    let mean = (a + b + c) * third;
    let off = [a - mean, b - mean, c - mean];
    let r = S::one() / (dot(off, off) * third + S::lit(EPS)).root();
    let (sum, along) = (u[0] + u[1] + u[2], dot(u, off));
    let by = |i: usize| {
        gain * r
            * (u[i] - mean_moves * sum * third - variance_moves * along * off[i] * third * r * r)
    };
    [by(0), by(1), by(2), along * r, sum]
}
fn layer_norm_derivatives<S: Scalar>(x: [S; 5]) -> [S; 5] {
    layer_norm_parts(x, S::one(), S::one())
}
fn layer_norm_detached(x: [f64; 5]) -> [f64; 5] {
    layer_norm_parts(x, 0.0, 0.0)
}
fn layer_norm_mean_only(x: [f64; 5]) -> [f64; 5] {
    layer_norm_parts(x, 1.0, 0.0)
}

/// One row of attention: a query of two numbers, three keys of two, three values.
fn attention_row<S: Scalar>(x: [S; 11]) -> S {
    let scale = S::lit(0.5_f64.sqrt());
    let scores: [S; 3] = from_fn(|j| dot([x[0], x[1]], [x[2 + 2 * j], x[3 + 2 * j]]) * scale);
    dot(softmax(scores), [x[8], x[9], x[10]])
}
fn attention_row_derivatives<S: Scalar>(x: [S; 11]) -> [S; 11] {
    let scale = S::lit(0.5_f64.sqrt());
    let keys: [[S; 2]; 3] = from_fn(|j| [x[2 + 2 * j], x[3 + 2 * j]]);
    let weights = softmax(keys.map(|key| dot([x[0], x[1]], key) * scale));
    let value = dot(weights, [x[8], x[9], x[10]]);
    let mut g = [S::zero(); 11];
    for j in 0..3 {
        let score = weights[j] * (x[8 + j] - value) * scale;
        for i in 0..2 {
            g[i] += score * keys[j][i];
            g[2 + 2 * j + i] = score * x[i];
        }
        g[8 + j] = weights[j];
    }
    g
}
fn attention_row_detached(x: [f64; 11]) -> [f64; 11] {
    let g = attention_row_derivatives(x);
    from_fn(|i| if i < 8 { 0.0 } else { g[i] })
}

/// Half the square up to a threshold, then linear.
fn huber_loss<S: Scalar>([x, target, delta]: [S; 3]) -> S {
    let (e, half) = (x - target, S::lit(0.5));
    let size = e.magnitude();
    S::select(
        size.at_most(delta),
        half * e * e,
        delta * (size - half * delta),
    )
}
fn huber_loss_derivatives<S: Scalar>([x, target, delta]: [S; 3]) -> [S; 3] {
    let e = x - target;
    let near = e.unsigned().at_most(delta);
    let g = S::select(near, e, delta * sign(e));
    [g, -g, S::select(near, S::zero(), e.unsigned() - delta)]
}
fn huber_loss_fixed(x: [f64; 3]) -> [f64; 3] {
    let g = huber_loss_derivatives(x);
    [g[0], g[1], 0.0]
}

/// The focal loss of a logit: weight of the class, exponent of the modulation.
fn focal_loss<S: Scalar>([z, alpha, gamma]: [S; 3]) -> S {
    let p = sigmoid(z);
    -alpha * (gamma * (S::one() - p).ln()).exp() * p.ln()
}
fn focal_parts<S: Scalar>([z, alpha, gamma]: [S; 3], modulation_moves: S) -> [S; 3] {
    let p = sigmoid(z);
    let q = S::one() - p;
    let (modulation, ln) = ((gamma * q.ln()).exp(), p.ln());
    let by_z = alpha * modulation * (modulation_moves * gamma * p * ln - q);
    [by_z, -modulation * ln, -alpha * modulation * q.ln() * ln]
}
fn focal_loss_derivatives<S: Scalar>(x: [S; 3]) -> [S; 3] {
    focal_parts(x, S::one())
}
fn focal_loss_detached(x: [f64; 3]) -> [f64; 3] {
    focal_parts(x, 0.0)
}

/// The Kullback-Leibler divergence of two Gaussians: means and deviations.
fn gaussian_divergence<S: Scalar>([m, s, n, t]: [S; 4]) -> S {
    let half = S::lit(0.5);
    (t / s).ln() + (s * s + (m - n) * (m - n)) / (S::lit(2.0) * t * t) - half
}
fn gaussian_divergence_derivatives<S: Scalar>([m, s, n, t]: [S; 4]) -> [S; 4] {
    let (d, tt) = (m - n, t * t);
    let by_mean = d / tt;
    [
        by_mean,
        s / tt - S::one() / s,
        -by_mean,
        S::one() / t - (s * s + d * d) / (tt * t),
    ]
}
fn gaussian_divergence_variance(x: [f64; 4]) -> [f64; 4] {
    let g = gaussian_divergence_derivatives(x);
    [g[0], g[1] / (2.0 * x[1]), g[2], g[3] / (2.0 * x[3])]
}

/// A triplet loss of squared distances: anchor, positive, negative, margin.
fn triplet_loss<S: Scalar>([ax, ay, px, py, nx, ny, margin]: [S; 7]) -> S {
    let (near, far) = (minus([ax, ay], [px, py]), minus([ax, ay], [nx, ny]));
    (dot(near, near) - dot(far, far) + margin).most(S::zero())
}
fn triplet_loss_derivatives<S: Scalar>([ax, ay, px, py, nx, ny, margin]: [S; 7]) -> [S; 7] {
    let (near, far) = (minus([ax, ay], [px, py]), minus([ax, ay], [nx, ny]));
    let active = step(dot(near, near) - dot(far, far) + margin);
    let (p, n) = (
        times(near, S::lit(2.0) * active),
        times(far, S::lit(2.0) * active),
    );
    [p[0] - n[0], p[1] - n[1], -p[0], -p[1], n[0], n[1], active]
}
fn triplet_loss_active([ax, ay, px, py, nx, ny, _]: [f64; 7]) -> [f64; 7] {
    triplet_loss_derivatives([ax, ay, px, py, nx, ny, 1e3])
}
fn triplet_loss_pulled(x: [f64; 7]) -> [f64; 7] {
    let g = triplet_loss_derivatives(x);
    [-g[2], -g[3], g[2], g[3], g[4], g[5], g[6]]
}

/// The cosine of the angle between two vectors.
fn cosine_similarity<S: Scalar>([a, b, c, d, e, f]: [S; 6]) -> S {
    let (p, q) = ([a, b, c], [d, e, f]);
    dot(p, q) / (dot(p, p) * dot(q, q)).root()
}
fn cosine_parts<S: Scalar>([a, b, c, d, e, f]: [S; 6], lengths_move: S) -> [S; 6] {
    let (p, q) = ([a, b, c], [d, e, f]);
    let (pp, qq) = (dot(p, p), dot(q, q));
    let r = S::one() / (pp * qq).root();
    let value = dot(p, q) * r * lengths_move;
    from_fn(|i| {
        let k = i % 3;
        let (mine, other, square) = if i < 3 {
            (p[k], q[k], pp)
        } else {
            (q[k], p[k], qq)
        };
        other * r - value * mine / square
    })
}
fn cosine_similarity_derivatives<S: Scalar>(x: [S; 6]) -> [S; 6] {
    cosine_parts(x, S::one())
}
fn cosine_similarity_detached(x: [f64; 6]) -> [f64; 6] {
    cosine_parts(x, 0.0)
}

/// A gated unit: x w, through swish with a derivative, times x v.
fn swish_gate<S: Scalar>([x, w, v, beta]: [S; 4]) -> S {
    let z = x * w;
    z * sigmoid(beta * z) * x * v
}
fn swish_parts<S: Scalar>([x, w, v, beta]: [S; 4], sigmoid_moves: S) -> [S; 4] {
    let z = x * w;
    let s = sigmoid(beta * z);
    let bend = sigmoid_moves * s * (S::one() - s);
    let by_z = s + z * beta * bend;
    let gate = x * v;
    [
        by_z * w * gate + z * s * v,
        by_z * x * gate,
        z * s * x,
        z * z * bend * gate,
    ]
}
fn swish_gate_derivatives<S: Scalar>(x: [S; 4]) -> [S; 4] {
    swish_parts(x, S::one())
}
fn swish_gate_detached(x: [f64; 4]) -> [f64; 4] {
    swish_parts(x, 0.0)
}

const ROOT_2_BY_PI: f64 = 0.797_884_560_802_865_4;
const CUBIC: f64 = 0.044_715;

/// A neuron of two inputs, through the GELU by hyperbolic tangent.
fn gelu_neuron<S: Scalar>([a, b, w, v, bias]: [S; 5]) -> S {
    let z = a * w + b * v + bias;
    let inner = S::lit(ROOT_2_BY_PI) * (z + S::lit(CUBIC) * z * z * z);
    S::lit(0.5) * z * (S::one() + tanh(inner))
}
fn gelu_parts<S: Scalar>([a, b, w, v, bias]: [S; 5], three: S) -> [S; 5] {
    let z = a * w + b * v + bias;
    let (half, cubic, root) = (S::lit(0.5), S::lit(CUBIC), S::lit(ROOT_2_BY_PI));
    let t = tanh(root * (z + cubic * z * z * z));
    let inner = root * (S::one() + three * cubic * z * z);
    let g = half * (S::one() + t) + half * z * (S::one() - t * t) * inner;
    [g * w, g * v, g * a, g * b, g]
}
fn gelu_neuron_derivatives<S: Scalar>(x: [S; 5]) -> [S; 5] {
    gelu_parts(x, S::lit(3.0))
}
fn gelu_neuron_no_three(x: [f64; 5]) -> [f64; 5] {
    gelu_parts(x, 1.0)
}

/// The binary cross entropy of a logit and a label, without overflow.
fn logistic_loss<S: Scalar>([z, label]: [S; 2]) -> S {
    z.most(S::zero()) - z * label + (S::one() + (-z.magnitude()).exp()).ln()
}
fn logistic_loss_derivatives<S: Scalar>([z, label]: [S; 2]) -> [S; 2] {
    [sigmoid(z) - label, -z]
}
fn logistic_loss_no_label([z, _]: [f64; 2]) -> [f64; 2] {
    [sigmoid(z), -z]
}

const LEAK: f64 = 0.1;

/// A neuron of two inputs with a leaky rectifier.
fn leaky_neuron<S: Scalar>([a, b, w, v, bias]: [S; 5]) -> S {
    let z = a * w + b * v + bias;
    z.most(z * S::lit(LEAK))
}
fn leaky_parts<S: Scalar>([a, b, w, v, bias]: [S; 5], leak: S) -> [S; 5] {
    let side = step(a * w + b * v + bias);
    let g = side + (S::one() - side) * leak;
    [g * w, g * v, g * a, g * b, g]
}
fn leaky_neuron_derivatives<S: Scalar>(x: [S; 5]) -> [S; 5] {
    leaky_parts(x, S::lit(LEAK))
}
fn leaky_neuron_dry(x: [f64; 5]) -> [f64; 5] {
    leaky_parts(x, 0.0)
}

/// The penalty of two weights for their size: weight of absolute values, weight of squares.
fn elastic_net<S: Scalar>([v, w, one, two]: [S; 4]) -> S {
    one * (v.magnitude() + w.magnitude()) + two * (v * v + w * w)
}
fn elastic_net_derivatives<S: Scalar>([v, w, one, two]: [S; 4]) -> [S; 4] {
    let twice = two + two;
    let sizes = v.magnitude() + w.magnitude();
    [
        one * sign(v) + twice * v,
        one * sign(w) + twice * w,
        sizes,
        v * v + w * w,
    ]
}
fn elastic_net_unsigned([v, w, one, two]: [f64; 4]) -> [f64; 4] {
    [
        one + 2.0 * two * v,
        one + 2.0 * two * w,
        v.abs() + w.abs(),
        v * v + w * w,
    ]
}

/// The output of a cell of an LSTM: gates of input, memory and output, the candidate, the memory.
fn lstm_cell<S: Scalar>([input, forget, output, candidate, memory]: [S; 5]) -> S {
    let cell = sigmoid(forget) * memory + sigmoid(input) * tanh(candidate);
    sigmoid(output) * tanh(cell)
}
fn lstm_cell_parts<S: Scalar>(
    [input, forget, output, candidate, memory]: [S; 5],
    bend: S,
) -> [S; 5] {
    let (one, i, f, o) = (S::one(), sigmoid(input), sigmoid(forget), sigmoid(output));
    let new = tanh(candidate);
    let t = tanh(f * memory + i * new);
    let g = o * (one - bend * t * t);
    [
        g * new * i * (one - i),
        g * memory * f * (one - f),
        t * o * (one - o),
        g * i * (one - new * new),
        g * f,
    ]
}
fn lstm_cell_derivatives<S: Scalar>(x: [S; 5]) -> [S; 5] {
    lstm_cell_parts(x, S::one())
}
fn lstm_cell_no_tanh(x: [f64; 5]) -> [f64; 5] {
    lstm_cell_parts(x, 0.0)
}
