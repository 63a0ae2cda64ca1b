//! Vision: two views, lenses, samples of images, boxes.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, dot, inverse, literals, sign, step, times};
use geograd::Scalar;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(epipolar_residual, epipolar_residual_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0],
         [-1.0, 1.0], [-1.0, 1.0], [0.2, 2.0], [0.2, 2.0], [-2.0, 2.0], [-2.0, 2.0]],
        wrong ["matrix transposed": epipolar_residual_transposed,
               "norm of the line taken as constant": epipolar_residual_constant_norm]),
    row!(homography_transfer, homography_transfer_derivatives,
        [[0.5, 1.5], [-0.5, 0.5], [-1.0, 1.0], [-0.5, 0.5], [0.5, 1.5], [-1.0, 1.0], [-0.1, 0.1],
         [-0.1, 0.1], [0.8, 1.2], [-2.0, 2.0], [-2.0, 2.0]],
        wrong ["division by the third coordinate taken as constant": homography_transfer_affine]),
    row!(radial_distortion, radial_distortion_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-0.3, 0.3], [-0.1, 0.1]],
        wrong ["growth with the radius forgotten": radial_distortion_linear]),
    row!(tangential_distortion, tangential_distortion_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-0.1, 0.1], [-0.1, 0.1]],
        wrong ["the two coefficients exchanged": tangential_distortion_exchanged]),
    row!(bilinear_sample, bilinear_sample_derivatives,
        [[0.0, 255.0], [0.0, 255.0], [0.0, 255.0], [0.0, 255.0], [0.0, 1.0], [0.0, 1.0]],
        wrong ["rows and columns exchanged": bilinear_sample_transposed]),
    row!(iou_upright, iou_upright_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [1.0, 3.0], [1.0, 3.0], [-1.0, 1.0], [-1.0, 1.0], [1.0, 3.0], [1.0, 3.0]],
        kinks [[0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 2.0], [0.0, 0.0, 2.0, 2.0, 0.5, 0.0, 1.0, 1.0]],
        wrong ["area of the union taken as constant": iou_upright_constant_union]),
    row!(photometric_huber, photometric_huber_derivatives,
        [[0.0, 4.0], [0.0, 4.0], [0.5, 1.5], [-1.0, 1.0]],
        kinks [[1.0, 0.0, 1.0, 0.0], [2.0, 1.0, 1.0, 0.0]],
        wrong ["gain forgotten in the chain": photometric_huber_no_gain]),
    row!(patch_correlation, patch_correlation_derivatives,
        [[0.0, 1.0], [1.0, 2.0], [0.0, 3.0], [0.0, 1.0], [2.0, 3.0], [0.0, 3.0]],
        wrong ["only the numerator": patch_correlation_numerator]),
    row!(stereo_depth, stereo_depth_derivatives,
        [[400.0, 600.0], [0.1, 0.5], [300.0, 400.0], [100.0, 280.0], [0.5, 3.0]],
        wrong ["disparity not squared": stereo_depth_not_squared]),
    row!(bilateral_weight, bilateral_weight_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-1.0, 1.0], [0.5, 2.0], [0.5, 2.0]],
        wrong ["squares of the widths instead of cubes": bilateral_weight_squares]),
    row!(flow_residual, flow_residual_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-1.0, 1.0], [-2.0, 2.0], [-2.0, 2.0], [0.1, 1.0]],
        wrong ["root forgotten": flow_residual_no_root]),
    row!(box_regression, box_regression_derivatives,
        [[-3.0, 3.0], [0.3, 3.0], [-3.0, 3.0], [0.5, 2.0]],
        kinks [[1.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]],
        wrong ["truth's width does not scale the offset": box_regression_unscaled]),
    row!(corner_strength, corner_strength_derivatives,
        [[0.5, 3.0], [-1.0, 1.0], [0.5, 3.0]],
        kinks [[1.0, 0.0, 1.0]],
        wrong ["off-diagonal entry counted once": corner_strength_once]),
];

