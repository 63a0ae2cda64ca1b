//! Rows of bodies, measures of hulls, contacts and motions, beside the functions of the crate on dual numbers.
use super::draw::Random;
use geograd::distance3::contacts;
use geograd::kernels::{
    Centroid, Clearance, Contacts, Distance, One, SignedDistance, Surface, TimeOfImpact, Volume,
};
use geograd::motion::{Motion3, Moves as _};
use geograd::prelude::*;
use geograd::{Pack, ad};

fn rotation(random: &mut Random) -> Rotation3<f64> {
    Rotation3::from_rotation_vector(random.vector(2.0))
}
fn obb3(random: &mut Random, at: Vec3<f64>) -> Obb3<f64> {
    let size = random.vector(0.6) + Vec3::new(1.2, 1.2, 1.2);
    Obb3::new(at, size, rotation(random))
}
fn hull(random: &mut Random, at: Vec3<f64>) -> Hull3<f64, 8> {
    let vertices: Vec<_> = (0..5 + random.below(4))
        .map(|_| at + random.vector(0.9))
        .collect();
    Hull3::from_vertices(&vertices)
}
fn capsule(random: &mut Random, at: Vec3<f64>) -> Capsule3<f64> {
    let half = random.vector(0.6);
    Capsule3::new(at - half, at + half, random.within(0.1, 0.4))
}
fn cylinder(random: &mut Random, at: Vec3<f64>) -> Cylinder<f64> {
    let half = random.vector(0.6);
    Cylinder::new(at - half, at + half, random.within(0.2, 0.6))
}
fn cone(random: &mut Random, at: Vec3<f64>) -> Cone<f64> {
    let half = random.vector(0.6);
    Cone::new(at - half, at + half, random.within(0.2, 0.6))
}
fn disc(random: &mut Random, at: Vec3<f64>) -> Disc<f64> {
    Disc::new(
        at,
        random.vector(1.0) + Vec3::new(0.0, 0.0, 1.5),
        random.within(0.4, 0.9),
    )
}
fn ellipsoid(random: &mut Random, at: Vec3<f64>) -> Ellipsoid<f64> {
    let half = random.vector(0.3) + Vec3::new(0.6, 0.6, 0.6);
    Ellipsoid::new(at, half, rotation(random))
}
fn sphere(random: &mut Random, at: Vec3<f64>) -> Sphere<f64> {
    Sphere::new(at, random.within(0.2, 0.7))
}
fn segment(random: &mut Random, at: Vec3<f64>) -> Segment3<f64> {
    let half = random.vector(0.8);
    Segment3::new(at - half, at + half)
}
fn triangle(random: &mut Random, at: Vec3<f64>) -> Triangle3<f64> {
    let mut one = || at + random.vector(0.9);
    Triangle3::new(one(), one(), one())
}
fn tetrahedron(random: &mut Random, at: Vec3<f64>) -> Tetrahedron<f64> {
    let mut one = || at + random.vector(0.9);
    Tetrahedron::new(one(), one(), one(), one())
}
fn round_box(random: &mut Random, at: Vec3<f64>) -> RoundBox3<f64> {
    RoundBox3::new(obb3(random, at), random.within(0.05, 0.2))
}
fn plane(random: &mut Random, at: Vec3<f64>) -> Plane3<f64> {
    let normal = random.vector(1.0) + Vec3::new(0.0, 0.0, 1.5);
    Plane3::new(normal, normal.dot(at) - 0.9 * normal.length())
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (x, y) in found.iter().zip(expected) {
        assert!((x - y).abs() <= 1e-10 * size, "{what}: {x} for {y}");
    }
}

/// A row of numbers for every number of a result, and each times its cotangent, summed.
fn pulled(rows: &[Vec<f64>], bars: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; rows[0].len()];
    for (row, bar) in rows.iter().zip(bars) {
        sums.iter_mut()
            .zip(row)
            .for_each(|(sum, x)| *sum += bar * x);
    }
    sums
}

/// Numbers in a shape, all different.
fn bars<P: Pack<Scalar = f64, With<f64> = P>>(shape: &P) -> P {
    let mut k = 0.0_f64;
    shape.remake(&mut |_| {
        k += 1.0;
        k.sin()
    })
}

/// The number of pairs of a kind.
const COUNT: usize = 40;

