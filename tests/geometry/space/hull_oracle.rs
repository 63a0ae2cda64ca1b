//! Signed distances of hulls of corners by all triples and pairs of corners, whose hulls are never computed.
//!
//! No code is shared with the library, and no feature is named. Points of triangles and segments between any corners
//! bound the distance from above; planes along any triangle, and along any two segments, bound it from below by the
//! extents of all corners. Products are of numbers of twice 53 bits, so that normals are right for thin triangles.
use std::ops::{Add, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug)]
struct Wide(f64, f64);

fn sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let part = sum - a;
    Wide(sum, (a - (sum - part)) + (b - part))
}
impl Add for Wide {
    type Output = Wide;
    fn add(self, other: Wide) -> Wide {
        let (high, low) = (sum(self.0, other.0), sum(self.1, other.1));
        let next = sum(high.0, high.1 + low.0);
        sum(next.0, next.1 + low.1)
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
        sum(high, low + (self.0 * other.1 + self.1 * other.0))
    }
}

/// A point as plain numbers.
pub type Point = [f64; 3];
type WidePoint = [Wide; 3];

fn way(a: Point, b: Point) -> WidePoint {
    [0, 1, 2].map(|i| sum(b[i], -a[i]))
}
fn cross(a: WidePoint, b: WidePoint) -> WidePoint {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}
fn wide_dot(a: WidePoint, b: WidePoint) -> Wide {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}
fn unit(normal: WidePoint) -> Option<Point> {
    let most = normal.iter().fold(0.0_f64, |most, x| most.max(x.0.abs()));
    let scaled = normal.map(|x| (x.0 + x.1) / most);
    (most > 1e-300).then(|| scaled.map(|x| x / length(scaled)))
}
fn from_segment(p: Point, a: Point, b: Point) -> f64 {
    let (along, arm, back) = (minus(b, a), minus(p, a), minus(p, b));
    let square = dot(along, along);
    if square == 0.0 {
        return length(arm);
    }
    let (t, s) = (dot(arm, along) / square, -dot(back, along) / square);
    let from =
        |arm: Point, t: f64| length([0, 1, 2].map(|i| arm[i] - t.clamp(-1.0, 1.0) * along[i]));
    if t < s {
        from(arm, t.max(0.0))
    } else {
        from(back, -s.max(0.0))
    }
}

/// The bounds so far.
struct Bounds<'a> {
    bodies: [&'a [Point]; 2],
    near: f64,
    deep: Option<f64>,
}

impl Bounds<'_> {
    fn part(&mut self, normal: Point) {
        let [a, b] = self.bodies;
        let heights = |points: &[Point]| {
            let all = points.iter().map(|&p| dot(normal, minus(p, a[0])));
            let low = all.clone().fold(f64::INFINITY, f64::min);
            (low, all.fold(f64::NEG_INFINITY, f64::max))
        };
        let (of_a, of_b) = (heights(a), heights(b));
        for gap in [of_b.0 - of_a.1, of_a.0 - of_b.1] {
            if self.deep.is_none_or(|deep| gap > deep) {
                self.deep = Some(gap);
            }
        }
    }
    /// A triangle of one body, and the corners of the other.
    fn triangle(&mut self, [p, q, r]: [Point; 3], others: &[Point]) {
        let (u, v) = (way(p, q), way(p, r));
        let normal = cross(u, v);
        let Some(up) = unit(normal) else { return };
        self.part(up);
        let square = wide_dot(normal, normal);
        for &other in others {
            let arm = way(p, other);
            let (s, t) = (
                wide_dot(cross(arm, v), normal),
                wide_dot(cross(u, arm), normal),
            );
            let rest = square - s - t;
            if square.0 > 0.0 && [s, t, rest].iter().all(|x| x.0 >= 0.0) {
                self.near = self
                    .near
                    .min(wide_dot(normal, arm).0.abs() / square.0.sqrt());
            }
        }
    }
    fn segments(&mut self, [a, b]: [Point; 2], [c, d]: [Point; 2]) {
        let (u, v, arm) = (way(a, b), way(c, d), way(a, c));
        let normal = cross(u, v);
        let Some(up) = unit(normal) else { return };
        self.part(up);
        let square = wide_dot(normal, normal);
        let (s, t) = (
            wide_dot(cross(arm, v), normal),
            wide_dot(cross(arm, u), normal),
        );
        if square.0 > 0.0 && [s, t, square - s, square - t].iter().all(|x| x.0 >= 0.0) {
            self.near = self
                .near
                .min(wide_dot(normal, arm).0.abs() / square.0.sqrt());
        }
    }
}

/// The size of two hulls: the largest distance of a corner from the first one.
pub fn size(a: &[Point], b: &[Point]) -> f64 {
    let all = a.iter().chain(b);
    all.fold(0.0_f64, |most, &p| most.max(length(minus(p, a[0]))))
}

/// The signed distance of the hulls of some corners.
pub fn signed(a: &[Point], b: &[Point]) -> f64 {
    let mut bounds = Bounds {
        bodies: [a, b],
        near: f64::INFINITY,
        deep: None,
    };
    for (own, others) in [(a, b), (b, a)] {
        for (i, &p) in own.iter().enumerate() {
            for &other in others {
                bounds.near = bounds.near.min(length(minus(p, other)));
            }
            for (j, &q) in own[..i].iter().enumerate() {
                for &other in others {
                    bounds.near = bounds.near.min(from_segment(other, p, q));
                }
                for &r in &own[..j] {
                    bounds.triangle([p, q, r], others);
                }
            }
        }
    }
    for (i, &p) in a.iter().enumerate() {
        for &q in &a[..i] {
            for (j, &r) in b.iter().enumerate() {
                for &s in &b[..j] {
                    bounds.segments([p, q], [r, s]);
                }
            }
        }
    }
    let slack = 1e-13 * size(a, b);
    match bounds.deep {
        Some(deep) if deep < -slack || deep < 0.0 && bounds.near <= slack - 2.0 * deep => deep,
        _ => bounds.near,
    }
}
