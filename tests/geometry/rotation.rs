//! Rotations and motions of space.
use super::pairs::{Random, random_rotation};
use geograd::shape::FACES;
use geograd::{Aabb3, EulerOrder, Jet, Obb3, Pose3, Rotation3, Scalar, Sphere, Triangle3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};

fn apart(a: Rotation3<f64>, b: Rotation3<f64>) -> f64 {
    let (m, n) = (a.matrix(), b.matrix());
    let mut worst = 0.0_f64;
    for i in 0..3 {
        for j in 0..3 {
            worst = worst.max((m[i][j] - n[i][j]).abs());
        }
    }
    worst
}

#[test]
fn encodings_go_there_and_back() {
    let mut random = Random(1);
    for _ in 0..500 {
        let q = random_rotation(&mut random);
        assert!(apart(q, Rotation3::from_matrix(q.matrix())) < 1e-15);
        assert!(apart(q, Rotation3::from_rotation_vector(q.rotation_vector())) < 1e-14);
        for order in EulerOrder::ALL {
            let angles = q.euler(order);
            assert!(
                apart(q, Rotation3::from_euler(order, angles)) < 1e-14,
                "{order:?}"
            );
        }
        let v = random.vector(2.0);
        let m = q.matrix();
        let by_matrix = Vec3::new(
            m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z,
        );
        assert!((q * v).distance(by_matrix) < 1e-14);
        let r = random_rotation(&mut random);
        assert!(((q * r) * v).distance(q * (r * v)) < 1e-14);
        let [x, y, z] = q.axes();
        assert!(x.cross(y).distance(z) < 1e-14);
    }
}

#[test]
fn euler_angles_are_turns_about_the_named_axes() {
    let axes = [
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    ];
    let angles = [0.7, 0.4, -1.1];
    for order in EulerOrder::ALL {
        let mut q = Rotation3::identity();
        for (&angle, axis) in angles.iter().zip(order.axes()) {
            q = q * Rotation3::from_axis_angle(axes[axis], angle);
        }
        assert!(apart(q, Rotation3::from_euler(order, angles)) < 1e-15);
        let back = q.euler(order);
        assert!(
            angles.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-14),
            "{order:?} {back:?}"
        );
        // Gimbal lock: the rotation is right all the same.
        let locked = if order.axes()[0] == order.axes()[2] {
            0.0
        } else {
            FRAC_PI_2
        };
        let q = Rotation3::from_euler(order, [0.3, locked, 0.5]);
        assert!(
            apart(q, Rotation3::from_euler(order, q.euler(order))) < 1e-7,
            "{order:?}"
        );
    }
}

#[test]
fn series_meet_closed_forms() {
    let axis = Vec3::new(0.6, -0.48, 0.64);
    for exponent in -60..3 {
        for angle in [2_f64.powi(exponent), 0.03, 0.0299999, 3.0e-2 + 1e-12] {
            let v = axis * angle;
            let q = Rotation3::from_rotation_vector(v);
            let exact = Rotation3::from_axis_angle(axis, angle);
            assert!(
                (q.w - exact.w).abs() < 1e-15 && (q.x - exact.x).abs() < 1e-15 * angle.max(1e-300)
            );
            if angle < 3.0 {
                assert!(
                    (q.rotation_vector() - v).length() < 1e-14 * angle,
                    "{angle}"
                );
            }
        }
    }
    assert_eq!(
        Rotation3::from_rotation_vector(Vec3::<f64>::zero()),
        Rotation3::identity()
    );
    assert_eq!(Rotation3::<f64>::identity().rotation_vector(), Vec3::zero());
}

#[test]
fn half_turns_have_the_documented_axis() {
    for q in [
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, 0.0, 1.0],
        [-0.0, 0.0, -0.0, -2.0],
    ] {
        let v = Rotation3::new(q[0], q[1], q[2], q[3]).rotation_vector();
        assert_eq!(v, Vec3::new(0.0, 0.0, PI));
    }
    let v = Rotation3::new(0.0, -3.0, 4.0, 0.0).rotation_vector();
    assert!(v.distance(Vec3::new(0.6 * PI, -0.8 * PI, 0.0)) < 1e-15);
}

#[test]
fn derivatives_are_finite_and_right_everywhere() {
    type J = Jet<f64, 3>;
    let log_of_exp = |v: Vec3<f64>| {
        let v = Vec3::new(
            J::variable(v.x, 0),
            J::variable(v.y, 1),
            J::variable(v.z, 2),
        );
        Rotation3::from_rotation_vector(v).rotation_vector()
    };
    for angle in [0.0, 1e-200, 1e-12, 0.01, 0.0299, 0.0301, 1.0, 3.0] {
        let out = log_of_exp(Vec3::new(0.6 * angle, 0.0, -0.8 * angle));
        for (i, x) in [out.x, out.y, out.z].into_iter().enumerate() {
            for (j, derivative) in x.derivative.into_iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!(
                    (derivative - expected).abs() < 1e-12,
                    "{angle} {i} {j} {derivative}"
                );
            }
        }
    }
    // Nothing is NaN at kinks: zero quaternions, half turns, gimbal lock.
    for q in [
        [0.0; 4],
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.5, 0.5, 0.5, 0.5],
        [1e-200; 4],
    ] {
        let q: [Jet<f64, 4>; 4] = std::array::from_fn(|i| Jet::variable(q[i], i));
        let q = Rotation3::new(q[0], q[1], q[2], q[3]);
        let v = q.rotation_vector();
        let mut all = vec![v.x, v.y, v.z, q.angle()];
        all.extend(q.matrix().concat());
        for order in EulerOrder::ALL {
            all.extend(q.euler(order));
        }
        for x in all {
            assert!(
                x.value.is_finite() && x.derivative.iter().all(|s| s.is_finite()),
                "{q:?} {x:?}"
            );
        }
    }
}

