//! Robotics: kinematics, poses, residuals of sensors, control.
use crate::corpus::function::{Function, row};
use crate::corpus::tools::{array, cross, dot, inverse, literals, minus, plus, times};
use geograd::Scalar;

pub(crate) const FUNCTIONS: &[Function] = &[
    row!(arm_miss, arm_miss_derivatives,
        [[0.5, 2.0], [0.5, 2.0], [-1.5, 1.5], [-1.5, 1.5], [-3.0, 3.0], [-3.0, 3.0]],
        kinks [[1.0, 1.0, 0.0, 0.0, 2.0, 0.0]],
        wrong ["shoulder does not move the forearm": arm_miss_stiff]),
    row!(quaternion_rotation, quaternion_rotation_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [0.2, 1.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0]],
        wrong ["projection of the normalisation forgotten": quaternion_rotation_unprojected]),
    row!(reprojection, reprojection_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [2.0, 6.0], [400.0, 600.0], [400.0, 600.0], [300.0, 340.0],
         [220.0, 260.0], [200.0, 440.0], [150.0, 330.0]],
        wrong ["depth taken as constant": reprojection_flat]),
    row!(se2_compose, se2_compose_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-3.0, 3.0], [-2.0, 2.0], [-2.0, 2.0], [-3.0, 3.0]],
        wrong ["heading's lever arm forgotten": se2_compose_no_lever]),
    row!(icp_point_to_line, icp_point_to_line_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-3.0, 3.0]],
        wrong ["point not turned before its lever arm is": icp_point_to_line_unturned]),
    row!(capsule_distance, capsule_distance_derivatives,
        [[-3.0, 3.0], [-3.0, 3.0], [-1.5, -0.5], [-1.0, 1.0], [0.5, 1.5], [-1.0, 1.0], [0.1, 0.5]],
        kinks [[0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.25], [1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.25]],
        wrong ["all weight on the first end": capsule_distance_first_end]),
    row!(bicycle_step, bicycle_step_derivatives,
        [[-5.0, 5.0], [-5.0, 5.0], [-3.0, 3.0], [0.5, 10.0], [-0.6, 0.6], [1.5, 3.0]],
        wrong ["tangent of the steering angle taken as the angle": bicycle_step_small_angle]),
    row!(range_bearing, range_bearing_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-0.5, 0.5], [3.0, 8.0], [-3.0, 3.0], [2.0, 9.0], [-1.0, 1.0]],
        wrong ["bearing's derivatives not divided by the range": range_bearing_undivided]),
    row!(saturated_pd, saturated_pd_derivatives,
        [[0.1, 2.0], [-1.0, 1.0], [0.1, 2.0], [-1.0, 1.0]],
        kinks [[1.0, 0.5, 1.0, 0.5], [2.0, -0.25, 1.0, -0.5]],
        wrong ["saturation forgotten": saturated_pd_unsaturated]),
    row!(rotation_angle, rotation_angle_derivatives,
        [[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0]],
        kinks [[1.0, 0.0, 0.0, 0.0], [0.0, 0.6, 0.0, 0.8]],
        wrong ["written for unit quaternions only": rotation_angle_unit]),
    row!(pendulum_energy, pendulum_energy_derivatives,
        [[-3.0, 3.0], [-3.0, 3.0], [-2.0, 2.0], [-2.0, 2.0], [0.5, 2.0], [0.5, 2.0], [0.5, 2.0], [0.5, 2.0]],
        wrong ["coupling of the joints forgotten": pendulum_energy_uncoupled]),
    row!(obstacle_cost, obstacle_cost_derivatives,
        [[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [0.5, 2.0]],
        kinks [[1.0, 0.0, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 0.5, 1.0]],
        wrong ["no reach at all": obstacle_cost_everywhere]),
];

/// How far the tip of a planar arm of two links is from a goal.
fn arm_miss<S: Scalar>([upper, fore, shoulder, elbow, gx, gy]: [S; 6]) -> S {
    let ((s, c), (se, ce)) = (shoulder.sin_cos(), (shoulder + elbow).sin_cos());
    let (x, y) = (upper * c + fore * ce - gx, upper * s + fore * se - gy);
    (x * x + y * y).root()
}
fn arm_miss_derivatives<S: Scalar>([upper, fore, shoulder, elbow, gx, gy]: [S; 6]) -> [S; 6] {
    let ((s, c), (se, ce)) = (shoulder.sin_cos(), (shoulder + elbow).sin_cos());
    let (x, y) = (upper * c + fore * ce - gx, upper * s + fore * se - gy);
    let r = inverse((x * x + y * y).root());
    let (x, y) = (x * r, y * r);
    let by_elbow = fore * (y * ce - x * se);
    [
        x * c + y * s,
        x * ce + y * se,
        upper * (y * c - x * s) + by_elbow,
        by_elbow,
        -x,
        -y,
    ]
}
fn arm_miss_stiff(x: [f64; 6]) -> [f64; 6] {
    let mut g = arm_miss_derivatives(x);
    g[2] -= g[3];
    g
}

