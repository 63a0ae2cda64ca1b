//! Jacobians, twists, angles and coordinates of rotations, against matrix exponentials.
use super::pairs::{Random, random_rotation};
use geograd::Jet;
use geograd::check::Check;
use geograd::prelude::*;
use std::f64::consts::PI;

type Matrix<const N: usize> = [[f64; N]; N];

fn product<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> Matrix<N> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..N).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The exponential of a matrix by scaling, Taylor's series and squaring.
fn exponential<const N: usize>(mut a: Matrix<N>) -> Matrix<N> {
    const HALVINGS: i32 = 8;
    a.as_flattened_mut()
        .iter_mut()
        .for_each(|x| *x /= 2.0_f64.powi(HALVINGS));
    let one: Matrix<N> =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let mut sum = one;
    for k in (1..=14).rev() {
        let next = product(&a, &sum);
        sum =
            std::array::from_fn(|i| std::array::from_fn(|j| one[i][j] + next[i][j] / f64::from(k)));
    }
    for _ in 0..HALVINGS {
        sum = product(&sum, &sum);
    }
    sum
}

fn hat(v: Vec3<f64>) -> Matrix<3> {
    [[0.0, -v.z, v.y], [v.z, 0.0, -v.x], [-v.y, v.x, 0.0]]
}

/// The largest difference of columns from a matrix.
fn off<const N: usize>(columns: [Vec3<f64>; 3], matrix: &Matrix<N>, at: (usize, usize)) -> f64 {
    let mut worst = 0.0_f64;
    for (j, column) in columns.into_iter().enumerate() {
        for (i, x) in [column.x, column.y, column.z].into_iter().enumerate() {
            worst = worst.max((x - matrix[at.0 + i][at.1 + j]).abs());
        }
    }
    worst
}

/// Rotation vectors of ordinary and hard lengths.
fn rotation_vectors(random: &mut Random) -> Vec<Vec3<f64>> {
    let lengths = [
        0.0,
        1e-300,
        1e-9,
        1e-3,
        0.03,
        0.999_999,
        1.0,
        1.000_001,
        2.0,
        PI - 1e-9,
        PI,
        PI + 1e-9,
        5.0,
        6.0,
    ];
    let mut all = Vec::new();
    for length in lengths {
        for _ in 0..8 {
            all.push(random.vector(1.0).normalize_or_zero() * length);
        }
        all.push(Vec3::new(0.0, length, 0.0));
    }
    all
}

fn times(columns: [Vec3<f64>; 3], v: Vec3<f64>) -> Vec3<f64> {
    columns[0] * v.x + columns[1] * v.y + columns[2] * v.z
}

#[test]
fn jacobians_are_those_of_the_matrix_exponential() {
    let mut random = Random(11);
    for v in rotation_vectors(&mut random) {
        // The integral of exp(s [v]) is a corner of the exponential of a larger matrix.
        let mut block = [[0.0; 6]; 6];
        for (i, row) in hat(v).into_iter().enumerate() {
            block[i][..3].copy_from_slice(&row);
            block[i][3 + i] = 1.0;
        }
        let expected = exponential(block);
        let left = Rotation3::left_jacobian(v);
        assert!(off(left, &expected, (0, 3)) < 4e-14, "{v}");
        assert!(off(Rotation3::from_rotation_vector(v).axes(), &expected, (0, 0)) < 4e-14);
        let inverse = Rotation3::left_jacobian_inverse(v);
        let right = Rotation3::right_jacobian(v);
        let right_inverse = Rotation3::right_jacobian_inverse(v);
        for axis in [
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(0.0, 0.0, 1.0),
        ] {
            assert!(
                times(inverse, times(left, axis)).distance(axis) < 1e-14,
                "{v}"
            );
            assert!(
                times(right_inverse, times(right, axis)).distance(axis) < 1e-14,
                "{v}"
            );
            let other = random.vector(1.0);
            let transposed = times(left, axis).dot(other) - axis.dot(times(right, other));
            assert!(transposed.abs() < 1e-15);
        }
    }
    // The coefficient of the square is 1 / π² at a half turn.
    let [_, y, _] = Rotation3::left_jacobian_inverse(Vec3::new(0.0, PI, 0.0));
    assert!((y.y - 1.0).abs() < 1e-15);
    let [x, ..] = Rotation3::left_jacobian_inverse(Vec3::new(0.0, 2.0 * PI, 0.0));
    assert!(x.is_finite());
}

#[test]
fn jacobians_are_derivatives_of_exponential_and_logarithm() {
    let mut random = Random(12);
    for v in rotation_vectors(&mut random) {
        let lifted = Vec3::new(
            Jet::<f64, 3>::variable(v.x, 0),
            Jet::variable(v.y, 1),
            Jet::variable(v.z, 2),
        );
        let back = Rotation3::from_rotation_vector(v).inverse();
        let turn = (Rotation3::from_rotation_vector(lifted) * back.lift()).vector();
        for j in 0..3 {
            let column = Vec3::new(
                turn.x.derivative[j],
                turn.y.derivative[j],
                turn.z.derivative[j],
            );
            assert!(
                (column + column).distance(Rotation3::left_jacobian(v)[j]) < 1e-13,
                "{v}"
            );
        }
        // Derivatives of the Jacobian and its inverse are finite.
        for jacobian in [
            Rotation3::left_jacobian(lifted),
            Rotation3::left_jacobian_inverse(lifted),
        ] {
            assert!(
                jacobian
                    .scalars()
                    .iter()
                    .all(|x| x.derivative.iter().all(|d| d.is_finite()))
            );
        }
        if v.length() < PI - 1e-3 {
            let step = Vec3::new(
                Jet::<f64, 3>::variable(0.0, 0),
                Jet::variable(0.0, 1),
                Jet::variable(0.0, 2),
            );
            let q: Rotation3<Jet<f64, 3>> = Rotation3::from_rotation_vector(v).lift();
            let log = q.retract(step).rotation_vector();
            for j in 0..3 {
                let column = Vec3::new(
                    log.x.derivative[j],
                    log.y.derivative[j],
                    log.z.derivative[j],
                );
                let expected = Rotation3::right_jacobian_inverse(v)[j];
                assert!(column.distance(expected) < 1e-10, "{v}");
            }
        }
    }
}

