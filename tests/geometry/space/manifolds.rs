//! Contact manifolds: points that lie on both shapes, polygons of faces that lie on each other, derivatives.
use super::draw::Random;
use geograd::distance3::{Apart, Contacts3, contacts};
use geograd::prelude::*;
use geograd::{Pack, Scalar, ad};

fn rotation(random: &mut Random) -> Rotation3<f64> {
    let v = random.vector(1.0);
    Rotation3::new(random.within(-1.0, 1.0), v.x, v.y, v.z)
}
fn cube(x: f64, y: f64, z: f64) -> Obb3<f64> {
    Obb3::new(
        Vec3::new(x, y, z),
        Vec3::new(2.0, 2.0, 2.0),
        Rotation3::identity(),
    )
}

/// Judges what holds for every contact.
pub fn judge<A, B>(a: A, b: B, within: f64) -> Contacts3<f64>
where
    A: Apart<B, Scalar = f64>,
    B: Copy,
    Vec3<f64>: Apart<A, Scalar = f64> + Apart<B, Scalar = f64>,
{
    judge_round(a, b, within, 1e-11)
}

/// Judges a contact whose points may lie some way inside.
pub fn judge_round<A, B>(a: A, b: B, within: f64, inside: f64) -> Contacts3<f64>
where
    A: Apart<B, Scalar = f64>,
    B: Copy,
    Vec3<f64>: Apart<A, Scalar = f64> + Apart<B, Scalar = f64>,
{
    let found = contacts(a, b, within);
    let apart = a.signed_distance(b);
    assert_eq!(found.points().is_empty(), apart > within, "{apart}");
    if found.points().is_empty() {
        assert_eq!(
            found,
            Contacts3 {
                normal: Vec3::zero(),
                ..found
            }
        );
        return found;
    }
    let least = found
        .points()
        .iter()
        .fold(f64::MAX, |least, p| least.min(p.gap));
    assert!((least - apart).abs() < 1e-12, "{least} {apart}");
    for p in found.points() {
        assert!(p.gap <= within.max(apart + 1e-12));
        assert!(
            (p.on_b - p.on_a - found.normal * p.gap).length() < 1e-12,
            "{p:?}"
        );
        // Faces lie on the border.
        let [on_a, on_b] = [p.on_a.signed_distance(a), p.on_b.signed_distance(b)];
        let near = |apart: f64| apart < 1e-11 && apart > -inside;
        assert!(near(on_a) && near(on_b), "{on_a} {on_b} {p:?}");
    }
    found
}

#[test]
fn points_lie_on_both_shapes() {
    if !geograd_tests::is_due("points_lie_on_both_shapes") {
        return;
    }
    let mut random = Random(0xc0a7);
    let mut counts = [0; 9];
    for k in 0..4_000 {
        let size = |random: &mut Random| {
            Vec3::new(
                random.within(0.2, 2.0),
                random.within(0.2, 2.0),
                random.within(0.2, 2.0),
            )
        };
        let a = Obb3::new(random.vector(1.5), size(&mut random), rotation(&mut random));
        let mut b = Obb3::new(random.vector(1.5), size(&mut random), rotation(&mut random));
        if k % 2 == 0 {
            // A box that lies on another one, turned about the normal, a little tilted in every other pair.
            let tilt = if k % 4 == 0 {
                0.0
            } else {
                random.power(-12.0, -1.0)
            };
            let tilt = Rotation3::from_rotation_vector(random.vector(tilt));
            b.rotation = a.rotation * tilt * Rotation3::from_yaw(random.within(-3.0, 3.0));
            let up = a.rotation * Vec3::new(0.0, 0.0, 1.0);
            b.center = a.center
                + up * (0.5 * (a.size.z + b.size.z) + random.within(-0.05, 0.05))
                + a.rotation * Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 0.0);
        }
        let within = random.within(0.0, 0.1);
        let ball = Sphere::new(b.center, 0.5);
        let link = Capsule3::new(
            b.center - b.rotation * b.size * 0.4,
            b.center + b.rotation * b.size * 0.4,
            0.2,
        );
        let corners = b.corners();
        let face = Triangle3::new(corners[0], corners[1], corners[3]);
        let solid = Tetrahedron::new(corners[0], corners[1], corners[2], corners[4]);
        let floor = Plane3::new(
            a.rotation * Vec3::new(0.0, 0.0, 1.0),
            a.center.dot(a.rotation * Vec3::new(0.0, 0.0, 1.0)),
        );
        counts[judge(a, b, within).points().len()] += 1;
        judge(b, a, within);
        judge(a, ball, within);
        judge_round(a, link, within, 0.1 + 1e-11);
        judge_round(link, a, within, 0.1 + 1e-11);
        judge(a, face, within);
        judge(a, solid, within);
        judge(solid, solid, within);
        judge(floor, b, within);
        judge_round(link, floor, within, 0.1 + 1e-11);
        judge_round(RoundBox3::new(a, 0.1), b, within, 0.1 + 1e-11);
    }
    assert!(
        counts[1] > 50 && counts[4] > 100 && counts.iter().skip(5).sum::<i32>() > 100,
        "{counts:?}"
    );
}

