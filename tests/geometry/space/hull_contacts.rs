//! Contacts of hulls and of shapes with round ends: points on both, polygons of faces, derivatives.
use super::draw::Random;
use super::manifolds::judge;
use geograd::distance3::{Apart, Contacts3, contacts};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid, Pack, ad};
use std::f64::consts::TAU;

type Hull = Hull3<f64, 16>;

/// The area of a polygon of places.
fn area(ring: &[[f64; 2]]) -> f64 {
    let n = ring.len();
    let part = |k: usize| {
        let ([a, b], [c, d]) = (ring[k], ring[(k + 1) % n]);
        0.5 * (a * d - b * c)
    };
    (0..n).map(part).sum()
}

/// The part of a convex polygon inside another one, both counter-clockwise (Sutherland, Hodgman 1974).
fn clipped(ring: &[[f64; 2]], by: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut all = ring.to_vec();
    for k in 0..by.len() {
        let ([a, b], [c, d]) = (by[k], by[(k + 1) % by.len()]);
        let height = |[x, y]: [f64; 2]| (c - a) * (y - b) - (d - b) * (x - a);
        let mut next = Vec::new();
        for i in 0..all.len() {
            let (p, q) = (all[i], all[(i + 1) % all.len()]);
            let (up, to) = (height(p), height(q));
            if up >= 0.0 {
                next.push(p);
            }
            if (up >= 0.0) != (to >= 0.0) {
                let t = up / (up - to);
                next.push([0, 1].map(|j| p[j] + (q[j] - p[j]) * t));
            }
        }
        all = next;
    }
    all
}

/// The corners of a regular polygon.
fn regular(n: usize, radius: f64, from: f64, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    let corner = |k: usize| {
        let (sin, cos) = (from + k as f64 * TAU / n as f64).sin_cos();
        [x + radius * cos, y + radius * sin]
    };
    (0..n).map(corner).collect()
}

/// A prism over a polygon, its corners in a random order.
fn prism(random: &mut Random, ring: &[[f64; 2]], low: f64, high: f64) -> Vec<Vec3<f64>> {
    let mut all: Vec<_> = ring
        .iter()
        .flat_map(|&[x, y]| [low, high].map(|z| Vec3::new(x, y, z)))
        .collect();
    for k in (1..all.len()).rev() {
        all.swap(k, random.below(k + 1));
    }
    all
}

#[test]
fn prisms_that_lie_on_each_other_give_their_polygon() {
    let mut random = Random(0x9a11_e75a);
    let mut judged = 0;
    for k in 0..600 {
        let [m, n] = [(); 2].map(|()| 3 + random.below(6));
        let [from, to] = [(); 2].map(|()| random.within(0.0, 6.0));
        let below = regular(m, random.within(0.5, 1.5), from, [0.0, 0.0]);
        let at = [random.within(-1.0, 1.0), random.within(-1.0, 1.0)];
        let above = regular(n, random.within(0.5, 1.5), to, at);
        let truth = clipped(&above, &below);
        // Turned, the faces are flat within rounding only.
        let turn = match k % 2 {
            0 => Rotation3::identity(),
            _ => Rotation3::from_axis_angle(random.vector(1.0), random.within(0.1, 3.0)),
        };
        let made = |all: Vec<Vec3<f64>>| {
            let all: Vec<_> = all.into_iter().map(|v| turn * v).collect();
            Hull::from_vertices(&all)
        };
        let a = made(prism(&mut random, &below, -1.0, 0.0));
        let b = made(prism(&mut random, &above, 0.0, 1.0));
        let found = judge(a, b, 1e-9);
        if truth.is_empty() || area(&truth) < 1e-3 {
            continue;
        }
        let up = turn * Vec3::new(0.0, 0.0, 1.0);
        assert!((found.normal - up).length() < 1e-9, "{found:?}");
        let flat = |v: Vec3<f64>| {
            let v = turn.inverse() * v;
            [v.x, v.y]
        };
        let ring: Vec<_> = found.points().iter().map(|p| flat(p.on_a)).collect();
        let (found, truth) = (area(&ring), area(&truth));
        match ring.len() {
            8 => assert!(
                found > 0.8 * truth && found < truth + 1e-9,
                "{found} {truth}"
            ),
            _ => assert!((found - truth).abs() < 1e-9, "{found} {truth} {ring:?}"),
        }
        judged += 1;
    }
    assert!(judged > 300, "{judged}");
}

