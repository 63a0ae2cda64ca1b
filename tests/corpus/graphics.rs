//! Graphics: curves, distance fields, light, colours, rays.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, dot, inverse, literals, minus, sign, step, times};
use geograd::Scalar;
use std::array::from_fn;
use std::f64::consts::PI;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(bezier, bezier_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0],
         [-2.0, 2.0], [0.0, 1.0]],
        wrong ["tangent without its three": bezier_tangent_third]),
    row!(catmull_rom, catmull_rom_derivatives, [[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [0.0, 1.0]],
        wrong ["outer points have no pull": catmull_rom_inner]),
    row!(smooth_least, smooth_least_derivatives, [[-1.0, 1.0], [-1.0, 1.0], [0.3, 1.0]],
        kinks [[0.5, 0.5, 0.5]],
        wrong ["blend taken as constant": smooth_least_detached]),
    row!(rounded_box, rounded_box_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [0.5, 1.0], [0.5, 1.0], [0.5, 1.0], [0.0, 0.3]],
        kinks [[0.5, 0.5, 0.0, 1.0, 1.0, 1.0, 0.25], [0.0, 0.5, 0.0, 1.0, 0.75, 1.0, 0.25]],
        wrong ["signs of the octant forgotten": rounded_box_unsigned]),
    row!(lambert, lambert_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [0.2, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [0.2, 1.0]],
        kinks [[0.0, 0.0, 1.0, 0.5, 0.5, 0.0, 0.5]],
        wrong ["lit from behind": lambert_both_sides, "normal not normalised": lambert_unnormalised]),
    row!(phong_highlight, phong_highlight_derivatives, [[0.1, 1.0], [0.1, 1.0], [0.0, 1.4], [0.0, 1.4], [2.0, 30.0]],
        wrong ["exponent not lowered by one": phong_highlight_power]),
    row!(fresnel_schlick, fresnel_schlick_derivatives, [[0.0, 0.2], [0.0, 1.0]],
        wrong ["fourth power for the fifth": fresnel_schlick_fourth]),
    row!(fresnel_dielectric, fresnel_dielectric_derivatives, [[0.1, 1.0], [1.1, 2.5]],
        wrong ["refracted angle taken as constant": fresnel_dielectric_detached]),
    row!(barycentric, barycentric_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-2.0, -1.0], [-2.0, -1.0], [1.0, 2.0], [-2.0, -1.0], [-1.0, 1.0], [1.0, 2.0]],
        wrong ["area of the triangle taken as constant": barycentric_fixed_area]),
    row!(ray_sphere, ray_sphere_derivatives,
        [[-0.3, 0.3], [-0.3, 0.3], [-3.0, -2.5], [-0.1, 0.1], [-0.1, 0.1], [0.5, 1.5], [-0.2, 0.2],
         [-0.2, 0.2], [-0.2, 0.2], [1.0, 1.5]],
        wrong ["direction taken as a unit vector": ray_sphere_unit]),
    row!(ggx_lobe, ggx_lobe_derivatives, [[0.2, 1.0], [0.1, 0.9]],
        wrong ["roughness not squared": ggx_lobe_linear]),
];

const WEIGHTS: [f64; 2] = [0.8, -0.6];

/// A point of a cubic curve, both coordinates weighted: four points and the parameter.
fn bezier<S: Scalar>([a, b, c, d, e, f, g, h, t]: [S; 9]) -> S {
    let (s, three) = (S::one() - t, S::lit(3.0));
    let w = [s * s * s, three * s * s * t, three * s * t * t, t * t * t];
    dot(
        literals::<S, _>(WEIGHTS),
        [dot(w, [a, c, e, g]), dot(w, [b, d, f, h])],
    )
}
fn bezier_derivatives<S: Scalar>([a, b, c, d, e, f, g, h, t]: [S; 9]) -> [S; 9] {
    let (s, three, two) = (S::one() - t, S::lit(3.0), S::lit(2.0));
    let w = [s * s * s, three * s * s * t, three * s * t * t, t * t * t];
    let [u, v] = literals::<S, _>(WEIGHTS);
    let along = |a: S, b: S, c: S, d: S| {
        three * (s * s * (b - a) + two * s * t * (c - b) + t * t * (d - c))
    };
    let by_t = u * along(a, c, e, g) + v * along(b, d, f, h);
    [
        u * w[0],
        v * w[0],
        u * w[1],
        v * w[1],
        u * w[2],
        v * w[2],
        u * w[3],
        v * w[3],
        by_t,
    ]
}
fn bezier_tangent_third(x: [f64; 9]) -> [f64; 9] {
    let mut g = bezier_derivatives(x);
    g[8] /= 3.0;
    g
}

