//! Distances in space next to parry3d, in both formats: rates, and how many values of hard pairs are wrong.
use super::{fastest, on_threads};
use draw::{FAMILIES, Random, boxed};
use geograd::kernels::{Cpu, Distance, SignedDistance};
use geograd::prelude::*;
use geograd::{Capsule3, Hull3, Obb3, Pack, Segment3, Triangle3, Vec3};
use std::hint::black_box;

#[path = "../../../tests/geometry/space/draw.rs"]
#[allow(dead_code)]
pub mod draw;
#[path = "../../../tests/geometry/space/oracle.rs"]
#[allow(dead_code)]
mod oracle;

/// Pairs of a list.
const PAIRS: usize = 4096;

/// Boxes of which those at the same place are apart, or overlap.
fn solids(random: &mut Random, apart: bool) -> [Vec<Obb3<f64>>; 2] {
    let mut lists = [vec![], vec![]];
    while lists[0].len() < PAIRS {
        let (a, b) = (random.solid(0), random.solid(0));
        if (a.signed_distance(b) > 0.0) == apart {
            lists[0].push(a);
            lists[1].push(b);
        }
    }
    lists
}

/// Capsules of which some overlap.
fn capsules() -> [Vec<Capsule3<f64>>; 2] {
    let mut random = Random(0xcafe_cafe_cafe_cafe);
    [(); 2].map(|()| {
        let one = |_| {
            let (start, end) = (random.vector(1.5), random.vector(1.5));
            Capsule3::new(start, end, random.within(0.05, 0.5))
        };
        (0..PAIRS).map(one).collect()
    })
}

/// Pairs for `coal.cpp`: a line of numbers each, the kind first (0 boxes apart, 1 boxes that overlap, 2 capsules, 3 and
/// more hard boxes by family), then the numbers of both solids, then the signed distance by the oracle or, of capsules,
/// by geograd.
pub fn pairs(hard: usize) -> String {
    let mut text = String::new();
    let mut line = |kind: usize, numbers: Vec<f64>, distance: f64| {
        text += &kind.to_string();
        for x in numbers.into_iter().chain([distance]) {
            text += &format!(" {x:e}");
        }
        text.push('\n');
    };
    let mut boxes = |kind, a: Obb3<f64>, b: Obb3<f64>| {
        let truth = oracle::boxes(&boxed(&a), &boxed(&b));
        line(kind, [a.scalars(), b.scalars()].concat(), truth);
    };
    let mut random = Random(0x5eed_5eed_5eed_5eed);
    for (kind, apart) in [true, false].into_iter().enumerate() {
        let [a, b] = solids(&mut random, apart);
        a.into_iter().zip(b).for_each(|(a, b)| boxes(kind, a, b));
    }
    let mut random = Random(0xdead_beef_dead_beef);
    for family in 0..FAMILIES.len() {
        for _ in 0..hard {
            let (a, b) = (random.solid(family), random.solid(family));
            boxes(3 + family, a, b);
        }
    }
    let [a, b] = capsules();
    for (a, b) in a.into_iter().zip(b) {
        line(2, [a.scalars(), b.scalars()].concat(), a.signed_distance(b));
    }
    text
}