#[test]
fn hulls_of_boxes_touch_as_boxes_do() {
    let mut random = Random(0xb0b0_5e5e);
    let mut several = 0;
    for _ in 0..400 {
        let turn = Rotation3::from_axis_angle(random.vector(1.0), random.within(0.1, 3.0));
        let a = Obb3::new(random.vector(1.0), Vec3::new(2.0, 1.5, 1.0), turn);
        let tilt = Rotation3::from_rotation_vector(random.vector(0.03));
        let yaw = Rotation3::from_yaw(random.within(-3.0, 3.0));
        let shift = Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 1.25);
        let b = Obb3::new(
            a.center + turn * shift,
            Vec3::new(1.0, 2.0, 1.5),
            turn * tilt * yaw,
        );
        let known = contacts(a, b, 0.05);
        for found in [
            contacts(Hull3::from(a), Hull3::from(b), 0.05),
            contacts(a, Hull3::from(b), 0.05),
            contacts(Hull3::from(a), b, 0.05),
        ] {
            assert_eq!(found.count, known.count, "{found:?} {known:?}");
            assert!((found.normal - known.normal).length() < 1e-9);
            for p in found.points() {
                let same = |q: &&geograd::distance3::ContactPoint3<f64>| {
                    (q.on_a - p.on_a).length() + (q.on_b - p.on_b).length() < 1e-9
                };
                assert!(
                    known.points().iter().any(|q| same(&q)),
                    "{found:?} {known:?}"
                );
            }
        }
        several += usize::from(known.count > 2.0);
    }
    assert!(several > 100, "{several}");
}

fn table() -> Obb3<f64> {
    Obb3::new(
        Vec3::new(0.0, 0.0, -1.0),
        Vec3::new(4.0, 4.0, 2.0),
        Rotation3::identity(),
    )
}

#[test]
fn round_ends_touch_in_eight_points_of_the_rim() {
    let up = Vec3::new(0.0, 0.0, 1.0);
    let (table, board) = (table(), Hull3::from(table()));
    let at = Vec3::new(0.5, -0.25, 0.0);
    let judge_rim = |found: Contacts3<f64>| {
        assert_eq!(found.count, 8.0, "{found:?}");
        for p in found.points() {
            assert!(((p.on_b - at).length() - 0.75).abs() < 1e-12, "{p:?}");
        }
        let ring: Vec<_> = found
            .points()
            .iter()
            .map(|p| [p.on_b.x, p.on_b.y])
            .collect();
        let octagon = 2.0 * 2_f64.sqrt() * 0.75 * 0.75;
        assert!((area(&ring).abs() - octagon).abs() < 1e-12, "{ring:?}");
    };
    let (can, hat) = (
        Cylinder::new(at, at + up * 2.0, 0.75),
        Cone::new(at + up * 2.0, at, 0.75),
    );
    let coin = Disc::new(at, up, 0.75);
    let floor = Plane3::new(up, 0.0);
    judge_rim(judge(table, can, 1e-9));
    judge_rim(judge(board, can, 1e-9));
    judge_rim(judge(floor, can, 1e-9));
    judge_rim(judge(table, hat, 1e-9));
    judge_rim(judge(board, hat, 1e-9));
    judge_rim(judge(floor, hat, 1e-9));
    judge_rim(contacts(table, coin, 1e-9));
    judge_rim(contacts(floor, coin, 1e-9));
    judge_rim(contacts(Cylinder::new(at - up, at, 0.75), can, 1e-9));
    // Half over the edge of the table.
    let far = Vec3::new(2.0, 0.0, 0.0);
    let found = judge(table, Cylinder::new(far, far + up, 0.75), 1e-9);
    let ring: Vec<_> = found
        .points()
        .iter()
        .map(|p| [p.on_a.x, p.on_a.y])
        .collect();
    let half = 2_f64.sqrt() * 0.75 * 0.75;
    assert!((area(&ring) - half).abs() < 1e-12, "{ring:?}");
}

