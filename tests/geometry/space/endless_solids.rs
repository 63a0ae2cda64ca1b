//! Distances of lines and rays from hulls and curved shapes, proved by points and planes. Nothing here is the library's
//! but what is tested.
use super::curved_draw::{Body, FAMILIES, Hull, frames};
use super::draw::Random;
use geograd::ad::{gradient, hessian};
use geograd::distance3::{
    Apart, closest_points, distance, farthest_distance, penetration, signed_distance,
};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid, Pack};

/// A line or a ray.
trait Endless: Copy + std::fmt::Debug {
    fn made(point: Vec3<f64>, direction: Vec3<f64>) -> Self;
    /// The least of `normal · point` relative to a point.
    fn lowest(&self, normal: Vec3<f64>, from: Vec3<f64>) -> f64;
    /// How far a point is away.
    fn off(&self, point: Vec3<f64>) -> f64;
}

fn part(arm: Vec3<f64>, along: Vec3<f64>, least: f64) -> f64 {
    let t = (along.dot(arm) / along.length_squared()).max(least);
    (arm - along * t).length()
}

impl Endless for Line3<f64> {
    fn made(point: Vec3<f64>, direction: Vec3<f64>) -> Self {
        Line3::new(point, direction)
    }
    fn lowest(&self, normal: Vec3<f64>, from: Vec3<f64>) -> f64 {
        match normal.dot(self.direction).abs() <= 1e-12 * self.direction.length() {
            true => normal.dot(self.point - from),
            false => f64::NEG_INFINITY,
        }
    }
    fn off(&self, point: Vec3<f64>) -> f64 {
        part(point - self.point, self.direction, f64::NEG_INFINITY)
    }
}

impl Endless for Ray3<f64> {
    fn made(point: Vec3<f64>, direction: Vec3<f64>) -> Self {
        Ray3::new(point, direction)
    }
    fn lowest(&self, normal: Vec3<f64>, from: Vec3<f64>) -> f64 {
        match normal.dot(self.direction) >= -1e-12 * self.direction.length() {
            true => normal.dot(self.point - from),
            false => f64::NEG_INFINITY,
        }
    }
    fn off(&self, point: Vec3<f64>) -> f64 {
        part(point - self.point, self.direction, 0.0)
    }
}

/// The largest gap along random directions across a line, or ahead of a ray, and near the best of them.
fn best_of_many<L: Endless, B: Body>(
    random: &mut Random,
    line: &L,
    ray: [Vec3<f64>; 2],
    b: &B,
) -> f64 {
    let (from, along) = (ray[0], ray[1] * (1.0 / ray[1].length()));
    let gap = |way: Vec3<f64>| line.lowest(way, from) - way.dot(b.high(way) - from);
    let flat = |way: Vec3<f64>| {
        let rise = along.dot(way);
        let ahead = line.lowest(along, from).is_finite() && rise > 0.0;
        let across = if ahead { way } else { way - along * rise };
        across * (1.0 / across.length().max(1e-9))
    };
    let mut best = (f64::NEG_INFINITY, along);
    for _ in 0..60 {
        let way = flat(random.vector(1.0));
        best = if gap(way) > best.0 {
            (gap(way), way)
        } else {
            best
        };
    }
    let mut step = 0.3;
    while step > 1e-7 {
        let way = flat(best.1 + random.vector(step));
        if gap(way) > best.0 {
            best = (gap(way), way);
        } else {
            step *= 0.9;
        }
    }
    best.0
}

fn prove<L, B>(told: &str)
where
    L: Endless + Apart<B, Scalar = f64>,
    B: Body + Apart<L, Scalar = f64>,
{
    let mut random = Random(0x5eed_0000_1234_9e37);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..40 {
            let [first, second] = frames(&mut random, family);
            let b = B::drawn(second);
            // Along an axis of the first frame, or in any direction; given near or far.
            let axis = [0, 1, 2].map(|k| f64::from(u8::from(k == random.below(3))));
            let axis = Vec3::new(axis[0], axis[1], axis[2]);
            let way = match random.below(3) {
                0 => random.vector(1.0),
                _ => first.turn * axis,
            };
            let way = if way.length() > 1e-3 {
                way
            } else {
                first.turn * Vec3::new(1.0, 0.0, 0.0)
            };
            let far = if random.below(3) == 0 {
                random.within(-50.0, 50.0)
            } else {
                0.0
            };
            let way = way * random.power(-2.0, 2.0);
            let at = first.at + way * (far / way.length());
            let line = L::made(at, way);
            let told = || format!("{told}, {name}: {line:?} {b:?}");
            let size = b.size().max((at - b.middle()).length());
            let share = if family == 5 { 1e-7 } else { 1e-11 };
            let bound = share * size + 1e-15 * first.at.length();
            let apart = signed_distance(line, b);
            let (points, out) = (closest_points(line, b), penetration(line, b));
            assert!((out.direction.length() - 1.0).abs() < 1e-12, "{}", told());
            assert!(line.off(points.on_a) <= bound, "{points:?} {}", told());
            assert!(b.outside(points.on_b) <= bound, "{points:?} {}", told());
            let rest = points.on_b - points.on_a - out.direction * apart;
            assert!(rest.length() <= bound, "{points:?} {apart} {}", told());
            // From b to the line, across it within rounding.
            let normal = -out.direction;
            let rise = normal.dot(way) / way.length();
            // A short gap has a direction of few digits; a ray has an end in directions ahead.
            let ahead = rise > 0.0 && line.lowest(way, at).is_finite();
            let flat = match rise.abs() < 1e-7 && !ahead {
                true => normal - way * (normal.dot(way) / way.length_squared()),
                false => normal,
            };
            let least = line.lowest(flat, points.on_b) - flat.dot(b.high(flat) - points.on_b);
            assert!((least - apart).abs() <= bound, "{least} {apart} {}", told());
            assert_eq!(distance(line, b), apart.max(0.0));
            let flipped = signed_distance(b, line);
            assert!(
                (flipped - apart).abs() <= bound,
                "{flipped} {apart} {}",
                told()
            );
            assert_eq!(farthest_distance(line, b), f64::MAX);
            if apart < 0.0 {
                let best = best_of_many(&mut random, &line, [at, way], &b);
                assert!(best <= apart + bound, "deep {best} {apart} {}", told());
            }
        }
    }
}

