//! Derivatives of distances in space: ties, and second ones at contacts of every kind.
use super::draw::Random;
use geograd::ad::gradient;
use geograd::distance3::{PointPair3, closest_points, distance, signed_distance};
use geograd::prelude::*;

/// The largest difference of a Hessian, row by row, from central differences of gradients.
fn bend_error<const N: usize>(
    slope: impl Fn([f64; N]) -> [f64; N],
    bend: impl Fn([f64; N]) -> [f64; N],
    x: [f64; N],
) -> f64 {
    let step = 1e-5;
    let mut worst = 0.0_f64;
    for j in 0..N {
        let moved = |by: f64| {
            let mut y = x;
            y[j] += by;
            slope(y)
        };
        let (ahead, back) = (moved(step), moved(-step));
        let mut unit = [0.0; N];
        unit[j] = 1.0;
        let row = bend(unit);
        for i in 0..N {
            let difference = (ahead[i] - back[i]) / (2.0 * step);
            worst = worst.max((difference - row[i]).abs());
        }
    }
    worst
}

/// The Hessian of the signed distance of two shapes by all their numbers, against differences of gradients.
macro_rules! bends {
    ($a:expr, $b:expr, $A:ident, $B:ident, $told:expr) => {{
        let (a, b) = ($a, $b);
        const N: usize = $A::<f64>::LEN + $B::<f64>::LEN;
        let pack = |x: ($A<f64>, $B<f64>)| -> [f64; N] { x.scalars().try_into().unwrap() };
        let slope = |x: [f64; N]| {
            let x = <($A<f64>, $B<f64>)>::load(&x);
            pack(gradient(|(a, b): ($A<_>, $B<_>)| signed_distance(a, b), x).1)
        };
        let bend = |along: [f64; N]| {
            let along = <($A<f64>, $B<f64>)>::load(&along);
            let f = |(a, b): ($A<_>, $B<_>)| signed_distance(a, b);
            pack(geograd::hvp(f, (a, b), along).2)
        };
        let error = bend_error(slope, bend, pack((a, b)));
        assert!(error < 2e-6, "{}: {error:e}", $told);
    }};
}

#[test]
fn second_derivatives_at_contacts_of_every_kind() {
    if !geograd_tests::is_due("second_derivatives_at_contacts_of_every_kind") {
        return;
    }
    let turned = |v: Vec3<f64>| Rotation3::from_rotation_vector(v);
    let size = Vec3::new(1.0, 1.2, 0.8);
    let a = Obb3::new(Vec3::zero(), size, turned(Vec3::new(0.1, -0.2, 0.15)));
    for (place, turn, told) in [
        (
            Vec3::new(1.6, 1.7, 1.5),
            Vec3::new(0.3, 0.1, -0.2),
            "corner on corner",
        ),
        (
            Vec3::new(0.1, 0.05, 1.3),
            Vec3::new(0.7, 0.6, 0.3),
            "corner over face",
        ),
        (
            Vec3::new(0.1, 0.05, 1.0),
            Vec3::new(0.7, 0.6, 0.3),
            "corner in face",
        ),
        (
            Vec3::new(0.0, 1.3, 1.1),
            Vec3::new(0.2, 0.8, 0.9),
            "edge beside edge",
        ),
        (
            Vec3::new(0.0, 0.8, 0.65),
            Vec3::new(0.2, 0.8, 0.9),
            "edge in edge",
        ),
    ] {
        let b = Obb3::new(place, size, turned(turn));
        bends!(a, b, Obb3, Obb3, told);
    }
    let mut random = Random(91);
    for _ in 0..20 {
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.0));
        let (s, t) = (
            Capsule3::new(p[0], p[1], 0.1),
            Capsule3::new(p[2], p[3], 0.2),
        );
        bends!(s, t, Capsule3, Capsule3, "capsules");
    }
    let flat = Triangle3::new(
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(2.0, 0.1, 0.0),
        Vec3::new(0.1, 2.0, 0.3),
    );
    for (point, told) in [
        (Vec3::new(0.5, 0.6, 0.9), "over the face"),
        (Vec3::new(0.9, -0.8, 0.4), "beside an edge"),
        (Vec3::new(-0.7, -0.8, 0.4), "beyond a corner"),
    ] {
        bends!(point, flat, Vec3, Triangle3, told);
    }
    // Solids of corners, and a box with others: apart, and as deep as they come.
    let mut kinds = [0; 2];
    for _ in 0..25 {
        let p: [Vec3<f64>; 9] = std::array::from_fn(|_| random.vector(1.0));
        let far = Vec3::new(1.5, 0.4, 0.2) * random.below(2) as f64;
        let a = Tetrahedron::new(p[0], p[1], p[2], p[3]);
        let b = Tetrahedron::new(p[4] + far, p[5] + far, p[6] + far, p[7] + far);
        let (s, t) = (Triangle3::new(a.a, a.b, a.c), Triangle3::new(b.a, b.b, b.c));
        let link = Capsule3::new(b.a, b.b, 0.1);
        let block = Obb3::new(p[8], size, turned(p[0]));
        let gap = signed_distance(a, b);
        kinds[usize::from(gap < 0.0)] += 1;
        bends!(a, b, Tetrahedron, Tetrahedron, "tetrahedra");
        bends!(s, t, Triangle3, Triangle3, "triangles");
        bends!(block, link, Obb3, Capsule3, "box and capsule");
        bends!(t, block, Triangle3, Obb3, "triangle and box");
    }
    assert!(kinds.iter().all(|&kind| kind > 4), "{kinds:?}");
    let hat = Cone::new(Vec3::new(0.0, 0.0, 2.0), Vec3::new(0.1, 0.0, 0.0), 1.0);
    let can = Cylinder::new(Vec3::new(0.0, 0.0, 2.0), Vec3::new(0.1, 0.0, 0.0), 1.0);
    for (point, told) in [
        (Vec3::new(1.0, 0.7, 1.2), "beside the side"),
        (Vec3::new(1.0, 0.9, -0.5), "beyond the rim"),
        (Vec3::new(0.3, 0.2, -0.5), "below the base"),
        (Vec3::new(0.2, 0.3, 0.7), "inside"),
    ] {
        bends!(point, hat, Vec3, Cone, told);
        bends!(point, can, Vec3, Cylinder, told);
    }
}