/// The lists of a format next to one of parry's two packages.
macro_rules! in_format {
    ($name:ident, $T:ident, $parry:ident, $error:expr) => {
        mod $name {
            use super::*;
            use $parry::math::{Pose, Rotation, Vector};
            use $parry::query;
            use $parry::shape::{Capsule, ConvexPolyhedron, Cuboid, Segment, Triangle};

            fn vector(v: Vec3<$T>) -> Vector {
                Vector::new(v.x, v.y, v.z)
            }
            fn cuboid(shape: &Obb3<$T>) -> (Pose, Cuboid) {
                let q = shape.rotation;
                let turn = Rotation::from_xyzw(q.x, q.y, q.z, q.w).normalize();
                let half = vector(shape.size * 0.5);
                (
                    Pose::from_parts(vector(shape.center), turn),
                    Cuboid::new(half),
                )
            }
            fn signed(a: &(Pose, Cuboid), b: &(Pose, Cuboid)) -> $T {
                let found = query::contact(&a.0, &a.1, &b.0, &b.1, 1e4);
                found.ok().flatten().map_or($T::NAN, |contact| contact.dist)
            }
            fn line(name: &str, seconds: f64) -> f64 {
                let nanoseconds = seconds * 1e9 / PAIRS as f64;
                println!("| {}, {name} | {nanoseconds:.1} |", stringify!($T));
                nanoseconds
            }
            /// Values, and values with all slopes.
            macro_rules! ours {
                ($told:expr, $verb:ident, $a:expr, $b:expr) => {{
                    let (cpu, a, b) = (Cpu::new(), $a, $b);
                    let mut values = vec![0.0; PAIRS];
                    line(
                        concat!("geograd, ", $told),
                        fastest(|| cpu.aligned_into($verb, (a, b), &mut values[..]).unwrap()),
                    );
                    let (mut v, (mut p, mut q)) = cpu.aligned($verb.value_grad(), (a, b)).unwrap();
                    line(
                        concat!("geograd, ", $told, ", with slopes"),
                        fastest(|| {
                            let into = (&mut v[..], (&mut p[..], &mut q[..]));
                            cpu.aligned_into($verb.value_grad(), (a, b), into).unwrap();
                        }),
                    );
                }};
            }
            macro_rules! theirs {
                ($told:expr, $a:expr, $b:expr, |$x:ident, $y:ident| $run:expr) => {{
                    let pairs: Vec<_> = $a.iter().zip($b).collect();
                    line(
                        concat!("parry3d, ", $told),
                        fastest(|| {
                            for &($x, $y) in &pairs {
                                let _ = black_box($run);
                            }
                        }),
                    );
                }};
            }
            fn polyhedron<const N: usize>(hull: &Hull3<$T, N>) -> ConvexPolyhedron {
                let corners: Vec<Vector> = hull.vertices.map(vector).to_vec();
                ConvexPolyhedron::from_convex_hull(&corners)
                    .expect("corners of a ball span a volume")
            }
            /// Hulls of corners on balls of radius one, of which those at the same place are apart, or overlap.
            fn pairs_of_hulls<const N: usize>(
                random: &mut Random,
                apart: bool,
            ) -> [Vec<Hull3<$T, N>>; 2] {
                let mut lists = [vec![], vec![]];
                while lists[0].len() < PAIRS {
                    let [a, b] = [Vec3::zero(), random.vector(1.5)].map(|center| {
                        let corner = |_| (center + random.vector(1.0).normalize_or_zero()).cast();
                        Hull3::from(std::array::from_fn(corner))
                    });
                    if (a.signed_distance(b) > 0.0) == apart {
                        lists[0].push(a);
                        lists[1].push(b);
                    }
                }
                lists
            }
            macro_rules! hulls {
                ($corners:literal) => {{
                    let mut random = Random(0x0bad_cafe_0bad_cafe);
                    for apart in [true, false] {
                        let lists = pairs_of_hulls::<$corners>(&mut random, apart);
                        let [a, b] =
                            [0, 1].map(|k| lists[k].iter().map(polyhedron).collect::<Vec<_>>());
                        let still = Pose::IDENTITY;
                        if apart {
                            ours!(
                                concat!("hulls of ", $corners, " corners apart, signed"),
                                SignedDistance,
                                &lists[0],
                                &lists[1]
                            );
                            theirs!(
                                concat!("hulls of ", $corners, " corners apart, distance"),
                                a,
                                &b,
                                |x, y| query::distance(&still, x, &still, y)
                            );
                        } else {
                            ours!(
                                concat!("hulls of ", $corners, " corners overlapping, signed"),
                                SignedDistance,
                                &lists[0],
                                &lists[1]
                            );
                            theirs!(
                                concat!("hulls of ", $corners, " corners overlapping, contact"),
                                a,
                                &b,
                                |x, y| query::contact(&still, x, &still, y, 1e4)
                            );
                        }
                    }
                }};
            }
            pub fn rates() {
                let mut random = Random(0x5eed_5eed_5eed_5eed);
                let mut points = |n: usize| -> Vec<Vec3<$T>> {
                    (0..n * PAIRS).map(|_| random.vector(1.0).cast()).collect()
                };
                let still = Pose::IDENTITY;
                let edges = [points(2), points(2)].map(|points| {
                    let edges = points.chunks(2).map(|p| Segment3::new(p[0], p[1]));
                    edges.collect::<Vec<_>>()
                });
                ours!("segments", Distance, &edges[0], &edges[1]);
                let [a, b] = edges.map(|edges| {
                    let edges = edges
                        .iter()
                        .map(|x| Segment::new(vector(x.start), vector(x.end)));
                    edges.collect::<Vec<_>>()
                });
                theirs!("segments, distance", a, &b, |x, y| query::distance(
                    &still, x, &still, y
                ));
                let rods: [Vec<Capsule3<$T>>; 2] =
                    capsules().map(|rods| rods.iter().map(Capsule3::cast).collect());
                ours!("capsules, signed", SignedDistance, &rods[0], &rods[1]);
                let [a, b] = rods.map(|rods| {
                    let rods = rods
                        .iter()
                        .map(|x| Capsule::new(vector(x.start), vector(x.end), x.radius));
                    rods.collect::<Vec<_>>()
                });
                theirs!("capsules, contact", a, &b, |x, y| query::contact(
                    &still, x, &still, y, 1e4
                ));
                let faces = [points(3), points(3)].map(|points| {
                    let faces = points.chunks(3).map(|p| Triangle3::new(p[0], p[1], p[2]));
                    faces.collect::<Vec<_>>()
                });
                ours!("triangles", Distance, &faces[0], &faces[1]);
                let [a, b] = faces.map(|faces| {
                    let faces = faces.iter().map(|x| {
                        let [a, b, c] = x.corners().map(vector);
                        Triangle::new(a, b, c)
                    });
                    faces.collect::<Vec<_>>()
                });
                theirs!("triangles, distance", a, &b, |x, y| query::distance(
                    &still, x, &still, y
                ));
                hulls!(8);
                hulls!(12);
                hulls!(32);
                for apart in [true, false] {
                    let lists: [Vec<Obb3<$T>>; 2] = solids(&mut random, apart)
                        .map(|list| list.iter().map(Obb3::cast).collect());
                    let [a, b] = [0, 1].map(|k| lists[k].iter().map(cuboid).collect::<Vec<_>>());
                    if apart {
                        ours!("boxes apart, signed", SignedDistance, &lists[0], &lists[1]);
                        theirs!("boxes apart, contact", a, &b, |x, y| signed(x, y));
                        theirs!("boxes apart, distance", a, &b, |x, y| {
                            query::distance(&x.0, &x.1, &y.0, &y.1)
                        });
                    } else {
                        ours!(
                            "boxes overlapping, signed",
                            SignedDistance,
                            &lists[0],
                            &lists[1]
                        );
                        theirs!("boxes overlapping, contact", a, &b, |x, y| signed(x, y));
                    }
                    line(
                        "geograd, boxes, call by call",
                        fastest(|| {
                            for (&a, &b) in lists[0].iter().zip(&lists[1]) {
                                black_box(a.signed_distance(b));
                            }
                        }),
                    );
                }
            }
            /// Counts values of hard boxes as hulls of their corners that are wrong by more than the format explains;
            /// parry's are its contacts. A hull that parry refuses counts as wrong.
            pub fn wrong_hulls(count: usize) {
                let mut random = Random(0xdead_beef_dead_beef);
                for (family, name) in FAMILIES.iter().enumerate() {
                    let size = if family == 6 { 4e6 } else { 4.0 };
                    let (mut wrong, mut most) = ([0; 2], [0.0_f64; 2]);
                    for _ in 0..count / FAMILIES.len() {
                        let (a, b) = (random.solid(family), random.solid(family));
                        let truth = oracle::boxes(&boxed(&a), &boxed(&b));
                        let [a, b] = [a, b].map(|solid| {
                            Hull3::<$T, 8>::from(solid.corners().map(|corner| corner.cast()))
                        });
                        let corners = |hull: &Hull3<$T, 8>| hull.vertices.map(vector).to_vec();
                        let [p, q] =
                            [&a, &b].map(|hull| ConvexPolyhedron::from_convex_hull(&corners(hull)));
                        let theirs = p.zip(q).and_then(|(p, q)| {
                            let still = Pose::IDENTITY;
                            query::contact(&still, &p, &still, &q, 1e8).ok().flatten()
                        });
                        let theirs = theirs.map_or($T::NAN, |contact| contact.dist);
                        for (k, found) in [a.signed_distance(b), theirs].into_iter().enumerate() {
                            let error = (f64::from(found) - truth).abs() / size;
                            most[k] = if error <= most[k] { most[k] } else { error };
                            wrong[k] += usize::from(error.is_nan() || error > $error);
                        }
                    }
                    println!(
                        "| {}, {name} | {} | {:.1e} | {} | {:.1e} |",
                        stringify!($T),
                        wrong[0],
                        most[0],
                        wrong[1],
                        most[1]
                    );
                }
            }
            /// Counts values of hard pairs that are wrong by more than the format explains.
            pub fn wrong(count: usize) {
                let mut random = Random(0xdead_beef_dead_beef);
                for (family, name) in FAMILIES.iter().enumerate() {
                    let size = if family == 6 { 4e6 } else { 4.0 };
                    let (mut wrong, mut most) = ([0; 2], [0.0_f64; 2]);
                    for _ in 0..count / FAMILIES.len() {
                        let (a, b) = (random.solid(family), random.solid(family));
                        let (a, b): (Obb3<$T>, Obb3<$T>) = (a.cast(), b.cast());
                        let truth = oracle::boxes(&boxed(&a.cast()), &boxed(&b.cast()));
                        let theirs = signed(&cuboid(&a), &cuboid(&b));
                        for (k, found) in [a.signed_distance(b), theirs].into_iter().enumerate() {
                            let error = (f64::from(found) - truth).abs() / size;
                            most[k] = if error <= most[k] { most[k] } else { error };
                            wrong[k] += usize::from(error.is_nan() || error > $error);
                        }
                    }
                    println!(
                        "| {}, {name} | {} | {:.1e} | {} | {:.1e} |",
                        stringify!($T),
                        wrong[0],
                        most[0],
                        wrong[1],
                        most[1]
                    );
                }
            }
        }
    };
}
in_format! { single, f32, parry3d, 1e-6 }
in_format! { double, f64, parry3d_f64, 1e-12 }

/// Rates on one thread, then wrong values of so many hard pairs of boxes, as hulls of their corners and as boxes.
pub fn space(count: usize) {
    println!("\n| {PAIRS} aligned pairs, one thread | ns a pair |\n| --- | ---: |");
    on_threads(1, || {
        single::rates();
        double::rates();
    });
    println!(
        "\n| boxes as hulls, {count} hard pairs | geograd wrong | largest error over the size | parry wrong | largest |\n\
         | --- | ---: | ---: | ---: | ---: |"
    );
    single::wrong_hulls(count);
    double::wrong_hulls(count);
    println!(
        "\n| boxes, {count} hard pairs | geograd wrong | largest error over the size | parry wrong | largest |\n\
         | --- | ---: | ---: | ---: | ---: |"
    );
    single::wrong(count);
    double::wrong(count);
}