const PULL: [f64; 3] = [0.3, -0.8, 0.5];

/// A vector turned by a quaternion of any length, projected on a direction.
fn quaternion_rotation<S: Scalar>([w, x, y, z, px, py, pz]: [S; 7]) -> S {
    let (a, v, u) = ([x, y, z], [px, py, pz], literals::<S, _>(PULL));
    let two = S::lit(2.0);
    let turned = (w * w - dot(a, a)) * dot(u, v)
        + two * dot(a, v) * dot(a, u)
        + two * w * dot(u, cross(a, v));
    turned / (w * w + dot(a, a))
}
/// The derivatives, and what part of them the normalisation projects away.
fn quaternion_parts<S: Scalar>([w, x, y, z, px, py, pz]: [S; 7]) -> ([S; 7], S) {
    let (a, v, u) = ([x, y, z], [px, py, pz], literals::<S, _>(PULL));
    let (two, uv, au, av) = (S::lit(2.0), dot(u, v), dot(a, u), dot(a, v));
    let inner = w * w - dot(a, a);
    let turned = inner * uv + two * av * au + two * w * dot(u, cross(a, v));
    let norm = S::one() / (w * w + dot(a, a));
    let by_w = two * w * uv + two * dot(u, cross(a, v));
    let by_a = plus(
        minus(times(v, two * au), times(a, two * uv)),
        plus(times(u, two * av), times(cross(v, u), two * w)),
    );
    let by_v = plus(
        plus(times(u, inner), times(a, two * au)),
        times(cross(u, a), two * w),
    );
    let (by_a, by_v) = (times(by_a, norm), times(by_v, norm));
    (
        [
            by_w * norm,
            by_a[0],
            by_a[1],
            by_a[2],
            by_v[0],
            by_v[1],
            by_v[2],
        ],
        two * turned * norm * norm,
    )
}
fn quaternion_rotation_derivatives<S: Scalar>(q: [S; 7]) -> [S; 7] {
    let (mut g, shrink) = quaternion_parts(q);
    for i in 0..4 {
        g[i] -= shrink * q[i];
    }
    g
}
fn quaternion_rotation_unprojected(q: [f64; 7]) -> [f64; 7] {
    quaternion_parts(q).0
}

/// The squared distance of a projected point from where it was seen, in pixels.
fn reprojection<S: Scalar>([x, y, z, fx, fy, cx, cy, u, v]: [S; 9]) -> S {
    let (a, b) = (fx * x / z + cx - u, fy * y / z + cy - v);
    a * a + b * b
}
fn reprojection_derivatives<S: Scalar>([x, y, z, fx, fy, cx, cy, u, v]: [S; 9]) -> [S; 9] {
    let two = S::lit(2.0);
    let (a, b) = (two * (fx * x / z + cx - u), two * (fy * y / z + cy - v));
    let by_z = -(a * fx * x + b * fy * y) / (z * z);
    [
        a * fx / z,
        b * fy / z,
        by_z,
        a * x / z,
        b * y / z,
        a,
        b,
        -a,
        -b,
    ]
}
fn reprojection_flat(x: [f64; 9]) -> [f64; 9] {
    let mut g = reprojection_derivatives(x);
    g[2] = 0.0;
    g
}

const POSE: [f64; 3] = [0.7, -0.4, 1.1];

/// A pose seen from another one, composed: its three numbers, weighted.
fn se2_compose<S: Scalar>([ax, ay, at, bx, by, bt]: [S; 6]) -> S {
    let ((s, c), w) = (at.sin_cos(), literals::<S, _>(POSE));
    dot(w, [ax + c * bx - s * by, ay + s * bx + c * by, at + bt])
}
fn se2_compose_derivatives<S: Scalar>([_, _, at, bx, by, _]: [S; 6]) -> [S; 6] {
    let ((s, c), [p, q, r]) = (at.sin_cos(), literals::<S, _>(POSE));
    let lever = q * (c * bx - s * by) - p * (s * bx + c * by);
    [p, q, r + lever, p * c + q * s, q * c - p * s, r]
}
fn se2_compose_no_lever(x: [f64; 6]) -> [f64; 6] {
    let mut g = se2_compose_derivatives(x);
    g[2] = POSE[2];
    g
}