#[test]
fn lines_that_are_nearly_parallel_have_second_derivatives() {
    // Their normal has fewer than half the digits of single precision, and most of double precision.
    let mut random = Random(93);
    for _ in 0..50 {
        let way = random.vector(1.0) + Vec3::new(1.5, 0.0, 0.0);
        let beside = random.vector(1e-4);
        // Nearest points near the given ones: far along the lines roundings are as large as the distance.
        let across = way.cross(beside);
        let at = across * (1e-3 / across.length()) + way * random.within(-1e-3, 1e-3);
        let lines = [Line3::new(Vec3::zero(), way), Line3::new(at, way + beside)];
        let [a, b] = lines.map(|line: Line3<f64>| line.cast::<f32>());
        let sine = {
            let [u, v] = [a, b].map(|line| line.direction.cast::<f64>());
            (u.cross(v).length_squared() / u.length_squared() / v.length_squared()).sqrt()
        };
        let along = [random.vector(1.0), random.vector(1.0)];
        let (p, q) = (
            Line3::new(along[0], Vec3::zero()),
            Line3::new(along[1], Vec3::zero()),
        );
        let (p, q): (Line3<f32>, Line3<f32>) = (p.cast(), q.cast());
        let narrow = geograd::hvp(
            |(a, b): (Line3<_>, Line3<_>)| distance(a, b),
            (a, b),
            (p, q),
        );
        let wide = geograd::hvp(
            |(a, b): (Line3<_>, Line3<_>)| distance(a, b),
            (a.cast::<f64>(), b.cast::<f64>()),
            (p.cast::<f64>(), q.cast::<f64>()),
        );
        let (narrow, wide) = (narrow.2.scalars(), wide.2.scalars());
        let largest = wide.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (x, y) in narrow.into_iter().zip(wide) {
            // A few roundings over the sine, as the normal of the directions has.
            let error = (f64::from(x) - y).abs() / largest;
            assert!(error < 4e-6 / sine, "{a:?} {b:?}: {x} {y}, sine {sine:e}");
        }
    }
}

#[test]
fn parallel_segments_share_the_middle() {
    let wire = Segment3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(8.0, 0.0, 0.0));
    let rail = Segment3::new(Vec3::new(2.0, 0.0, 3.0), Vec3::new(4.0, 0.0, 3.0));
    let (gap, (by_wire, by_rail)) = gradient(
        |(a, b): (Segment3<_>, Segment3<_>)| distance(a, b),
        (wire, rail),
    );
    assert_eq!(gap, 3.0);
    assert_eq!((by_rail.start.z, by_rail.end.z), (0.5, 0.5));
    assert_eq!((by_wire.start.z, by_wire.end.z), (-0.625, -0.375));
}

