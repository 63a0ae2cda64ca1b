//! The clearance of an arm of seven links among 200 boxes with its derivative by the links: searches for the nearest
//! pair next to parry3d, which skips pairs by balls around both.
use super::{Dice, on_threads};
use geograd::kernels::{Cpu, SignedDistance};
use geograd::{Capsule3, Obb3, Pack, Rotation3, Vec3};
use std::hint::black_box;
use std::time::Instant;

const LINKS: usize = 7;
const BOXES: usize = 200;
/// The number of configurations of a batch.
const ARMS: usize = 64;

/// Microseconds an arm, the fastest of many runs.
fn microseconds(mut run: impl FnMut()) -> f64 {
    let (start, mut best) = (Instant::now(), f64::INFINITY);
    while start.elapsed().as_secs_f64() < 1.0 {
        let now = Instant::now();
        run();
        best = best.min(now.elapsed().as_secs_f64());
    }
    best * 1e6 / ARMS as f64
}

fn direction(dice: &mut Dice) -> Vec3<f64> {
    let mut one = || dice.within(-1.0, 1.0);
    Vec3::new(one(), one(), one()).normalize_or_zero()
}

/// Returns arms of links of 0.3 m, which turn a little from link to link.
fn arms(dice: &mut Dice) -> Vec<Capsule3<f64>> {
    let mut links = Vec::new();
    for _ in 0..ARMS {
        let (mut at, mut way) = (Vec3::zero(), direction(dice));
        for _ in 0..LINKS {
            let end = at + way * 0.3;
            links.push(Capsule3::new(at, end, 0.05));
            way = (way + direction(dice) * 0.7).normalize_or_zero();
            at = end;
        }
    }
    links
}

/// Returns boxes of up to 0.3 m in a cube of 4 m, none of them within 0.5 m of the base.
fn boxes(dice: &mut Dice) -> Vec<Obb3<f64>> {
    let mut all = Vec::new();
    while all.len() < BOXES {
        let mut within = |low: f64, high: f64| {
            let [x, y, z] = [0, 1, 2].map(|_| dice.within(low, high));
            Vec3::new(x, y, z)
        };
        let (center, size) = (within(-2.0, 2.0), within(0.05, 0.3));
        let turn = Rotation3::from_rotation_vector(within(-2.0, 2.0));
        if center.length() > 0.5 {
            all.push(Obb3::new(center, size, turn));
        }
    }
    all
}