macro_rules! contacts_of {
    ($($name:ident: $first:ident $A:ty, $second:ident $B:ty;)*) => { $(
        #[test]
        fn $name() {
            let mut random = Random(19);
            let (mut a, mut b) = (Vec::new(), Vec::new());
            for _ in 0..COUNT {
                let at = random.vector(0.2);
                a.push($first(&mut random, at));
                let at = random.vector(0.9);
                b.push($second(&mut random, at));
            }
            let cpu = Cpu::new();
            let (found, by) = cpu.aligned(Contacts.jacobian(), (&a, &b, One(0.1))).unwrap();
            let ups: Vec<_> = found.iter().map(bars).collect();
            let (by_a, by_b, _) = cpu.aligned(Contacts.vjp(), ((&a, &b, One(0.1)), &ups)).unwrap();
            let mut met = 0;
            for i in 0..COUNT {
                let function = |(a, b): ($A, $B)| contacts(a, b, geograd::Scalar::lit(0.1));
                let (expected, slopes) = ad::jacobian(function, (a[i], b[i]));
                assert_eq!(found[i], expected);
                assert_eq!(found[i], contacts(a[i], b[i], 0.1));
                met += usize::from(expected.count > 0.0);
                let own = slopes.scalars();
                for (row, own) in by[i].scalars().iter().zip(&own) {
                    near(&row.0.scalars(), &own.0.scalars(), "a row by a");
                    near(&row.1.scalars(), &own.1.scalars(), "a row by b");
                    assert_eq!(row.2, 0.0);
                }
                let bars = ups[i].scalars();
                let rows = |first: bool| -> Vec<Vec<f64>> {
                    own.iter().map(|row| if first { row.0.scalars() } else { row.1.scalars() }).collect()
                };
                near(&by_a[i].scalars(), &pulled(&rows(true), &bars), "cotangents of a");
                near(&by_b[i].scalars(), &pulled(&rows(false), &bars), "cotangents of b");
            }
            assert!(met > COUNT / 4, "{met}");
        }
    )* };
}
contacts_of! {
    contacts_of_boxes: obb3 Obb3<_>, obb3 Obb3<_>;
    contacts_of_segments_and_boxes: segment Segment3<_>, obb3 Obb3<_>;
    contacts_of_capsules_and_boxes: capsule Capsule3<_>, obb3 Obb3<_>;
    contacts_of_triangles_and_boxes: triangle Triangle3<_>, obb3 Obb3<_>;
    contacts_of_tetrahedra_and_boxes: tetrahedron Tetrahedron<_>, obb3 Obb3<_>;
    contacts_of_balls_and_boxes: sphere Sphere<_>, obb3 Obb3<_>;
    contacts_of_round_boxes: round_box RoundBox3<_>, round_box RoundBox3<_>;
    contacts_of_planes_and_boxes: plane Plane3<_>, obb3 Obb3<_>;
    contacts_of_planes_and_capsules: plane Plane3<_>, capsule Capsule3<_>;
    contacts_of_planes_and_cylinders: plane Plane3<_>, cylinder Cylinder<_>;
    contacts_of_planes_and_hulls: plane Plane3<_>, hull Hull3<_, 8>;
    contacts_of_hulls: hull Hull3<_, 8>, hull Hull3<_, 8>;
    contacts_of_boxes_and_hulls: obb3 Obb3<_>, hull Hull3<_, 8>;
    contacts_of_capsules_and_hulls: capsule Capsule3<_>, hull Hull3<_, 8>;
    contacts_of_boxes_and_cylinders: obb3 Obb3<_>, cylinder Cylinder<_>;
    contacts_of_boxes_and_cones: obb3 Obb3<_>, cone Cone<_>;
    contacts_of_boxes_and_discs: obb3 Obb3<_>, disc Disc<_>;
    contacts_of_boxes_and_ellipsoids: obb3 Obb3<_>, ellipsoid Ellipsoid<_>;
    contacts_of_cylinders: cylinder Cylinder<_>, cylinder Cylinder<_>;
}

/// A motion of a body about its place to about another one.
fn motion(random: &mut Random, from: Vec3<f64>, to: Vec3<f64>) -> Motion3<f64> {
    Motion3::new(from, to - from + random.vector(0.5), random.vector(1.0))
}