#[test]
fn stacked_boxes_share_the_corners_of_what_faces_each_other() {
    // The numbers of a box that hangs over the edge of a table: the corners of the common rectangle in the mean.
    let table = Obb3::new(
        Vec3::zero(),
        Vec3::new(4.0, 4.0, 1.0),
        Rotation3::identity(),
    );
    let size = Vec3::new(1.0, 1.0, 1.0);
    for (gap, told) in [(0.25, "apart"), (-0.25, "overlapping")] {
        let center = Vec3::new(1.75, 0.25, 1.0 + gap);
        let crate_ = Obb3::new(center, size, Rotation3::identity());
        let turn = |turn: Vec3<_>| signed_distance(table.lift().retract(turn), crate_.lift());
        let (found, slope): (f64, Vec3<f64>) = gradient(turn, Vec3::zero());
        assert!((found - gap).abs() < 1e-15, "{told}");
        // What faces each other is [1.25, 2] x [-0.25, 0.75]: a turn about x lifts by y, one about y lowers by x.
        assert!((slope.x + 0.25).abs() < 1e-15, "{told}: {slope:?}");
        assert!((slope.y - 1.625).abs() < 1e-15, "{told}: {slope:?}");
        let found = closest_points(table, crate_);
        let middle = Vec3::new(1.625, 0.25, 0.5);
        assert!((found.on_a - middle).length() < 1e-15, "{told}: {found:?}");
        assert!(
            (found.on_b - found.on_a - Vec3::new(0.0, 0.0, gap)).length() < 1e-15,
            "{told}: {found:?}"
        );
    }
}

#[test]
fn three_faces_share_in_thirds() {
    let cube = Obb3::new(
        Vec3::zero(),
        Vec3::new(2.0, 2.0, 2.0),
        Rotation3::identity(),
    );
    let ball = Sphere::new(Vec3::new(0.5, 0.5, 0.5), 0.25);
    let (depth, slope): (f64, Sphere<f64>) =
        gradient(|p: Sphere<_>| signed_distance(p, cube.lift()), ball);
    assert_eq!(depth, -0.75);
    let third = 1.0 / 3.0;
    for share in [slope.center.x, slope.center.y, slope.center.z] {
        assert!((share - third).abs() < 1e-15, "{slope:?}");
    }
    assert_eq!(slope.radius, -1.0);
}

#[test]
fn ends_that_are_equally_deep_share() {
    let room = Obb3::new(
        Vec3::zero(),
        Vec3::new(4.0, 4.0, 2.0),
        Rotation3::identity(),
    );
    for reach in [0.0, 0.5] {
        let link = Capsule3::new(
            Vec3::new(-reach, 0.0, 0.25),
            Vec3::new(reach, 0.0, 0.25),
            0.0,
        );
        let (depth, (by_link, by_room)): (f64, (Capsule3<f64>, Obb3<f64>)) = gradient(
            |(a, b): (Capsule3<_>, Obb3<_>)| signed_distance(a, b),
            (link, room),
        );
        assert_eq!(depth, -0.75);
        assert_eq!((by_link.start.z, by_link.end.z), (0.5, 0.5));
        assert_eq!((by_room.size.z, by_room.center.z), (-0.5, -1.0));
    }
}

#[test]
fn planes_that_part_alike_share() {
    // A corner is as deep behind each of three faces.
    let wedge = Tetrahedron::new(
        Vec3::zero(),
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    );
    let room = Obb3::new(
        Vec3::new(-0.4, -0.4, -0.4),
        Vec3::new(1.0, 1.0, 1.0),
        Rotation3::identity(),
    );
    let f = |(a, b): (Tetrahedron<_>, Obb3<_>)| signed_distance(a, b);
    let (depth, (_, by_room)) = gradient(f, (wedge, room));
    assert!((depth + 0.1_f64).abs() < 1e-15);
    for (size, center) in [
        (by_room.size.x, by_room.center.x),
        (by_room.size.y, by_room.center.y),
        (by_room.size.z, by_room.center.z),
    ] {
        assert!((size + 1.0 / 6.0).abs() < 1e-15 && (center + 1.0 / 3.0).abs() < 1e-15);
    }
}

/// The derivatives of both nearest points against central differences of them.
macro_rules! points_move {
    ($a:expr, $b:expr, $A:ident, $B:ident, $told:expr) => {{
        let x = ($a, $b).scalars();
        let numbers = |p: PointPair3<f64>| p.scalars();
        for j in 0..x.len() {
            let moved = |by: f64| {
                let mut y = x.clone();
                y[j] += by;
                let (a, b) = <($A<f64>, $B<f64>)>::load(&y);
                numbers(closest_points(a, b))
            };
            let mut along = vec![0.0; x.len()];
            along[j] = 1.0;
            let along = <($A<f64>, $B<f64>)>::load(&along);
            let found = |axis: usize| {
                let f = |(a, b): ($A<_>, $B<_>)| {
                    let p = closest_points(a, b);
                    [p.on_a.x, p.on_a.y, p.on_a.z, p.on_b.x, p.on_b.y, p.on_b.z][axis]
                };
                geograd::jvp(f, ($a, $b), along).1
            };
            let (ahead, back) = (moved(1e-6), moved(-1e-6));
            for axis in 0..6 {
                let difference = (ahead[axis] - back[axis]) / 2e-6;
                let error = (found(axis) - difference).abs();
                assert!(error < 1e-7, "{}: number {j}, {axis}: {error:e}", $told);
            }
        }
    }};
}

