//! Distances in space next to parry3d, in both formats: rates, and how many values of hard pairs are wrong.
use super::{fastest, on_threads};
use draw::{FAMILIES, Random, boxed};
use geograd::kernels::{Cpu, Distance, SignedDistance};
use geograd::prelude::*;
use geograd::{Obb3, Pack, Segment3, Triangle3, Vec3};
use std::hint::black_box;

#[path = "../../../tests/geometry/space/draw.rs"]
#[allow(dead_code)]
mod draw;
#[path = "../../../tests/geometry/space/oracle.rs"]
#[allow(dead_code)]
mod oracle;

/// Pairs of a list.
const PAIRS: usize = 4096;

/// The lists of a format next to one of parry's two packages.
macro_rules! in_format {
    ($name:ident, $T:ident, $parry:ident, $error:expr) => {
        mod $name {
            use super::*;
            use $parry::math::{Pose, Rotation, Vector};
            use $parry::query;
            use $parry::shape::{Cuboid, Segment, Triangle};

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
                for apart in [true, false] {
                    let mut lists: [Vec<Obb3<$T>>; 2] = [vec![], vec![]];
                    while lists[0].len() < PAIRS {
                        let (a, b) = (random.solid(0), random.solid(0));
                        if (a.signed_distance(b) > 0.0) == apart {
                            lists[0].push(a.cast());
                            lists[1].push(b.cast());
                        }
                    }
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

/// Rates on one thread, then wrong values of so many hard pairs of boxes.
pub fn space(count: usize) {
    println!("\n| {PAIRS} aligned pairs, one thread | ns a pair |\n| --- | ---: |");
    on_threads(1, || {
        single::rates();
        double::rates();
    });
    println!(
        "\n| boxes, {count} hard pairs | geograd wrong | largest error over the size | parry wrong | largest |\n\
         | --- | ---: | ---: | ---: | ---: |"
    );
    single::wrong(count);
    double::wrong(count);
}