macro_rules! motions_of {
    ($($name:ident: $first:ident $A:ty, $second:ident $B:ty;)*) => { $(
        #[test]
        fn $name() {
            if !geograd_tests::is_due(stringify!($name)) {
                return;
            }
            let mut random = Random(23);
            let (mut a, mut b, mut of_a, mut of_b) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
            for _ in 0..COUNT {
                let at = Vec3::new(-2.0, 0.0, 0.0) + random.vector(0.5);
                a.push($first(&mut random, at));
                of_a.push(motion(&mut random, at, Vec3::zero()));
                let at = Vec3::new(2.0, 0.0, 0.0) + random.vector(0.5);
                b.push($second(&mut random, at));
                of_b.push(motion(&mut random, at, Vec3::new(0.0, 1.0, 0.0)));
            }
            let cpu = Cpu::new();
            let columns = (&a, &of_a, &b, &of_b);
            let (found, by) = cpu.aligned(TimeOfImpact.jacobian(), columns).unwrap();
            let (least, slopes) = cpu.aligned(Clearance.value_grad(), columns).unwrap();
            let mut met = 0;
            for i in 0..COUNT {
                let all = (a[i], of_a[i], b[i], of_b[i]);
                let impact = |(a, m, b, n): ($A, Motion3<_>, $B, Motion3<_>)| a.time_of_impact(m, b, n);
                let (expected, rows) = ad::jacobian(impact, all);
                assert_eq!(found[i], expected);
                assert_eq!(found[i], a[i].time_of_impact(of_a[i], b[i], of_b[i]));
                met += usize::from(expected.kind == 1.0);
                for (row, own) in by[i].scalars().iter().zip(rows.scalars()) {
                    near(&row.scalars(), &own.scalars(), "an impact");
                }
                let clearance = |(a, m, b, n): ($A, Motion3<_>, $B, Motion3<_>)| a.clearance(m, b, n).distance;
                let (expected, own) = ad::gradient(clearance, all);
                assert_eq!(least[i], expected);
                let slope = (slopes.0[i], slopes.1[i], slopes.2[i], slopes.3[i]);
                near(&slope.scalars(), &own.scalars(), "a clearance");
            }
            assert!(met > COUNT / 4, "{met}");
        }
    )* };
}
motions_of! {
    motions_of_boxes: obb3 Obb3<_>, obb3 Obb3<_>;
    motions_of_balls_and_boxes: sphere Sphere<_>, obb3 Obb3<_>;
    motions_of_capsules_and_boxes: capsule Capsule3<_>, obb3 Obb3<_>;
    motions_of_round_boxes: round_box RoundBox3<_>, round_box RoundBox3<_>;
    motions_of_hulls: hull Hull3<_, 8>, hull Hull3<_, 8>;
    motions_of_balls_and_hulls: sphere Sphere<_>, hull Hull3<_, 8>;
    motions_of_boxes_and_hulls: obb3 Obb3<_>, hull Hull3<_, 8>;
    motions_of_boxes_and_cylinders: obb3 Obb3<_>, cylinder Cylinder<_>;
    motions_of_boxes_and_ellipsoids: obb3 Obb3<_>, ellipsoid Ellipsoid<_>;
}