/// The polygon of boxes that lie on each other is the intersection of their rectangles.
#[test]
fn faces_that_lie_on_each_other_give_their_polygon() {
    let mut random = Random(0xfa5e);
    for k in 0..1_000 {
        let (x, y) = (random.within(-1.5, 1.5), random.within(-1.5, 1.5));
        let quarter = std::f64::consts::FRAC_PI_4 * random.below(8) as f64;
        let yaw = if k % 2 == 0 {
            quarter
        } else {
            random.within(-3.0, 3.0)
        };
        let a = cube(0.0, 0.0, 0.0);
        let mut b = cube(x, y, 2.0);
        if k % 5 == 0 {
            (b.center.x, b.center.y) = (0.0, 0.0);
        }
        b.rotation = Rotation3::from_yaw(yaw);
        let found = judge(a, b, 1e-9);
        let flat = |b: Obb3<f64>, yaw: f64| Obb2::new(b.center.x, b.center.y, 2.0, 2.0, yaw);
        let area = flat(a, 0.0).intersection_area(flat(b, yaw));
        let points = found.points();
        let shoelace: f64 = (0..points.len())
            .map(|i| {
                let (p, q) = (points[i].on_a, points[(i + 1) % points.len()].on_a);
                0.5 * (p.x * q.y - q.x * p.y)
            })
            .sum();
        assert!(
            (shoelace - area).abs() < 1e-9,
            "{shoelace} {area} {found:?}"
        );
        assert!(points.iter().all(|p| (p.on_a.z - 1.0).abs() < 1e-12));
    }
}

#[test]
fn known_contacts() {
    let up = Vec3::new(0.0, 0.0, 1.0);
    assert_eq!(
        judge(cube(0.0, 0.0, 0.0), cube(0.0, 0.0, 2.0), 0.0).count,
        4.0
    );
    assert_eq!(
        judge(cube(0.0, 0.0, 0.0), cube(1.0, 1.0, 2.0), 0.0).count,
        4.0
    );
    let mut turned = cube(0.0, 0.0, 2.0);
    turned.rotation = Rotation3::from_yaw(std::f64::consts::FRAC_PI_4);
    assert_eq!(judge(cube(0.0, 0.0, 0.0), turned, 1e-9).count, 8.0);
    let floor = Plane3::new(up, 0.0);
    let found = judge(floor, cube(0.0, 0.0, 0.75), 0.0);
    assert_eq!((found.count, found.points[0].gap), (4.0, -0.25));
    // Two parallel capsules side by side; a capsule across another one.
    let link = |from: Vec3<f64>, to: Vec3<f64>| Capsule3::new(from, to, 0.5);
    let (x, y) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
    let lying = link(x * -2.0, x * 2.0);
    assert_eq!(
        judge(lying, link(x * -1.0 + up, x * 9.0 + up), 0.0).count,
        2.0
    );
    assert_eq!(judge(lying, link(up - y, up + y), 0.0).count, 1.0);
    assert_eq!(judge(lying, link(x * 3.0, x * 5.0), 0.0).count, 1.0);
    // A capsule on a table, half over the edge.
    let found = judge(cube(0.0, 0.0, 0.0), link(up * 1.5, up * 1.5 + x * 4.0), 0.0);
    let ends: Vec<f64> = found.points().iter().map(|p| p.on_a.x).collect();
    assert!(ends == [0.0, 1.0] || ends == [1.0, 0.0], "{ends:?}");
    // A corner on a face, an edge across an edge.
    let mut corner = cube(0.0, 0.0, 1.0 + 3_f64.sqrt());
    corner.rotation = Rotation3::from_axis_angle(Vec3::new(1.0, -1.0, 0.0), -2_f64.sqrt().atan());
    assert_eq!(judge(cube(0.0, 0.0, 0.0), corner, 1e-9).count, 1.0);
    // Balls with one centre have no direction; one point remains.
    let ball = Sphere::new(Vec3::zero(), 1.0);
    assert_eq!(contacts(ball, ball, 0.0).count, 1.0);
    let can = Cylinder::new(Vec3::zero(), up, 0.5);
    assert_eq!(contacts(can, Sphere::new(up * 1.5, 0.5), 0.0).count, 1.0);
    assert!(
        contacts(Vec3::new(f64::NAN, 0.0, 0.0), ball, 0.0)
            .count
            .is_nan()
    );
}