/// Half the squared distance of a moved point from a line with a normal at an angle.
fn icp_point_to_line<S: Scalar>([turn, tx, ty, px, py, qx, qy, normal]: [S; 8]) -> S {
    let ((s, c), (ny, nx)) = (turn.sin_cos(), normal.sin_cos());
    let e = nx * (c * px - s * py + tx - qx) + ny * (s * px + c * py + ty - qy);
    S::lit(0.5) * e * e
}
fn icp_point_to_line_derivatives<S: Scalar>(
    [turn, tx, ty, px, py, qx, qy, normal]: [S; 8],
) -> [S; 8] {
    let ((s, c), (ny, nx)) = (turn.sin_cos(), normal.sin_cos());
    let (x, y) = (c * px - s * py, s * px + c * py);
    let (dx, dy) = (x + tx - qx, y + ty - qy);
    let e = nx * dx + ny * dy;
    let (fx, fy) = (e * nx, e * ny);
    [
        fy * x - fx * y,
        fx,
        fy,
        fx * c + fy * s,
        fy * c - fx * s,
        -fx,
        -fy,
        e * (nx * dy - ny * dx),
    ]
}
fn icp_point_to_line_unturned(x: [f64; 8]) -> [f64; 8] {
    let mut g = icp_point_to_line_derivatives(x);
    g[0] = g[2] * x[3] - g[1] * x[4];
    g
}

/// The signed distance of a point from a capsule.
fn capsule_distance<S: Scalar>([x, y, ax, ay, bx, by, radius]: [S; 7]) -> S {
    let (p, a, b) = ([x, y], [ax, ay], [bx, by]);
    let (ab, ap) = (minus(b, a), minus(p, a));
    let t = (dot(ap, ab) / dot(ab, ab)).clamp(S::zero(), S::one());
    let off = minus(ap, times(ab, t));
    dot(off, off).root() - radius
}
fn capsule_distance_derivatives<S: Scalar>([x, y, ax, ay, bx, by, _]: [S; 7]) -> [S; 7] {
    // The foot is where the distance is least, so its own motion does not count.
    let (p, a, b) = ([x, y], [ax, ay], [bx, by]);
    let (ab, ap) = (minus(b, a), minus(p, a));
    let t = (dot(ap, ab) / dot(ab, ab)).clamp(S::zero(), S::one());
    let off = minus(ap, times(ab, t));
    let [nx, ny] = times(off, inverse(dot(off, off).root()));
    let s = S::one() - t;
    [nx, ny, -nx * s, -ny * s, -nx * t, -ny * t, -S::one()]
}
fn capsule_distance_first_end(x: [f64; 7]) -> [f64; 7] {
    let g = capsule_distance_derivatives(x);
    [g[0], g[1], -g[0], -g[1], 0.0, 0.0, g[6]]
}

const TICK: f64 = 0.1;

/// A car after a tenth of a second by the bicycle model: position and heading, weighted.
fn bicycle_step<S: Scalar>([x, y, heading, speed, steer, base]: [S; 6]) -> S {
    let ((s, c), w, tick) = (heading.sin_cos(), literals::<S, _>(POSE), S::lit(TICK));
    let turn = speed * steer.tan() / base;
    dot(
        w,
        [
            x + speed * c * tick,
            y + speed * s * tick,
            heading + turn * tick,
        ],
    )
}
fn bicycle_step_derivatives<S: Scalar>([_, _, heading, speed, steer, base]: [S; 6]) -> [S; 6] {
    let ((s, c), [p, q, r], tick) = (heading.sin_cos(), literals::<S, _>(POSE), S::lit(TICK));
    let tan = steer.tan();
    [
        p,
        q,
        r + speed * tick * (q * c - p * s),
        tick * (p * c + q * s + r * tan / base),
        r * tick * speed * (S::one() + tan * tan) / base,
        -r * tick * speed * tan / (base * base),
    ]
}
fn bicycle_step_small_angle(x: [f64; 6]) -> [f64; 6] {
    let mut g = bicycle_step_derivatives(x);
    g[4] = POSE[2] * TICK * x[3] / x[5];
    g
}

/// Squared errors of a landmark's range and bearing, as seen from a pose.
fn range_bearing<S: Scalar>([px, py, heading, lx, ly, range, bearing]: [S; 7]) -> S {
    let (dx, dy) = (lx - px, ly - py);
    let far = (dx * dx + dy * dy).root() - range;
    let off = dy.atan2(dx) - heading - bearing;
    far * far + off * off
}
fn range_bearing_derivatives<S: Scalar>(
    [px, py, heading, lx, ly, range, bearing]: [S; 7],
) -> [S; 7] {
    let (dx, dy, two) = (lx - px, ly - py, S::lit(2.0));
    let square = dx * dx + dy * dy;
    let r = square.root();
    let (far, off) = (two * (r - range), two * (dy.atan2(dx) - heading - bearing));
    let (x, y) = (
        far * dx / r - off * dy / square,
        far * dy / r + off * dx / square,
    );
    [-x, -y, -off, x, y, -far, -off]
}
fn range_bearing_undivided([px, py, heading, lx, ly, range, bearing]: [f64; 7]) -> [f64; 7] {
    let (dx, dy) = (lx - px, ly - py);
    let r = dx.hypot(dy);
    let (far, off) = (2.0 * (r - range), 2.0 * (dy.atan2(dx) - heading - bearing));
    let (x, y) = ((far * dx - off * dy) / r, (far * dy + off * dx) / r);
    [-x, -y, -off, x, y, -far, -off]
}