#[test]
fn straight_sides_touch_in_two_points() {
    let (x, y, up) = (
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    );
    let (table, board) = (table(), Hull3::from(table()));
    let floor = Plane3::new(up, 0.0);
    let lying = |from: Vec3<f64>, to: Vec3<f64>| Cylinder::new(from + up * 0.5, to + up * 0.5, 0.5);
    let can = lying(y * -1.0, y);
    assert_eq!(judge(table, can, 1e-9).count, 2.0);
    assert_eq!(judge(board, can, 1e-9).count, 2.0);
    assert_eq!(judge(floor, can, 1e-9).count, 2.0);
    // Side by side; half over the edge; across.
    let found = judge(can, lying(x + y * 0.5, x + y * 3.0), 1e-9);
    let mut ends: Vec<f64> = found.points().iter().map(|p| p.on_a.y).collect();
    ends.sort_by(f64::total_cmp);
    assert!(
        ends.len() == 2 && (ends[0] - 0.5).abs() + (ends[1] - 1.0).abs() < 1e-12,
        "{ends:?}"
    );
    let found = judge(table, lying(y, y * 5.0), 1e-9);
    let mut ends: Vec<f64> = found.points().iter().map(|p| p.on_a.y).collect();
    ends.sort_by(f64::total_cmp);
    assert!(
        ends.len() == 2 && (ends[0] - 1.0).abs() + (ends[1] - 2.0).abs() < 1e-12,
        "{ends:?}"
    );
    assert_eq!(judge(can, lying(up - x, up + x), 1e-9).count, 1.0);
    // A cone on its side, and an edge of a hull on a face.
    let slope = 0.5_f64.atan();
    let axis = Vec3::new(slope.cos(), 0.0, slope.sin());
    let height = 1.5;
    let hat = Cone::new(Vec3::zero(), axis * height, height * 0.5);
    assert_eq!(judge(floor, hat, 1e-9).count, 2.0);
    assert_eq!(judge(table, hat, 1e-9).count, 2.0);
    assert_eq!(judge(board, hat, 1e-9).count, 2.0);
    let roof: Hull = Hull::from_vertices(&[
        y * -0.5,
        y * 0.5,
        up + x - y,
        up + x + y,
        up - x - y,
        up - x + y,
    ]);
    let found = judge(board, roof, 1e-9);
    let all = found
        .points()
        .iter()
        .all(|p| (p.on_a.y.abs() - 0.5).abs() < 1e-12);
    assert!(found.count == 2.0 && all, "{found:?}");
    assert_eq!(judge(floor, roof, 1e-9).count, 2.0);
    // Round all over.
    let egg = Ellipsoid::new(up, Vec3::new(1.0, 2.0, 1.0), Rotation3::identity());
    assert_eq!(contacts(board, egg, 1e-9).count, 1.0);
}