#[test]
fn gradients_go_between_quaternion_and_tangent() {
    let mut random = Random(9);
    for _ in 0..50 {
        let (q, v) = (random_rotation(&mut random), random.vector(1.0));
        let goal = |q: Rotation3<f64>| (q * v).x + 2.0 * (q * v).y;
        let raw = {
            let lift = |x: f64, i: usize| Jet::<f64, 4>::variable(x, i);
            let r = Rotation3::new(lift(q.w, 0), lift(q.x, 1), lift(q.y, 2), lift(q.z, 3));
            let at = r * Vec3::new(Scalar::lit(v.x), Scalar::lit(v.y), Scalar::lit(v.z));
            (at.x + at.y + at.y).derivative
        };
        let raw = Rotation3::new(raw[0], raw[1], raw[2], raw[3]);
        let tangent = q.tangent_gradient(raw);
        let h = 1e-6;
        for (axis, found) in [
            (Vec3::new(h, 0.0, 0.0), tangent.x),
            (Vec3::new(0.0, h, 0.0), tangent.y),
            (Vec3::new(0.0, 0.0, h), tangent.z),
        ] {
            let numeric = (goal(q.retract(axis)) - goal(q.retract(-axis))) / (2.0 * h);
            assert!((numeric - found).abs() < 1e-9);
        }
        let again = q.quaternion_gradient(tangent);
        for (a, b) in [
            (again.w, raw.w),
            (again.x, raw.x),
            (again.y, raw.y),
            (again.z, raw.z),
        ] {
            assert!((a - b).abs() < 1e-13);
        }
    }
}

#[test]
fn motions_compose_invert_and_interpolate() {
    let mut random = Random(4);
    for _ in 0..100 {
        let mut pose = || {
            let rotation = random_rotation(&mut random);
            Pose3::new(random.vector(3.0), rotation)
        };
        let (a, b) = (pose(), pose());
        let p = random.vector(1.0);
        assert!(((a * b) * p).distance(a * (b * p)) < 1e-13);
        assert!((a.inverse() * (a * p)).distance(p) < 1e-13);
        let (start, end) = (a.interpolate(b, 0.0), a.interpolate(b, 1.0));
        assert!((start * p).distance(a * p) < 1e-13 && (end * p).distance(b * p) < 1e-13);
        let (turn, shift) = a.tangent_to(b);
        assert!((a.retract(turn, shift) * p).distance(b * p) < 1e-13);
        let half = a.rotation.interpolate(b.rotation, 0.5);
        let (to, from) = (a.rotation.tangent_to(half), half.tangent_to(b.rotation));
        assert!((to.length() - from.length()).abs() < 1e-13);
    }
}

#[test]
fn boxes_have_their_corners_faces_and_planes() {
    let mut random = Random(6);
    for _ in 0..50 {
        let upright = random.yaw_box();
        let turned = Obb3::from(upright);
        for (p, q) in upright.corners().into_iter().zip(turned.corners()) {
            assert!(p.distance(q) < 1e-14);
        }
        let shape = Obb3::new(
            random.vector(2.0),
            random.size(),
            random_rotation(&mut random),
        );
        let (corners, planes) = (shape.corners(), shape.planes());
        let (mut six, mut surface) = (0.0, 0.0);
        for (face, plane) in FACES.iter().zip(planes) {
            for (n, p) in corners.iter().enumerate() {
                let height = plane.signed_distance(*p);
                assert!(if face.contains(&n) {
                    height.abs() < 1e-14
                } else {
                    height < 0.0
                });
            }
            let [a, b, c, d] = face.map(|n| corners[n]);
            for t in [Triangle3::new(a, b, c), Triangle3::new(a, c, d)] {
                six += t.six_volume(shape.center);
                surface += t.area();
                assert!(t.normal().distance(plane.normal) < 1e-13);
            }
        }
        assert!(
            (six / 6.0 - shape.volume()).abs() < 1e-13 && (surface - shape.surface()).abs() < 1e-12
        );
        let bounds = shape.bounding();
        assert!(corners.iter().all(|&p| {
            let slack = Vec3::new(1e-14, 1e-14, 1e-14);
            Aabb3::new(bounds.min - slack, bounds.max + slack).contains(p)
        }));
        let ball = Sphere::new(shape.center, shape.size.length() / 2.0);
        assert!(
            corners
                .iter()
                .all(|&p| ball.signed_distance(p).abs() < 1e-14)
        );
    }
}