/// A point's signed distance from its epipolar line: nine entries of the matrix, two points.
fn epipolar_residual<S: Scalar>(x: [S; 13]) -> S {
    let (p, q) = ([x[9], x[10], S::one()], [x[11], x[12], S::one()]);
    let [a, b, c]: [S; 3] = std::array::from_fn(|i| dot([x[3 * i], x[3 * i + 1], x[3 * i + 2]], p));
    dot(q, [a, b, c]) / (a * a + b * b).root()
}
fn epipolar_parts<S: Scalar>(x: [S; 13], norm_moves: S) -> [S; 13] {
    let (p, q) = ([x[9], x[10], S::one()], [x[11], x[12], S::one()]);
    let line: [S; 3] = std::array::from_fn(|i| dot([x[3 * i], x[3 * i + 1], x[3 * i + 2]], p));
    let [a, b, _] = line;
    let r = S::one() / (a * a + b * b).root();
    let shrink = dot(q, line) * r * r * r * norm_moves;
    let by_line = [q[0] * r - shrink * a, q[1] * r - shrink * b, r];
    let mut g = [S::zero(); 13];
    for i in 0..3 {
        for k in 0..3 {
            g[3 * i + k] = by_line[i] * p[k];
        }
        g[9] += by_line[i] * x[3 * i];
        g[10] += by_line[i] * x[3 * i + 1];
    }
    (g[11], g[12]) = (line[0] * r, line[1] * r);
    g
}
fn epipolar_residual_derivatives<S: Scalar>(x: [S; 13]) -> [S; 13] {
    epipolar_parts(x, S::one())
}
fn epipolar_residual_constant_norm(x: [f64; 13]) -> [f64; 13] {
    epipolar_parts(x, 0.0)
}
fn epipolar_residual_transposed(x: [f64; 13]) -> [f64; 13] {
    let g = epipolar_residual_derivatives(x);
    std::array::from_fn(|i| if i < 9 { g[i % 3 * 3 + i / 3] } else { g[i] })
}

const SEEN: [f64; 2] = [0.8, -0.6];

/// The image of a point by a homography: both coordinates, weighted.
fn homography_transfer<S: Scalar>([a, b, c, d, e, f, g, h, i, x, y]: [S; 11]) -> S {
    let w = g * x + h * y + i;
    dot(
        literals::<S, _>(SEEN),
        [(a * x + b * y + c) / w, (d * x + e * y + f) / w],
    )
}
fn homography_transfer_derivatives<S: Scalar>(
    [a, b, c, d, e, f, g, h, i, x, y]: [S; 11],
) -> [S; 11] {
    let r = S::one() / (g * x + h * y + i);
    let [p, q] = times(literals::<S, _>(SEEN), r);
    let all = -(p * (a * x + b * y + c) + q * (d * x + e * y + f)) * r;
    [
        p * x,
        p * y,
        p,
        q * x,
        q * y,
        q,
        all * x,
        all * y,
        all,
        p * a + q * d + all * g,
        p * b + q * e + all * h,
    ]
}
fn homography_transfer_affine(x: [f64; 11]) -> [f64; 11] {
    let mut g = homography_transfer_derivatives(x);
    g[6..9].fill(0.0);
    g
}

/// A point moved outwards by a lens: both coordinates, weighted.
fn radial_distortion<S: Scalar>([x, y, k, l]: [S; 4]) -> S {
    let r = x * x + y * y;
    dot(literals::<S, _>(SEEN), [x, y]) * (S::one() + k * r + l * r * r)
}
fn radial_distortion_derivatives<S: Scalar>([x, y, k, l]: [S; 4]) -> [S; 4] {
    let (r, two, [p, q]) = (x * x + y * y, S::lit(2.0), literals::<S, _>(SEEN));
    let (sum, grow) = (p * x + q * y, S::one() + k * r + l * r * r);
    let out = sum * two * (k + two * l * r);
    [p * grow + out * x, q * grow + out * y, sum * r, sum * r * r]
}
fn radial_distortion_linear(x: [f64; 4]) -> [f64; 4] {
    let (g, r) = (radial_distortion_derivatives(x), x[0] * x[0] + x[1] * x[1]);
    let grow = 1.0 + x[2] * r + x[3] * r * r;
    [SEEN[0] * grow, SEEN[1] * grow, g[2], g[3]]
}