/// A number between the second and third of four by Catmull and Rom's spline.
fn catmull_rom<S: Scalar>([a, b, c, d, t]: [S; 5]) -> S {
    dot(catmull_rom_weights(t), [a, b, c, d])
}
fn catmull_rom_weights<S: Scalar>(t: S) -> [S; 4] {
    let [half, two, three, four, five] = literals::<S, _>([0.5, 2.0, 3.0, 4.0, 5.0]);
    [
        half * t * (t * (two - t) - S::one()),
        half * (t * t * (three * t - five) + two),
        half * t * (t * (four - three * t) + S::one()),
        half * t * t * (t - S::one()),
    ]
}
fn catmull_rom_derivatives<S: Scalar>([a, b, c, d, t]: [S; 5]) -> [S; 5] {
    let w = catmull_rom_weights(t);
    let [half, two, three, four, eight, nine, ten] =
        literals::<S, _>([0.5, 2.0, 3.0, 4.0, 8.0, 9.0, 10.0]);
    let by_t = [
        half * (t * (four - three * t) - S::one()),
        half * t * (nine * t - ten),
        half * (t * (eight - nine * t) + S::one()),
        half * t * (three * t - two),
    ];
    [w[0], w[1], w[2], w[3], dot(by_t, [a, b, c, d])]
}
fn catmull_rom_inner(x: [f64; 5]) -> [f64; 5] {
    let g = catmull_rom_derivatives(x);
    [0.0, g[1], g[2], 0.0, g[4]]
}

/// The smooth union of two distance fields, with the width of the blend.
fn smooth_least<S: Scalar>([a, b, k]: [S; 3]) -> S {
    let h = (k - (a - b).magnitude()).most(S::zero()) / k;
    a.least(b) - h * h * k * S::lit(0.25)
}
fn smooth_least_parts<S: Scalar>([a, b, k]: [S; 3], blend: S) -> [S; 3] {
    let h = (k - (a - b).magnitude()).most(S::zero()) / k;
    let (side, half) = (step(b - a), S::lit(0.5));
    // d(h² k / 4): h k = k - |a - b|, so its derivatives by a and b are h/2 (-sign), by k h/2 - h²/4.
    let pull = blend * half * h * sign(a - b);
    [
        side + pull,
        S::one() - side - pull,
        -blend * (half * h - S::lit(0.25) * h * h),
    ]
}
fn smooth_least_derivatives<S: Scalar>(x: [S; 3]) -> [S; 3] {
    smooth_least_parts(x, S::one())
}
fn smooth_least_detached(x: [f64; 3]) -> [f64; 3] {
    smooth_least_parts(x, 0.0)
}

/// The signed distance of a point from a box with rounded edges: half sizes, radius.
fn rounded_box<S: Scalar>([x, y, z, a, b, c, radius]: [S; 7]) -> S {
    let q = minus([x, y, z].map(S::magnitude), [a, b, c]);
    let out = q.map(|q| q.most(S::zero()));
    let inside = q[0].most(q[1]).most(q[2]).least(S::zero());
    dot(out, out).root() + inside - radius
}
fn rounded_box_derivatives<S: Scalar>([x, y, z, a, b, c, _]: [S; 7]) -> [S; 7] {
    let q = minus([x, y, z].map(S::magnitude), [a, b, c]);
    let out = q.map(|q| q.most(S::zero()));
    let r = inverse(dot(out, out).root());
    let (first, second) = (step(q[0] - q[1]), step(q[0].most(q[1]) - q[2]));
    let deep = S::one() - step(q[0].most(q[1]).most(q[2]));
    let share = [
        first * second,
        (S::one() - first) * second,
        S::one() - second,
    ];
    let g: [S; 3] = from_fn(|i| out[i] * r + share[i] * deep);
    let p = [x, y, z];
    [
        g[0] * sign(p[0]),
        g[1] * sign(p[1]),
        g[2] * sign(p[2]),
        -g[0],
        -g[1],
        -g[2],
        -S::one(),
    ]
}
fn rounded_box_unsigned(x: [f64; 7]) -> [f64; 7] {
    let g = rounded_box_derivatives(x);
    [-g[3], -g[4], -g[5], g[3], g[4], g[5], g[6]]
}

