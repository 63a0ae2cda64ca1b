//! Signed distances of convex polytopes by hulls of difference points, in numbers of twice 53 bits.
//!
//! No code is shared with the library, and no feature is named: of two hulls of corners all differences of corners are
//! taken. Every point, pair and triple of them gives the foot of the origin, where it is inside; every triple and its
//! plane a gap. Two boxes differ by a sum of six segments, whose feet and planes are enumerated by them.
use std::ops::{Add, Mul, Neg, Sub};

/// A number of twice 53 bits: the sum of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide(f64, f64);

fn two_sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let part = sum - a;
    Wide(sum, (a - (sum - part)) + (b - part))
}

impl Wide {
    pub const ZERO: Wide = Wide(0.0, 0.0);
    pub const ONE: Wide = Wide(1.0, 0.0);
    pub fn of(x: f64) -> Self {
        Wide(x, 0.0)
    }
    pub fn near(self) -> f64 {
        self.0 + self.1
    }
    fn over(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * Wide::of(first);
        let second = rest.0 / other.0;
        let rest = rest - other * Wide::of(second);
        two_sum(first, second) + Wide::of(rest.0 / other.0)
    }
    fn root(self) -> Self {
        if self.0 <= 0.0 {
            return Wide::ZERO;
        }
        let first = Wide::of(self.0.sqrt());
        let second = first + (self - first * first).over(first + first);
        second + (self - second * second).over(second + second)
    }
    fn below(self, other: Self) -> bool {
        (self - other).0 < 0.0
    }
    fn abs(self) -> Self {
        if self.0 < 0.0 { -self } else { self }
    }
}

impl Add for Wide {
    type Output = Wide;
    fn add(self, other: Wide) -> Wide {
        let (high, low) = (two_sum(self.0, other.0), two_sum(self.1, other.1));
        let next = two_sum(high.0, high.1 + low.0);
        two_sum(next.0, next.1 + low.1)
    }
}
impl Neg for Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        Wide(-self.0, -self.1)
    }
}
impl Sub for Wide {
    type Output = Wide;
    fn sub(self, other: Wide) -> Wide {
        self + -other
    }
}
impl Mul for Wide {
    type Output = Wide;
    fn mul(self, other: Wide) -> Wide {
        let high = self.0 * other.0;
        let low = self.0.mul_add(other.0, -high);
        two_sum(high, low + (self.0 * other.1 + self.1 * other.0))
    }
}

/// A vector of them.
pub type Vector = [Wide; 3];