#[test]
fn measures_of_hulls_are_those_of_their_faces() {
    let mut random = Random(29);
    let all: Vec<_> = (0..COUNT)
        .map(|k| match k % 4 {
            0 => Hull3::from_vertices(&obb3(&mut random, Vec3::zero()).corners()),
            1 => Hull3::from_vertices(&triangle(&mut random, Vec3::zero()).corners()),
            _ => hull(&mut random, Vec3::zero()),
        })
        .collect();
    let cpu = Cpu::new();
    let (volumes, by_volume) = cpu.aligned(Volume.value_grad(), &all).unwrap();
    let (surfaces, by_surface) = cpu.aligned(Surface.value_grad(), &all).unwrap();
    let (centers, by_center) = cpu.aligned(Centroid.jacobian(), &all).unwrap();
    for (i, &hull) in all.iter().enumerate() {
        let (volume, slope) = ad::gradient(|hull: Hull3<_, 8>| hull.volume(), hull);
        assert_eq!(volumes[i], volume);
        near(&by_volume[i].scalars(), &slope.scalars(), "a volume");
        let (surface, slope) = ad::gradient(|hull: Hull3<_, 8>| hull.surface(), hull);
        assert_eq!(surfaces[i], surface);
        near(&by_surface[i].scalars(), &slope.scalars(), "a surface");
        let (center, slopes) = ad::jacobian(|hull: Hull3<_, 8>| hull.center(), hull);
        assert_eq!(centers[i], center);
        for (row, own) in by_center[i].scalars().iter().zip(slopes.scalars()) {
            near(&row.scalars(), &own.scalars(), "a centre");
        }
        // A shift of all vertices changes no size and takes the centre along.
        let along_x = |by: &Hull3<f64, 8>| by.as_slice().iter().map(|vertex| vertex.x).sum::<f64>();
        assert!(along_x(&by_volume[i]).abs() < 1e-12 && along_x(&by_surface[i]).abs() < 1e-12);
        assert!((along_x(&by_center[i].x) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn distances_of_hulls_and_curved_shapes_are_those_of_duals() {
    if !geograd_tests::is_due("distances_of_hulls_and_curved_shapes_are_those_of_duals") {
        return;
    }
    let mut random = Random(31);
    macro_rules! pairs {
        ($($second:ident $B:ident;)*) => { $({
            let (mut a, mut b) = (Vec::new(), Vec::new());
            for _ in 0..COUNT {
                let at = random.vector(0.3);
                a.push(hull(&mut random, at));
                let at = random.vector(1.6);
                b.push($second(&mut random, at));
            }
            let cpu = Cpu::new();
            let (far, by) = cpu.aligned(Distance.value_grad(), (&a, &b)).unwrap();
            let (signed, slopes) = cpu.aligned(SignedDistance.value_grad(), (&a, &b)).unwrap();
            let mut apart = 0;
            for i in 0..COUNT {
                let distance = |(a, b): (Hull3<_, 8>, $B<_>)| a.distance(b);
                let (expected, own) = ad::gradient(distance, (a[i], b[i]));
                assert_eq!(far[i], expected);
                near(&(by.0[i], by.1[i]).scalars(), &own.scalars(), "a distance");
                let distance = |(a, b): (Hull3<_, 8>, $B<_>)| a.signed_distance(b);
                let (expected, own) = ad::gradient(distance, (a[i], b[i]));
                assert_eq!(signed[i], expected);
                near(&(slopes.0[i], slopes.1[i]).scalars(), &own.scalars(), "a signed distance");
                apart += usize::from(expected > 0.0);
            }
            assert!(COUNT / 8 < apart && apart < COUNT, "{apart}");
        })* };
    }
    pairs! { cylinder Cylinder; cone Cone; ellipsoid Ellipsoid; disc Disc; }
}

/// A box with a side of length zero in one of two cases, and a quaternion of any length.
fn plate(random: &mut Random, at: Vec3<f64>) -> Obb3<f64> {
    let mut solid = obb3(random, at);
    match random.below(4) {
        0 => solid.size.z = 0.0,
        1 => solid.size = Vec3::new(solid.size.x, 0.0, 0.0),
        _ => {}
    }
    let length = [1.0, 1e-3, 40.0, 0.3][random.below(4)];
    let q = solid.rotation;
    solid.rotation = Rotation3::new(q.w * length, q.x * length, q.y * length, q.z * length);
    solid
}
fn round_plate(random: &mut Random, at: Vec3<f64>) -> RoundBox3<f64> {
    RoundBox3::new(plate(random, at), random.within(0.0, 0.2))
}
fn point(_: &mut Random, at: Vec3<f64>) -> Vec3<f64> {
    at
}

#[test]
fn distances_of_solids_and_hulls_are_those_of_duals() {
    let mut random = Random(37);
    macro_rules! pairs {
        ($($first:ident $A:ident $Verb:ident $method:ident;)*) => { $({
            let (mut a, mut b) = (Vec::new(), Vec::new());
            for _ in 0..COUNT {
                let at = random.vector(1.8);
                a.push($first(&mut random, at));
                let at = random.vector(0.3);
                b.push(hull(&mut random, at));
            }
            let (far, by) = Cpu::new().aligned($Verb.value_grad(), (&a, &b)).unwrap();
            for i in 0..COUNT {
                let distance = |(a, b): ($A<_>, Hull3<_, 8>)| a.$method(b);
                let (expected, own) = ad::gradient(distance, (a[i], b[i]));
                assert_eq!(far[i], expected);
                near(&(by.0[i], by.1[i]).scalars(), &own.scalars(), stringify!($A));
            }
            assert!(by.0.iter().any(|by| by.scalars().iter().any(|x| x.abs() > 0.1)));
        })* };
    }
    pairs! {
        point Vec3 Distance distance;
        segment Segment3 Distance distance;
        sphere Sphere SignedDistance signed_distance;
        capsule Capsule3 SignedDistance signed_distance;
        triangle Triangle3 SignedDistance signed_distance;
        tetrahedron Tetrahedron SignedDistance signed_distance;
        plate Obb3 Distance distance;
        plate Obb3 SignedDistance signed_distance;
        round_plate RoundBox3 SignedDistance signed_distance;
    }
}