/// A point moved aside by a lens that is not centred: both coordinates, weighted.
fn tangential_distortion<S: Scalar>([x, y, k, l]: [S; 4]) -> S {
    let (r, two) = (x * x + y * y, S::lit(2.0));
    let aside = [
        x + two * k * x * y + l * (r + two * x * x),
        y + k * (r + two * y * y) + two * l * x * y,
    ];
    dot(literals::<S, _>(SEEN), aside)
}
fn tangential_distortion_derivatives<S: Scalar>([x, y, k, l]: [S; 4]) -> [S; 4] {
    let (r, two, six, [p, q]) = (
        x * x + y * y,
        S::lit(2.0),
        S::lit(6.0),
        literals::<S, _>(SEEN),
    );
    [
        p * (S::one() + two * k * y + six * l * x) + q * two * (k * x + l * y),
        p * two * (k * x + l * y) + q * (S::one() + six * k * y + two * l * x),
        p * two * x * y + q * (r + two * y * y),
        p * (r + two * x * x) + q * two * x * y,
    ]
}
fn tangential_distortion_exchanged([x, y, k, l]: [f64; 4]) -> [f64; 4] {
    tangential_distortion_derivatives([x, y, l, k])
}

/// An image between four pixels.
fn bilinear_sample<S: Scalar>([a, b, c, d, x, y]: [S; 6]) -> S {
    let one = S::one();
    (a * (one - x) + b * x) * (one - y) + (c * (one - x) + d * x) * y
}
fn bilinear_sample_derivatives<S: Scalar>([a, b, c, d, x, y]: [S; 6]) -> [S; 6] {
    let (left, up) = (S::one() - x, S::one() - y);
    [
        left * up,
        x * up,
        left * y,
        x * y,
        (b - a) * up + (d - c) * y,
        (c - a) * left + (d - b) * x,
    ]
}
fn bilinear_sample_transposed([a, b, c, d, x, y]: [f64; 6]) -> [f64; 6] {
    bilinear_sample_derivatives([a, c, b, d, x, y])
}

/// The common length of two intervals, each a centre and a width.
fn common<S: Scalar>([a, w, b, v]: [S; 4]) -> S {
    let half = S::lit(0.5);
    let end = (a + w * half).least(b + v * half);
    let start = (a - w * half).most(b - v * half);
    (end - start).most(S::zero())
}
fn common_derivatives<S: Scalar>([a, w, b, v]: [S; 4]) -> [S; 4] {
    let half = S::lit(0.5);
    let (ends, starts) = ([a + w * half, b + v * half], [a - w * half, b - v * half]);
    let open = step(ends[0].least(ends[1]) - starts[0].most(starts[1]));
    // Which of the two has the end, and which the start.
    let (end, start) = (step(ends[1] - ends[0]), step(starts[0] - starts[1]));
    let (other_end, other_start) = (S::one() - end, S::one() - start);
    [
        open * (end - start),
        open * half * (end + start),
        open * (other_end - other_start),
        open * half * (other_end + other_start),
    ]
}
/// Intersection over union of two upright boxes: centres and sizes.
fn iou_upright<S: Scalar>([ax, ay, aw, ah, bx, by, bw, bh]: [S; 8]) -> S {
    let area = common([ax, aw, bx, bw]) * common([ay, ah, by, bh]);
    area / (aw * ah + bw * bh - area)
}
fn iou_parts<S: Scalar>([ax, ay, aw, ah, bx, by, bw, bh]: [S; 8], union_moves: S) -> [S; 8] {
    let (wide, high) = ([ax, aw, bx, bw], [ay, ah, by, bh]);
    let (x, y) = (common(wide), common(high));
    let whole = aw * ah + bw * bh;
    let r = S::one() / (whole - x * y);
    // d(i / (s - i)) = (s di - i ds) / (s - i)²
    let by_area = r + union_moves * x * y * r * r;
    let by_whole = -union_moves * x * y * r * r;
    let (gx, gy) = (
        times(common_derivatives(wide), by_area * y),
        times(common_derivatives(high), by_area * x),
    );
    [
        gx[0],
        gy[0],
        gx[1] + by_whole * ah,
        gy[1] + by_whole * aw,
        gx[2],
        gy[2],
        gx[3] + by_whole * bh,
        gy[3] + by_whole * bw,
    ]
}
fn iou_upright_derivatives<S: Scalar>(x: [S; 8]) -> [S; 8] {
    iou_parts(x, S::one())
}
fn iou_upright_constant_union(x: [f64; 8]) -> [f64; 8] {
    iou_parts(x, 0.0)
}