macro_rules! in_format {
    ($name:ident, $T:ident, $parry:ident) => {
        mod $name {
            use super::*;
            use $parry::math::{Pose, Rotation, Vector};
            use $parry::query::contact;
            use $parry::shape::{Capsule, Cuboid};

            fn vector(v: Vec3<$T>) -> Vector {
                Vector::new(v.x, v.y, v.z)
            }
            /// A shape with the centre and the radius of a ball around it.
            struct Ball<A> {
                shape: A,
                pose: Pose,
                center: Vector,
                radius: $T,
            }
            fn ball_of_link(link: &Capsule3<$T>) -> Ball<Capsule> {
                let (start, end) = (vector(link.start), vector(link.end));
                Ball {
                    shape: Capsule::new(start, end, link.radius),
                    pose: Pose::IDENTITY,
                    center: (start + end) * 0.5,
                    radius: (end - start).length() * 0.5 + link.radius,
                }
            }
            fn ball_of_box(solid: &Obb3<$T>) -> Ball<Cuboid> {
                let (q, half) = (solid.rotation, vector(solid.size * 0.5));
                let turn = Rotation::from_xyzw(q.x, q.y, q.z, q.w).normalize();
                Ball {
                    shape: Cuboid::new(half),
                    pose: Pose::from_parts(vector(solid.center), turn),
                    center: vector(solid.center),
                    radius: half.length(),
                }
            }
            /// The least signed distance of an arm and its derivative by the ends of the links.
            fn nearest(
                links: &[Ball<Capsule>],
                boxes: &[Ball<Cuboid>],
                bounds: &mut Vec<($T, usize, usize)>,
            ) -> ($T, [[Vector; 2]; LINKS]) {
                bounds.clear();
                for (i, link) in links.iter().enumerate() {
                    for (j, solid) in boxes.iter().enumerate() {
                        let apart = (link.center - solid.center).length();
                        bounds.push((apart - link.radius - solid.radius, i, j));
                    }
                }
                let least = |bounds: &[($T, usize, usize)]| {
                    bounds
                        .iter()
                        .copied()
                        .reduce(|a, b| if b.0 < a.0 { b } else { a })
                        .unwrap()
                };
                let (mut best, mut found) = ($T::INFINITY, None);
                let mut look = |bound: $T, i: usize, j: usize| {
                    if bound >= best {
                        return;
                    }
                    let (a, b) = (&links[i], &boxes[j]);
                    let reach = best.min(1e4);
                    if let Ok(Some(hit)) = contact(&a.pose, &a.shape, &b.pose, &b.shape, reach)
                        && hit.dist < best
                    {
                        (best, found) = (hit.dist, Some((i, hit)));
                    }
                };
                let (bound, i, j) = least(bounds);
                look(bound, i, j);
                bounds.iter().for_each(|&(bound, i, j)| look(bound, i, j));
                let mut by = [[Vector::ZERO; 2]; LINKS];
                if let Some((i, hit)) = found {
                    let segment = links[i].shape.segment;
                    let along = segment.b - segment.a;
                    let part = (hit.point1 - segment.a).dot(along) / along.length_squared();
                    let part = part.clamp(0.0, 1.0);
                    by[i] = [hit.normal1 * (part - 1.0), hit.normal1 * -part];
                }
                (best, by)
            }
            pub fn rates(links: &[Capsule3<f64>], boxes: &[Obb3<f64>]) {
                let links: Vec<Capsule3<$T>> = links.iter().map(Capsule3::cast).collect();
                let boxes: Vec<Obb3<$T>> = boxes.iter().map(Obb3::cast).collect();
                let cpu = Cpu::new();
                // parry3d's solids are made before, too.
                let held = cpu.upload(&boxes).unwrap();
                let line = |name: &str, time: f64| {
                    println!("| {}, {name} | {time:.1} |", stringify!($T));
                };
                line(
                    "geograd, all pairs, values alone",
                    microseconds(|| {
                        black_box(cpu.all_pairs(SignedDistance, &links, &boxes).unwrap());
                    }),
                );
                line(
                    "geograd, nearest_grad, arm by arm",
                    microseconds(|| {
                        for arm in links.chunks(LINKS) {
                            let cap = $T::INFINITY;
                            black_box(cpu.nearest_grad(SignedDistance, arm, &boxes, cap).unwrap());
                        }
                    }),
                );
                line(
                    "geograd, nearest_grad, arm by arm, boxes on the machine",
                    microseconds(|| {
                        for arm in links.chunks(LINKS) {
                            let cap = $T::INFINITY;
                            black_box(cpu.nearest_grad(SignedDistance, arm, &held, cap).unwrap());
                        }
                    }),
                );
                line(
                    "geograd, row_min_grad, all arms at once, boxes on the machine",
                    microseconds(|| {
                        let cap = $T::INFINITY;
                        black_box(
                            cpu.row_min_grad(SignedDistance, &links, &held, cap)
                                .unwrap(),
                        );
                    }),
                );
                let balls: Vec<_> = links.iter().map(ball_of_link).collect();
                let solids: Vec<_> = boxes.iter().map(ball_of_box).collect();
                let mut bounds = Vec::new();
                line(
                    "parry3d, skipping by balls, arm by arm",
                    microseconds(|| {
                        for arm in balls.chunks(LINKS) {
                            black_box(nearest(arm, &solids, &mut bounds));
                        }
                    }),
                );
                let agree = links
                    .chunks(LINKS)
                    .zip(balls.chunks(LINKS))
                    .all(|(arm, balls)| {
                        let ours = cpu.nearest(SignedDistance, arm, &boxes, $T::INFINITY);
                        let ours = ours.unwrap().expect("finite distances").value;
                        let (theirs, _) = nearest(balls, &solids, &mut bounds);
                        // parry's depths of capsules are rounded to about a thousandth.
                        (ours - theirs).abs() < 1e-2
                    });
                assert!(agree, "parry3d disagrees");
            }
        }
    };
}
in_format! { single, f32, parry3d }
in_format! { double, f64, parry3d_f64 }

/// Times both formats on one thread.
pub fn planner() {
    let mut dice = Dice(7);
    let (links, boxes) = (arms(&mut dice), boxes(&mut dice));
    println!(
        "\n| {LINKS} links among {BOXES} boxes, with derivatives, one thread | µs an arm |\n| --- | ---: |"
    );
    on_threads(1, || {
        single::rates(&links, &boxes);
        double::rates(&links, &boxes);
    });
}