#[test]
fn points_lie_on_hulls_and_round_shapes() {
    let mut random = Random(0xc0a7_0002);
    let mut counts = [0; 9];
    for _ in 0..300 {
        let corners: Vec<_> = (0..10).map(|_| random.vector(0.8)).collect();
        let turn = Rotation3::from_axis_angle(random.vector(1.0), random.within(0.0, 3.0));
        let (at, axis) = (
            random.vector(1.5),
            turn * Vec3::new(0.0, 0.0, random.within(0.3, 1.0)),
        );
        let within = random.within(0.0, 0.1);
        let hull = Hull::from_vertices(&corners);
        let can = Cylinder::new(at - axis, at + axis, random.within(0.1, 0.6));
        let hat = Cone::new(at - axis, at + axis, random.within(0.1, 0.6));
        let crate_of = Obb3::new(at, Vec3::new(1.0, 0.7, 0.4), turn);
        let other = Hull::from_vertices(&crate_of.corners());
        counts[judge(hull, other, within).points().len()] += 1;
        judge(other, hull, within);
        judge(hull, can, within);
        judge(can, hull, within);
        judge(hull, hat, within);
        judge(hat, can, within);
        judge(hull, crate_of, within);
        judge(
            Triangle3::new(corners[0], corners[1], corners[2]),
            other,
            within,
        );
        let floor = Plane3::through(at, axis);
        judge(floor, hull, within);
        judge(hat, floor, within);
    }
    assert!(
        counts[1..].iter().sum::<i32>() > 50 && counts[3] > 10,
        "{counts:?}"
    );
}

/// Derivatives of points, gaps and normals against differences.
fn differentiate<A, B>(
    a: A,
    b: B,
    moved: impl Fn([f64; 6]) -> Contacts3<f64>,
    slopes: &[[f64; 6]],
) -> usize
where
    A: Apart<B, Scalar = f64> + std::fmt::Debug,
    B: Copy + std::fmt::Debug,
{
    let numbers = |x: [f64; 6]| {
        let all = moved(x);
        (all.count, all.scalars())
    };
    let (count, middle) = numbers([0.0; 6]);
    let mut judged = 0;
    for i in 0..6 {
        let at = |by: f64| {
            let mut x = [0.0; 6];
            x[i] = by;
            numbers(x)
        };
        let ((more, after), (less, before)) = (at(1e-6), at(-1e-6));
        let smooth = |k: usize| (after[k] - 2.0 * middle[k] + before[k]).abs() < 1e-9;
        if more != count || less != count || !(0..middle.len()).all(smooth) {
            continue;
        }
        judged += 1;
        for k in 0..middle.len() {
            let slope = (after[k] - before[k]) / 2e-6;
            let found = if k == 3 { slope } else { slopes[k][i] };
            assert!(
                (slope - found).abs() < 1e-5 * (1.0 + slope.abs()),
                "{i} {k}: {slope} {found} {a:?} {b:?}"
            );
        }
    }
    judged
}

#[test]
fn contacts_of_hulls_and_round_shapes_have_derivatives() {
    let mut random = Random(0xd1ff_0002);
    let mut judged = 0;
    for _ in 0..150 {
        let tilt = Rotation3::from_rotation_vector(random.vector(0.05));
        let (up, at) = (tilt * Vec3::new(0.0, 0.0, 1.0), random.vector(1.5));
        let at = Vec3::new(at.x, at.y, random.within(-0.01, 0.02));
        let (can, board) = (Cylinder::new(at, at + up, 0.5), Hull3::from(table()));
        macro_rules! judge_one {
            ($a:expr, $b:expr) => {{
                let (a, b) = ($a, $b);
                fn result<S: Scalar<Mask = bool>>(
                    a: Hull3<S, 8>,
                    mut can: Cylinder<S>,
                    [x, y, z, u, v, w]: [S; 6],
                ) -> Contacts3<S> {
                    can.start += Vec3::new(x, y, z);
                    can.end += Vec3::new(u, v, w);
                    contacts(a, can, S::lit(0.05))
                }
                let (_, slopes) = ad::jacobian(|x: [_; 6]| result(a.lift(), b.lift(), x), [0.0; 6]);
                let slopes: Vec<[f64; 6]> = slopes.scalars();
                judged += differentiate(a, b, |x| result(a, b, x), &slopes);
            }};
        }
        judge_one!(board, can);
    }
    assert!(judged > 300, "{judged}");
}