#[test]
fn twists_are_those_of_the_matrix_exponential() {
    let mut random = Random(13);
    for turn in rotation_vectors(&mut random) {
        let shift = random.vector(2.0);
        let mut block = [[0.0; 4]; 4];
        for (i, row) in hat(turn).into_iter().enumerate() {
            block[i][..3].copy_from_slice(&row);
        }
        (block[0][3], block[1][3], block[2][3]) = (shift.x, shift.y, shift.z);
        let expected = exponential(block);
        let pose = Pose3::from_twist(turn, shift);
        let there = Vec3::new(expected[0][3], expected[1][3], expected[2][3]);
        assert!(pose.translation.distance(there) < 1e-13, "{turn}");
        if turn.length() < PI - 1e-12 {
            let (turned, shifted) = pose.twist();
            assert!(
                turned.distance(turn) < 1e-14 && shifted.distance(shift) < 4e-14,
                "{turn}"
            );
        }
        // Screws add along one axis, and the adjoint exchanges a motion and a twist.
        let half = Pose3::from_twist(turn * 0.5, shift * 0.5);
        assert!((half * half).translation.distance(pose.translation) < 1e-13);
        let frame = Pose3::new(random.vector(3.0), random_rotation(&mut random));
        let (by_turn, by_shift) = frame.adjoint(turn, shift);
        let point = random.vector(1.0);
        let one = Pose3::from_twist(by_turn, by_shift) * (frame * point);
        assert!(one.distance(frame * (pose * point)) < 1e-12);
        let (moment, force) = (random.vector(1.0), random.vector(1.0));
        let (m, f) = frame.adjoint_transposed(moment, force);
        let power = moment.dot(by_turn) + force.dot(by_shift);
        assert!((power - m.dot(turn) - f.dot(shift)).abs() < 1e-12);
    }
}

#[test]
fn angles_between_rotations() {
    if !geograd_tests::is_due("angles_between_rotations") {
        return;
    }
    let mut random = Random(14);
    for _ in 0..300 {
        let (a, c) = (random_rotation(&mut random), random_rotation(&mut random));
        for angle in [0.0, 1e-12, 1e-9, 0.5, 3.0, PI] {
            let axis = random.vector(1.0);
            let b = a * Rotation3::from_axis_angle(axis, angle);
            assert!((a.angle_to(b) - angle).abs() < 1e-15 * 8.0);
            assert!((a.squared_angle_to(b) - angle * angle).abs() < 1e-13);
        }
        assert_eq!(a.angle_to(a), 0.0);
        assert!(((c * a).angle_to(c) - (a.angle())).abs() < 1e-14);
        let trace: f64 = (0..3)
            .map(|i| {
                (0..3)
                    .map(|k| a.matrix()[k][i] * c.matrix()[k][i])
                    .sum::<f64>()
            })
            .sum();
        assert!((a.angle_to(c).cos() - (trace - 1.0) / 2.0).abs() < 1e-14);
        let (_, by) = geograd::gradient(|q: Rotation3<_>| q.angle_to(a.lift()), a);
        assert_eq!((by.w, by.x, by.y, by.z), (0.0, 0.0, 0.0, 0.0));
        let (_, by) = geograd::gradient(|q: Rotation3<_>| q.squared_angle_to(a.lift()), a);
        assert_eq!((by.w, by.x, by.y, by.z), (0.0, 0.0, 0.0, 0.0));
    }
    Check::of(Angle.row::<(Rotation3<f64>, Rotation3<f64>)>())
        .samples(200)
        .assert();
}

#[test]
fn two_columns_are_coordinates() {
    let mut random = Random(15);
    for _ in 0..300 {
        let q = random_rotation(&mut random);
        let [x, y] = q.to_6d();
        for scale in [1e-100, 1.0, 1e100] {
            let found = Rotation3::from_6d([x * scale, (y * 3.0 + x * 7.0) * scale]);
            assert!(found.angle_to(q) < 1e-14);
        }
        for y in [Vec3::zero(), x, x * -3.0, x * 1e-17] {
            let (_, [by_x, by_y]) = geograd::gradient(
                |[x, y]: [Vec3<_>; 2]| Rotation3::from_6d([x, y]).axes()[1].x,
                [x, y],
            );
            assert!(by_x.is_finite() && by_y == Vec3::zero());
            assert!(Rotation3::from_6d([x, y]).axes()[0].distance(x) < 1e-14);
        }
        let found = Rotation3::from_6d([Vec3::zero(), y]);
        assert!(found.vector().is_finite() && found.axes()[0].x > 0.999);
    }
    let none = Rotation3::from_6d([Vec3::zero(), Vec3::<f64>::zero()]);
    assert!((none.angle() % (PI / 2.0)).abs() < 1e-15);
}