/// Half the square up to one, then linear.
fn huber<S: Scalar>(e: S) -> S {
    let (half, size) = (S::lit(0.5), e.magnitude());
    S::select(size.at_most(S::one()), half * e * e, size - half)
}
fn huber_derivative<S: Scalar>(e: S) -> S {
    S::select(e.unsigned().at_most(S::one()), e, sign(e))
}
/// The robust difference of two pixels after gain and bias.
fn photometric_huber<S: Scalar>([a, b, gain, bias]: [S; 4]) -> S {
    huber(gain * a + bias - b)
}
fn photometric_huber_derivatives<S: Scalar>([a, b, gain, bias]: [S; 4]) -> [S; 4] {
    let g = huber_derivative(gain * a + bias - b);
    [g * gain, -g, g * a, g]
}
fn photometric_huber_no_gain([a, b, gain, bias]: [f64; 4]) -> [f64; 4] {
    let g = huber_derivative(gain * a + bias - b);
    [g, -g, g * a, g]
}

/// Correlation of two patches of three pixels, between −1 and 1.
fn patch_correlation<S: Scalar>([a, b, c, d, e, f]: [S; 6]) -> S {
    let third = S::lit(1.0 / 3.0);
    let (left, right) = ((a + b + c) * third, (d + e + f) * third);
    let (p, q) = (
        [a - left, b - left, c - left],
        [d - right, e - right, f - right],
    );
    dot(p, q) / (dot(p, p) * dot(q, q)).root()
}
fn patch_correlation_derivatives<S: Scalar>([a, b, c, d, e, f]: [S; 6]) -> [S; 6] {
    let third = S::lit(1.0 / 3.0);
    let (left, right) = ((a + b + c) * third, (d + e + f) * third);
    let (p, q) = (
        [a - left, b - left, c - left],
        [d - right, e - right, f - right],
    );
    let (pp, qq) = (dot(p, p), dot(q, q));
    let r = S::one() / (pp * qq).root();
    let value = dot(p, q) * r;
    let by = |mine: S, other: S, square: S| other * r - value * mine / square;
    [
        by(p[0], q[0], pp),
        by(p[1], q[1], pp),
        by(p[2], q[2], pp),
        by(q[0], p[0], qq),
        by(q[1], p[1], qq),
        by(q[2], p[2], qq),
    ]
}
fn patch_correlation_numerator([a, b, c, d, e, f]: [f64; 6]) -> [f64; 6] {
    let (left, right) = ((a + b + c) / 3.0, (d + e + f) / 3.0);
    let (p, q) = (
        [a - left, b - left, c - left],
        [d - right, e - right, f - right],
    );
    let r = 1.0 / (dot(p, p) * dot(q, q)).sqrt();
    [q[0] * r, q[1] * r, q[2] * r, p[0] * r, p[1] * r, p[2] * r]
}