/// Diffuse light on a surface: normal of any length, direction of the light, albedo.
fn lambert<S: Scalar>([nx, ny, nz, lx, ly, lz, albedo]: [S; 7]) -> S {
    let (n, l) = ([nx, ny, nz], [lx, ly, lz]);
    albedo * (dot(n, l) / dot(n, n).root()).most(S::zero())
}
fn lambert_parts<S: Scalar>(x: [S; 7], lit: S, norm_moves: S) -> [S; 7] {
    let (n, l) = ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
    let square = dot(n, n);
    let r = S::one() / square.root();
    let cos = dot(n, l) * r;
    let g = x[6] * lit;
    let by_n = minus(times(l, g * r), times(n, norm_moves * g * cos / square));
    let by_l = times(n, g * r);
    [
        by_n[0],
        by_n[1],
        by_n[2],
        by_l[0],
        by_l[1],
        by_l[2],
        cos * lit,
    ]
}
fn lambert_derivatives<S: Scalar>(x: [S; 7]) -> [S; 7] {
    let lit = step(dot([x[0], x[1], x[2]], [x[3], x[4], x[5]]));
    lambert_parts(x, lit, S::one())
}
fn lambert_both_sides(x: [f64; 7]) -> [f64; 7] {
    lambert_parts(x, 1.0, 1.0)
}
fn lambert_unnormalised(x: [f64; 7]) -> [f64; 7] {
    let lit = step(dot([x[0], x[1], x[2]], [x[3], x[4], x[5]]));
    lambert_parts(x, lit, 0.0)
}

/// Diffuse and mirrored light: two albedos, the angles of light and mirror, the shininess.
fn phong_highlight<S: Scalar>([diffuse, mirror, light, view, shine]: [S; 5]) -> S {
    diffuse * light.cos() + mirror * (shine * view.cos().ln()).exp()
}
fn phong_highlight_derivatives<S: Scalar>([diffuse, mirror, light, view, shine]: [S; 5]) -> [S; 5] {
    let ((sl, cl), (sv, cv)) = (light.sin_cos(), view.sin_cos());
    let lobe = (shine * cv.ln()).exp();
    [
        cl,
        lobe,
        -diffuse * sl,
        -mirror * shine * lobe * sv / cv,
        mirror * lobe * cv.ln(),
    ]
}
fn phong_highlight_power(x: [f64; 5]) -> [f64; 5] {
    let mut g = phong_highlight_derivatives(x);
    g[3] *= x[3].cos();
    g
}

/// Schlick's share of light that is mirrored: at right angles, cosine of the angle.
fn fresnel_schlick<S: Scalar>([straight, cos]: [S; 2]) -> S {
    straight + (S::one() - straight) * (S::one() - cos).powi(5)
}
fn fresnel_schlick_derivatives<S: Scalar>([straight, cos]: [S; 2]) -> [S; 2] {
    let left = S::one() - cos;
    [
        S::one() - left.powi(5),
        -S::lit(5.0) * (S::one() - straight) * left.powi(4),
    ]
}
fn fresnel_schlick_fourth([straight, cos]: [f64; 2]) -> [f64; 2] {
    let left = 1.0 - cos;
    [1.0 - left.powi(5), -4.0 * (1.0 - straight) * left.powi(3)]
}

/// The share of light that glass mirrors: cosine of the angle, refractive index.
fn fresnel_dielectric<S: Scalar>([cos, index]: [S; 2]) -> S {
    let inner = (S::one() - (S::one() - cos * cos) / (index * index)).root();
    let across = (cos - index * inner) / (cos + index * inner);
    let along = (index * cos - inner) / (index * cos + inner);
    S::lit(0.5) * (across * across + along * along)
}
fn fresnel_dielectric_parts<S: Scalar>([cos, index]: [S; 2], angle_moves: S) -> [S; 2] {
    let (one, two, square) = (S::one(), S::lit(2.0), index * index);
    let inner = (one - (one - cos * cos) / square).root();
    let (p, q) = (cos + index * inner, index * cos + inner);
    let (across, along) = ((cos - index * inner) / p, (index * cos - inner) / q);
    // d((a - b) / (a + b)) = 2 (b da - a db) / (a + b)²
    let (s, t) = (two * across / (p * p), two * along / (q * q));
    let by_inner = (-s * cos * index - t * index * cos) * angle_moves;
    let (by_cos, by_index) = (
        cos / (square * inner),
        (one - cos * cos) / (square * index * inner),
    );
    [
        s * index * inner + t * inner * index + by_inner * by_cos,
        -s * cos * inner + t * inner * cos + by_inner * by_index,
    ]
}
fn fresnel_dielectric_derivatives<S: Scalar>(x: [S; 2]) -> [S; 2] {
    fresnel_dielectric_parts(x, S::one())
}
fn fresnel_dielectric_detached(x: [f64; 2]) -> [f64; 2] {
    fresnel_dielectric_parts(x, 0.0)
}