#[test]
fn points_and_planes_prove_distances_of_lines_and_rays() {
    macro_rules! all {
        ($($B:ident)*) => { $(
            prove::<Line3<f64>, $B<f64>>(stringify!(line $B));
            prove::<Ray3<f64>, $B<f64>>(stringify!(ray $B));
        )* };
    }
    all!(Hull Ellipsoid Cylinder Cone Disc);
}

#[test]
fn lines_are_as_far_as_long_segments_wherever_they_are_given() {
    let mut random = Random(0x0ff5_e700_1111_2222);
    for family in [0, 1, 2, 3, 7, 11] {
        for _ in 0..30 {
            let [first, second] = frames(&mut random, family);
            let way = first.turn * Vec3::new(0.0, 0.0, 1.0);
            let shift = random.within(-5.0, 5.0);
            let line = Line3::new(first.at + way * shift, way * random.power(-3.0, 3.0));
            let wire = Segment3::new(first.at - way * 30.0, first.at + way * 30.0);
            macro_rules! same {
                ($($B:ident)*) => { $(
                    let b = $B::drawn(second);
                    let (known, found) = (signed_distance(wire, b), signed_distance(line, b));
                    let bound = 2e-12 * (1.0 + first.at.length());
                    assert!((known - found).abs() <= bound, "{known} {found} {line:?} {b:?}");
                )* };
            }
            same!(Hull Ellipsoid Cylinder Cone Disc);
        }
    }
}

#[test]
fn lines_and_rays_have_derivatives() {
    if !geograd_tests::is_due("lines_and_rays_have_derivatives") {
        return;
    }
    let mut random = Random(0x3333_4444_5555_6667);
    let mut judged = [0; 2];
    for family in [0, 1] {
        for _ in 0..25 {
            let [first, second] = frames(&mut random, family);
            let (at, way) = (first.at, random.vector(1.0));
            macro_rules! judge {
                ($L:ident: $($B:ident)*) => { $(
                    let x = ($L::new(at, way), $B::drawn(second));
                    let f = |x: ($L<f64>, $B<f64>)| signed_distance(x.0, x.1);
                    let (here, by, twice) = hessian(|(a, b): ($L<_>, $B<_>)| signed_distance(a, b), x);
                    let by = by.scalars();
                    let along: Vec<f64> = by.iter().map(|_| random.within(-1.0, 1.0)).collect();
                    let moved = |step: f64| {
                        let all = x.scalars();
                        let all: Vec<f64> = all.iter().zip(&along).map(|(x, d)| x + d * step).collect();
                        x.refill(&all)
                    };
                    let side = |step: f64| (f(moved(step)) - here) / step;
                    let sides = [1e-5, -1e-5, 2.5e-6, -2.5e-6].map(side);
                    let jump = (4.0 * (sides[2] - sides[3]) - (sides[0] - sides[1])) / 3.0;
                    let found: f64 = by.iter().zip(&along).map(|(x, d)| x * d).sum();
                    if jump.abs() < 1e-7 && (sides[0] - sides[1]).abs() < 1e-3 {
                        judged[0] += 1;
                        let central = (sides[0] + sides[1]) / 2.0;
                        assert!((found - central).abs() < 1e-6 * (1.0 + central.abs()), "{found} {central} {x:?}");
                        let slope = |step: f64| {
                            gradient(|(a, b): ($L<_>, $B<_>)| signed_distance(a, b), moved(step)).1.scalars()
                        };
                        let differences = |step: f64| -> Vec<f64> {
                            slope(step).iter().zip(slope(-step)).map(|(p, q)| (p - q) / (2.0 * step)).collect()
                        };
                        let (near, far) = (differences(1e-5), differences(4e-5));
                        let most = near.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                        let smooth = near.iter().zip(&far).all(|(p, q)| (p - q).abs() < 1e-4 * most);
                        if smooth && most < 100.0 {
                            judged[1] += 1;
                            for (row, near) in twice.scalars().iter().zip(near) {
                                let found: f64 = row.scalars().iter().zip(&along).map(|(x, d)| x * d).sum();
                                assert!((found - near).abs() < 2e-4 * most, "{found} {near} {x:?}");
                            }
                        }
                    }
                )* };
            }
            judge!(Line3: Hull Ellipsoid Cylinder Cone Disc);
            judge!(Ray3: Hull Ellipsoid Cylinder Cone Disc);
        }
    }
    assert!(judged[0] > 350 && judged[1] > 250, "{judged:?}");
}