/// The squared error of a depth from stereo: focal length, baseline, two columns, true depth.
fn stereo_depth<S: Scalar>([focal, base, left, right, depth]: [S; 5]) -> S {
    let e = focal * base / (left - right) - depth;
    e * e
}
fn stereo_depth_derivatives<S: Scalar>([focal, base, left, right, depth]: [S; 5]) -> [S; 5] {
    let d = left - right;
    let e = S::lit(2.0) * (focal * base / d - depth);
    let by_d = -e * focal * base / (d * d);
    [e * base / d, e * focal / d, by_d, -by_d, -e]
}
fn stereo_depth_not_squared(x: [f64; 5]) -> [f64; 5] {
    let (mut g, d) = (stereo_depth_derivatives(x), x[2] - x[3]);
    g[2] *= d;
    g[3] *= d;
    g
}

/// The weight of a pixel in a bilateral filter: offsets in the plane and in brightness, two widths.
fn bilateral_weight<S: Scalar>([x, y, i, space, range]: [S; 5]) -> S {
    let half = S::lit(0.5);
    (-(half * (x * x + y * y) / (space * space)) - half * i * i / (range * range)).exp()
}
fn bilateral_weight_derivatives<S: Scalar>([x, y, i, space, range]: [S; 5]) -> [S; 5] {
    let w = bilateral_weight([x, y, i, space, range]);
    let (ss, rr) = (space * space, range * range);
    [
        -w * x / ss,
        -w * y / ss,
        -w * i / rr,
        w * (x * x + y * y) / (ss * space),
        w * i * i / (rr * range),
    ]
}
fn bilateral_weight_squares(x: [f64; 5]) -> [f64; 5] {
    let g = bilateral_weight_derivatives(x);
    [g[0], g[1], g[2], g[3] * x[3], g[4] * x[4]]
}

/// How much a flow violates constant brightness, by a smooth absolute value.
fn flow_residual<S: Scalar>([ix, iy, it, u, v, eps]: [S; 6]) -> S {
    let e = ix * u + iy * v + it;
    (e * e + eps * eps).root()
}
fn flow_residual_derivatives<S: Scalar>([ix, iy, it, u, v, eps]: [S; 6]) -> [S; 6] {
    let e = ix * u + iy * v + it;
    let r = S::one() / (e * e + eps * eps).root();
    let g = e * r;
    [g * u, g * v, g, g * ix, g * iy, eps * r]
}
fn flow_residual_no_root([ix, iy, it, u, v, eps]: [f64; 6]) -> [f64; 6] {
    let g = ix * u + iy * v + it;
    [g * u, g * v, g, g * ix, g * iy, eps]
}

/// The loss of a predicted interval, centre and width, against the true one.
fn box_regression<S: Scalar>([c, w, truth, width]: [S; 4]) -> S {
    huber((c - truth) / width) + huber((w / width).ln())
}
fn box_regression_derivatives<S: Scalar>([c, w, truth, width]: [S; 4]) -> [S; 4] {
    let e = (c - truth) / width;
    let (g, h) = (huber_derivative(e), huber_derivative((w / width).ln()));
    [g / width, h / w, -g / width, -(g * e + h) / width]
}
fn box_regression_unscaled([c, w, truth, width]: [f64; 4]) -> [f64; 4] {
    let (g, h) = (
        huber_derivative((c - truth) / width),
        huber_derivative((w / width).ln()),
    );
    [g / width, h / w, -g / width, -h / width]
}

/// The smaller eigenvalue of a symmetric matrix: how much of a corner a pixel is.
fn corner_strength<S: Scalar>([a, b, c]: [S; 3]) -> S {
    let half = S::lit(0.5);
    let (mean, off) = (half * (a + c), half * (a - c));
    mean - (off * off + b * b).root()
}
fn corner_strength_derivatives<S: Scalar>([a, b, c]: [S; 3]) -> [S; 3] {
    let half = S::lit(0.5);
    let off = half * (a - c);
    let r = inverse((off * off + b * b).root());
    [half - half * off * r, -b * r, half + half * off * r]
}
fn corner_strength_once(x: [f64; 3]) -> [f64; 3] {
    let g = corner_strength_derivatives(x);
    [g[0], 0.5 * g[1], g[2]]
}