/// Twice the signed area of a triangle.
fn twice_area<S: Scalar>([ax, ay, bx, by, cx, cy]: [S; 6]) -> S {
    (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
}
fn twice_area_derivatives<S: Scalar>([ax, ay, bx, by, cx, cy]: [S; 6]) -> [S; 6] {
    [by - cy, cx - bx, cy - ay, ax - cx, ay - by, bx - ax]
}
/// The weight of a triangle's first corner at a point.
fn barycentric<S: Scalar>([x, y, ax, ay, bx, by, cx, cy]: [S; 8]) -> S {
    twice_area([x, y, bx, by, cx, cy]) / twice_area([ax, ay, bx, by, cx, cy])
}
fn barycentric_parts<S: Scalar>([x, y, ax, ay, bx, by, cx, cy]: [S; 8], area_moves: S) -> [S; 8] {
    let (part, all) = ([x, y, bx, by, cx, cy], [ax, ay, bx, by, cx, cy]);
    let area = twice_area(all);
    let weight = area_moves * twice_area(part) / area;
    let (p, q) = (twice_area_derivatives(part), twice_area_derivatives(all));
    [
        p[0] / area,
        p[1] / area,
        -weight * q[0] / area,
        -weight * q[1] / area,
        (p[2] - weight * q[2]) / area,
        (p[3] - weight * q[3]) / area,
        (p[4] - weight * q[4]) / area,
        (p[5] - weight * q[5]) / area,
    ]
}
fn barycentric_derivatives<S: Scalar>(x: [S; 8]) -> [S; 8] {
    barycentric_parts(x, S::one())
}
fn barycentric_fixed_area(x: [f64; 8]) -> [f64; 8] {
    barycentric_parts(x, 0.0)
}

/// The distance at which a ray first meets a sphere, in lengths of its direction: origin, direction, centre, radius.
fn ray_sphere<S: Scalar>(x: [S; 10]) -> S {
    let (d, r) = ([x[3], x[4], x[5]], x[9]);
    let off = minus([x[0], x[1], x[2]], [x[6], x[7], x[8]]);
    let (a, b, c) = (dot(d, d), dot(off, d), dot(off, off) - r * r);
    -(b + (b * b - a * c).root()) / a
}
fn ray_sphere_derivatives<S: Scalar>(x: [S; 10]) -> [S; 10] {
    // On the sphere n · (o + t d - c) stays r: n · (do + t dd + d dt - dc) = dr.
    let (d, t, r) = ([x[3], x[4], x[5]], ray_sphere(x), x[9]);
    let hit: [S; 3] = from_fn(|i| (x[i] + t * d[i] - x[6 + i]) / r);
    let g = times(hit, -S::one() / dot(hit, d));
    let by_d = times(g, t);
    [
        g[0],
        g[1],
        g[2],
        by_d[0],
        by_d[1],
        by_d[2],
        -g[0],
        -g[1],
        -g[2],
        S::one() / dot(hit, d),
    ]
}
fn ray_sphere_unit(x: [f64; 10]) -> [f64; 10] {
    let length = dot([x[3], x[4], x[5]], [x[3], x[4], x[5]]).sqrt();
    ray_sphere_derivatives(x).map(|g| g * length)
}

/// The lobe of a rough surface by Trowbridge and Reitz: cosine of the half angle, roughness.
fn ggx_lobe<S: Scalar>([cos, rough]: [S; 2]) -> S {
    let a = rough.powi(4);
    let d = cos * cos * (a - S::one()) + S::one();
    a / (S::lit(PI) * d * d)
}
fn ggx_lobe_derivatives<S: Scalar>([cos, rough]: [S; 2]) -> [S; 2] {
    let (a, pi) = (rough.powi(4), S::lit(PI));
    let d = cos * cos * (a - S::one()) + S::one();
    let cube = pi * d * d * d;
    let by_a = (d - S::lit(2.0) * a * cos * cos) / cube;
    [
        -S::lit(4.0) * a * cos * (a - S::one()) / cube,
        by_a * S::lit(4.0) * rough.powi(3),
    ]
}
fn ggx_lobe_linear(x: [f64; 2]) -> [f64; 2] {
    let g = ggx_lobe_derivatives(x);
    [g[0], g[1] / (2.0 * x[1])]
}