pub fn vector(v: [f64; 3]) -> Vector {
    v.map(Wide::of)
}
pub fn plus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}
pub fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}
pub fn times(a: Vector, factor: Wide) -> Vector {
    a.map(|x| x * factor)
}
fn dot(a: Vector, b: Vector) -> Wide {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A box: its centre, and the ways from there to its faces.
#[derive(Clone, Copy, Debug)]
pub struct Boxed {
    pub center: Vector,
    pub arms: [Vector; 3],
}

/// The rotation of a quaternion of any length, applied to the axes.
pub fn axes([w, x, y, z]: [f64; 4]) -> [Vector; 3] {
    let [w, x, y, z] = [w, x, y, z].map(Wide::of);
    let square = (w * w + x * x) + (y * y + z * z);
    let twice = |a: Wide| (a + a).over(square);
    let whole = |a: Wide, b: Wide| Wide::ONE - twice(a * a + b * b);
    [
        [whole(y, z), twice(x * y + w * z), twice(x * z - w * y)],
        [twice(x * y - w * z), whole(x, z), twice(y * z + w * x)],
        [twice(x * z + w * y), twice(y * z - w * x), whole(x, y)],
    ]
}

impl Boxed {
    pub fn corners(&self) -> Vec<Vector> {
        let sign = |on: bool, v: Vector| if on { v } else { v.map(|x| -x) };
        (0..8)
            .map(|k| {
                let arm = |bit: usize| sign(k >> bit & 1 == 1, self.arms[bit]);
                plus(self.center, plus(arm(0), plus(arm(1), arm(2))))
            })
            .collect()
    }
}

/// The signed distance of two boxes; where they are apart or touch it is positive or zero.
pub fn boxes(a: &Boxed, b: &Boxed) -> f64 {
    let center = minus(b.center, a.center);
    let arms: Vec<Vector> = a.arms.iter().chain(&b.arms).copied().collect();
    let mut deepest: Option<Wide> = None;
    let mut part = |normal: Vector| {
        let square = dot(normal, normal);
        if square.0 <= 0.0 {
            return;
        }
        let reach = arms
            .iter()
            .fold(Wide::ZERO, |sum, &arm| sum + dot(normal, arm).abs());
        let gap = (dot(normal, center).abs() - reach).over(square.root());
        if deepest.is_none_or(|most| most.below(gap)) {
            deepest = Some(gap);
        }
    };
    for i in 0..6 {
        for j in 0..i {
            part(cross(arms[i], arms[j]));
        }
    }
    // Of each arm: the part -1, 0 (free) or 1.
    let mut nearest: Option<Wide> = None;
    for code in 0..3_usize.pow(6) {
        let digit = |k: usize| code / 3_usize.pow(k as u32) % 3;
        let free: Vec<usize> = (0..6).filter(|&k| digit(k) == 1).collect();
        if free.len() > 2 {
            continue;
        }
        let mut at = center;
        for (k, &arm) in arms.iter().enumerate() {
            match digit(k) {
                0 => at = minus(at, arm),
                2 => at = plus(at, arm),
                _ => {}
            }
        }
        let ways: Vec<Vector> = free.iter().map(|&k| arms[k]).collect();
        let Some(parts) = feet(at, &ways) else {
            continue;
        };
        if parts.iter().any(|&part| Wide::ONE.below(part.abs())) {
            continue;
        }
        let foot = parts
            .iter()
            .zip(&ways)
            .fold(at, |at, (&part, &way)| plus(at, times(way, part)));
        let square = dot(foot, foot);
        if nearest.is_none_or(|least| square.below(least)) {
            nearest = Some(square);
        }
    }
    signed(nearest, deepest)
}

/// The parts of up to two ways with which a point comes nearest to the origin.
fn feet(at: Vector, ways: &[Vector]) -> Option<Vec<Wide>> {
    match *ways {
        [] => Some(vec![]),
        [u] => {
            let square = dot(u, u);
            (square.0 > 0.0).then(|| vec![-dot(at, u).over(square)])
        }
        [u, v] => {
            let normal = cross(u, v);
            let square = dot(normal, normal);
            (square.0 > 0.0).then(|| {
                let part = |w: Vector| dot(w, normal).over(square);
                vec![-part(cross(at, v)), -part(cross(u, at))]
            })
        }
        _ => None,
    }
}

/// Apart where some plane parts them, else minus the depth.
fn signed(nearest: Option<Wide>, deepest: Option<Wide>) -> f64 {
    let distance = nearest.map_or(0.0, |square| square.root().near());
    match deepest {
        Some(gap) if gap.0 < 0.0 && distance <= -2.0 * gap.near() + 1e-25 => gap.near(),
        _ => distance,
    }
}

/// The signed distance of the hulls of some corners; `solid` says that their difference has a volume.
pub fn hulls(a: &[Vector], b: &[Vector], solid: bool) -> f64 {
    let points: Vec<Vector> = a
        .iter()
        .flat_map(|&p| b.iter().map(move |&q| minus(q, p)))
        .collect();
    let n = points.len();
    let mut nearest: Option<Wide> = None;
    let mut deepest: Option<Wide> = None;
    let mut near = |at: Vector, ways: &[Vector]| {
        let Some(parts) = feet(at, ways) else {
            return;
        };
        let sum = parts.iter().fold(Wide::ZERO, |sum, &part| sum + part);
        if parts.iter().any(|part| part.0 < 0.0) || Wide::ONE.below(sum) {
            return;
        }
        let foot = parts
            .iter()
            .zip(ways)
            .fold(at, |at, (&part, &way)| plus(at, times(way, part)));
        let square = dot(foot, foot);
        if nearest.is_none_or(|least| square.below(least)) {
            nearest = Some(square);
        }
    };
    for i in 0..n {
        near(points[i], &[]);
        for j in 0..i {
            let u = minus(points[j], points[i]);
            near(points[i], &[u]);
            for k in 0..j {
                let v = minus(points[k], points[i]);
                near(points[i], &[u, v]);
                let normal = cross(u, v);
                let square = dot(normal, normal);
                if !solid || square.0 <= 0.0 {
                    continue;
                }
                let heights = || points.iter().map(|&p| dot(normal, p));
                let least = |x: Wide, y: Wide| if y.below(x) { y } else { x };
                let low = heights().reduce(least).unwrap();
                let high = -heights().map(|x| -x).reduce(least).unwrap();
                let length = square.root();
                for gap in [low.over(length), (-high).over(length)] {
                    if deepest.is_none_or(|most| most.below(gap)) {
                        deepest = Some(gap);
                    }
                }
            }
        }
    }
    signed(nearest, deepest)
}