#[test]
fn nearest_points_move_as_their_derivatives_say() {
    let flat = Triangle3::new(
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(2.0, 0.1, 0.0),
        Vec3::new(0.1, 2.0, 0.3),
    );
    let tip = Triangle3::new(
        Vec3::new(0.5, 0.6, 0.9),
        Vec3::new(0.4, 0.7, 2.0),
        Vec3::new(0.9, 0.3, 2.0),
    );
    points_move!(flat, tip, Triangle3, Triangle3, "corner over a face of a");
    points_move!(tip, flat, Triangle3, Triangle3, "corner over a face of b");
    let size = Vec3::new(1.0, 1.2, 0.8);
    let turned = Rotation3::from_rotation_vector(Vec3::new(0.2, 0.8, 0.9));
    let a = Obb3::new(Vec3::zero(), size, Rotation3::new(1.0, 0.05, -0.1, 0.07));
    let b = Obb3::new(Vec3::new(0.0, 1.3, 1.1), size, turned);
    points_move!(a, b, Obb3, Obb3, "edge beside edge");
    let (s, t) = (
        Capsule3::new(Vec3::new(-1.0, 0.1, 0.0), Vec3::new(1.0, 0.0, 0.2), 0.1),
        Capsule3::new(Vec3::new(0.1, -1.0, 1.0), Vec3::new(0.0, 1.0, 1.3), 0.2),
    );
    points_move!(s, t, Capsule3, Capsule3, "edges that cross");
}

#[test]
fn touching_keeps_the_signed_slope_and_drops_the_other() {
    let floor = Obb3::new(
        Vec3::zero(),
        Vec3::new(4.0, 4.0, 2.0),
        Rotation3::identity(),
    );
    for height in [0.0, 1e-9, -1e-9] {
        let at = Vec3::new(0.3, 0.2, 1.0 + height);
        let tip = Tetrahedron::new(
            at,
            at + Vec3::new(1.0, 0.0, 2.0),
            at + Vec3::new(-1.0, 1.0, 2.0),
            at + Vec3::new(0.0, -1.0, 2.0),
        );
        let (gap, slope): (f64, Tetrahedron<f64>) =
            gradient(|t: Tetrahedron<_>| signed_distance(t, floor.lift()), tip);
        assert!((gap - height).abs() < 1e-15, "{gap} {height}");
        assert!((slope.a.z - 1.0).abs() < 1e-6, "{slope:?}");
        let (_, slope): (f64, Tetrahedron<f64>) =
            gradient(|t: Tetrahedron<_>| distance(t, floor.lift()), tip);
        let expected = if height > 0.0 { 1.0 } else { 0.0 };
        assert!((slope.a.z - expected).abs() < 1e-6, "{slope:?}");
    }
}

/// Bodies whose gap is 10¹³⁶ times smaller than they are: its square vanishes, and with it the direction.
#[test]
fn a_gap_whose_square_vanishes_has_finite_derivatives() {
    let v = |x, y, z| Vec3::new(x, y, z);
    let body = Tetrahedron::new(
        v(-6.206242120024214e42_f64, 0.0, -1.4544e-13),
        v(0.0, 0.0, 1.3738e-40),
        v(0.0, -1.2146582430185595e40, 1.0408999058074796e-40),
        v(0.0, -4.181389724724492e43, 8.720215329647894e42),
    );
    let plate = Obb3::new(
        v(-1.0, -983040.0, 0.0),
        v(0.0, 0.0, 109219.5623029203),
        Rotation3::new(2415919104.0, 1090519040.0, -1.246397447714898e17, 0.0),
    );
    let cpu = Cpu::new();
    let call = (&[body], &[plate]);
    let apart = cpu.aligned(Distance.value_grad(), call).unwrap();
    let signed = cpu.aligned(SignedDistance.value_grad(), call).unwrap();
    for (value, (by_body, by_plate)) in [apart, signed] {
        assert!((0.0..1e-90).contains(&value[0]), "{value:?}");
        let slopes = [by_body[0].scalars(), by_plate[0].scalars()].concat();
        assert!(slopes.iter().all(|x: &f64| x.is_finite()), "{slopes:?}");
    }
}