/// The output of a controller of position and speed, between −1 and 1.
fn saturated_pd<S: Scalar>([kp, e, kd, rate]: [S; 4]) -> S {
    (kp * e + kd * rate).clamp(-S::one(), S::one())
}
fn saturated_pd_derivatives<S: Scalar>([kp, e, kd, rate]: [S; 4]) -> [S; 4] {
    let u = kp * e + kd * rate;
    let free = S::select(u.unsigned().below(S::one()), S::one(), S::zero());
    let free = S::select(u.unsigned().equals(S::one()), S::lit(0.5), free);
    [e * free, kp * free, rate * free, kd * free]
}
fn saturated_pd_unsaturated([kp, e, kd, rate]: [f64; 4]) -> [f64; 4] {
    [e, kp, rate, kd]
}

/// The angle of the rotation that a quaternion of any length stands for, in radians.
fn rotation_angle<S: Scalar>([w, x, y, z]: [S; 4]) -> S {
    S::lit(2.0) * (x * x + y * y + z * z).root().atan2(w.magnitude())
}
fn rotation_angle_derivatives<S: Scalar>([w, x, y, z]: [S; 4]) -> [S; 4] {
    let (two, square) = (S::lit(2.0), x * x + y * y + z * z);
    let (sin, all) = (square.root(), square + w * w);
    let out = two * w.magnitude() / all * inverse(sin);
    [
        -two * sin / all * crate::corpus::tools::sign(w),
        out * x,
        out * y,
        out * z,
    ]
}
fn rotation_angle_unit([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    let r = 2.0 / (1.0 - (w * w).min(0.99)).sqrt();
    [-r * w.signum(), 0.0 * x, 0.0 * y, 0.0 * z]
}

/// The kinetic energy of a double pendulum: angles, their rates, masses, lengths.
fn pendulum_energy<S: Scalar>([a, b, u, v, m, n, k, l]: [S; 8]) -> S {
    let half = S::lit(0.5);
    half * (m + n) * k * k * u * u + half * n * l * l * v * v + n * k * l * u * v * (a - b).cos()
}
fn pendulum_energy_derivatives<S: Scalar>([a, b, u, v, m, n, k, l]: [S; 8]) -> [S; 8] {
    let (half, (s, c)) = (S::lit(0.5), (a - b).sin_cos());
    let turn = n * k * l * u * v * s;
    let joint = k * l * u * v * c;
    [
        -turn,
        turn,
        (m + n) * k * k * u + n * k * l * v * c,
        n * l * l * v + n * k * l * u * c,
        half * k * k * u * u,
        half * (k * k * u * u + l * l * v * v) + joint,
        (m + n) * k * u * u + n * l * u * v * c,
        n * l * v * v + n * k * u * v * c,
    ]
}
fn pendulum_energy_uncoupled(x: [f64; 8]) -> [f64; 8] {
    let mut g = pendulum_energy_derivatives(x);
    (g[0], g[1]) = (0.0, 0.0);
    g
}

/// The cost of a trajectory nearer to an obstacle than the reach: half the square of the depth.
fn obstacle_cost<S: Scalar>([px, py, ox, oy, reach]: [S; 5]) -> S {
    let d = minus([px, py], [ox, oy]);
    let deep = (reach - dot(d, d).root()).most(S::zero());
    S::lit(0.5) * deep * deep
}
fn obstacle_cost_derivatives<S: Scalar>([px, py, ox, oy, reach]: [S; 5]) -> [S; 5] {
    let d = minus([px, py], [ox, oy]);
    let r = dot(d, d).root();
    let deep = (reach - r).most(S::zero());
    let [x, y] = times(d, deep * inverse(r));
    [-x, -y, x, y, deep]
}
fn obstacle_cost_everywhere([px, py, ox, oy, reach]: [f64; 5]) -> [f64; 5] {
    let (x, y) = (px - ox, py - oy);
    let r = x.hypot(y).max(1e-9);
    let deep = reach - r;
    [
        -deep * x / r,
        -deep * y / r,
        deep * x / r,
        deep * y / r,
        deep,
    ]
}