/// Derivatives of points, gaps and normals against differences.
#[test]
fn contacts_have_derivatives() {
    let mut random = Random(0xd1ff);
    let (mut judged, mut several) = (0, 0);
    for k in 0..400 {
        let a = Obb3::new(
            random.vector(0.5),
            Vec3::new(2.0, 1.5, 1.0),
            rotation(&mut random),
        );
        let mut b = Obb3::new(
            random.vector(0.5),
            Vec3::new(1.0, 2.0, 1.5),
            rotation(&mut random),
        );
        if k % 2 == 0 {
            let tilt = Rotation3::from_rotation_vector(random.vector(0.02));
            b.rotation = a.rotation * tilt * Rotation3::from_yaw(random.within(-3.0, 3.0));
            b.center = a.center
                + a.rotation * Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 1.25);
        }
        let found = |[x, y, z, turn_x, turn_y, turn_z, height]: [f64; 7]| {
            result(
                a,
                b,
                Vec3::new(x, y, z),
                Vec3::new(turn_x, turn_y, turn_z),
                height,
            )
        };
        let at = |x: [f64; 7]| {
            let all = found(x);
            let mut numbers = all.scalars();
            numbers[3] = 0.0;
            (all.count, numbers)
        };
        let (count, middle) = at([0.0; 7]);
        let (_, slopes) = ad::jacobian(
            |[x, y, z, turn_x, turn_y, turn_z, height]: [_; 7]| {
                result(
                    a.lift(),
                    b.lift(),
                    Vec3::new(x, y, z),
                    Vec3::new(turn_x, turn_y, turn_z),
                    height,
                )
            },
            [0.0; 7],
        );
        let slopes: Vec<[f64; 7]> = slopes.scalars();
        for i in 0..7 {
            let step = 1e-6;
            let moved = |by: f64| {
                let mut x = [0.0; 7];
                x[i] = by;
                at(x)
            };
            let ((more, after), (less, before)) = (moved(step), moved(-step));
            if more != count || less != count {
                continue;
            }
            let smooth = |k: usize| (after[k] - 2.0 * middle[k] + before[k]).abs() < 1e-9;
            if !(0..middle.len()).all(smooth) {
                continue;
            }
            judged += 1;
            several += usize::from(count > 1.0);
            for k in 0..middle.len() {
                let slope = (after[k] - before[k]) / (2.0 * step);
                assert!(
                    (slope - slopes[k][i]).abs() < 1e-5 * (1.0 + slope.abs()),
                    "{i} {k}: {slope} {:?}",
                    slopes[k]
                );
            }
        }
    }
    assert!(judged > 800 && several > 100, "{judged} {several}");
}

/// The contact of two boxes, the second one shifted, turned and grown.
fn result<S: Scalar<Mask = bool>>(
    a: Obb3<S>,
    mut b: Obb3<S>,
    shift: Vec3<S>,
    turn: Vec3<S>,
    height: S,
) -> Contacts3<S> {
    b.center += shift;
    b.rotation = Rotation3::from_rotation_vector(turn) * b.rotation;
    b.size.z += height;
    contacts(a, b, S::lit(0.05))
}
