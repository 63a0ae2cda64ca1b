//! One type for every convex shape, so that one test runs over all pairs.
use geograd::distance::{self, Contact, FarthestPoints, PointPair};
use geograd::{
    Aabb2, Capsule2, Circle, Line2, Obb2, Pose2, Ray2, Scalar, Segment2, Triangle2, Vec2,
};

#[derive(Clone, Copy, Debug)]
pub enum Any<S> {
    Point(Vec2<S>),
    Line(Line2<S>),
    Ray(Ray2<S>),
    Segment(Segment2<S>),
    Triangle(Triangle2<S>),
    Aabb(Aabb2<S>),
    Obb(Obb2<S>),
    Circle(Circle<S>),
    Capsule(Capsule2<S>),
    Quad([Vec2<S>; 4]),
}

/// How many kinds of shape there are.
pub const KINDS: usize = 10;
/// The most numbers that a shape has.
pub const MOST: usize = 8;

/// How many numbers a kind of shape has.
pub fn count(kind: usize) -> usize {
    [2, 4, 4, 4, 6, 4, 5, 3, 5, 8][kind]
}

pub fn build<S: Scalar>(kind: usize, x: &[S]) -> Any<S> {
    let p = |k: usize| Vec2::new(x[k], x[k + 1]);
    match kind {
        0 => Any::Point(p(0)),
        1 => Any::Line(Line2::new(p(0), p(2))),
        2 => Any::Ray(Ray2::new(p(0), p(2))),
        3 => Any::Segment(Segment2::new(p(0), p(2))),
        4 => Any::Triangle(Triangle2::new(p(0), p(2), p(4))),
        5 => Any::Aabb(Aabb2 {
            min: p(0),
            max: p(2),
        }),
        6 => Any::Obb(Obb2::new(x[0], x[1], x[2], x[3], x[4])),
        7 => Any::Circle(Circle::new(p(0), x[2])),
        8 => Any::Capsule(Capsule2::new(p(0), p(2), x[4])),
        _ => Any::Quad([p(0), p(2), p(4), p(6)]),
    }
}

macro_rules! with {
    ($any:expr, $x:ident => $do:expr) => {
        match $any {
            Any::Point($x) => $do,
            Any::Line($x) => $do,
            Any::Ray($x) => $do,
            Any::Segment($x) => $do,
            Any::Triangle($x) => $do,
            Any::Aabb($x) => $do,
            Any::Obb($x) => $do,
            Any::Circle($x) => $do,
            Any::Capsule($x) => $do,
            Any::Quad($x) => $do,
        }
    };
}

impl<S: Scalar> Any<S> {
    pub fn signed(self, other: Self) -> S {
        with!(self, a => with!(other, b => distance::signed_distance(a, b)))
    }
    pub fn distance(self, other: Self) -> S {
        with!(self, a => with!(other, b => distance::distance(a, b)))
    }
    pub fn squared(self, other: Self) -> S {
        with!(self, a => with!(other, b => distance::squared_distance(a, b)))
    }
    pub fn closest(self, other: Self) -> PointPair<S> {
        with!(self, a => with!(other, b => distance::closest_points(a, b)))
    }
    pub fn penetration(self, other: Self) -> Contact<S> {
        with!(self, a => with!(other, b => distance::penetration(a, b)))
    }
    pub fn farthest(self, other: Self) -> S {
        with!(self, a => with!(other, b => distance::farthest_distance(a, b)))
    }
    pub fn farthest_points(self, other: Self) -> FarthestPoints<S> {
        with!(self, a => with!(other, b => distance::farthest_points(a, b)))
    }
    pub fn moved(self, pose: Pose2<S>) -> Self {
        match self {
            Any::Point(x) => Any::Point(pose * x),
            Any::Line(x) => Any::Line(pose * x),
            Any::Ray(x) => Any::Ray(pose * x),
            Any::Segment(x) => Any::Segment(pose * x),
            Any::Triangle(x) => Any::Triangle(pose * x),
            Any::Aabb(x) => Any::Obb(pose * Obb2::from(x)),
            Any::Obb(x) => Any::Obb(pose * x),
            Any::Circle(x) => Any::Circle(pose * x),
            Any::Capsule(x) => Any::Capsule(pose * x),
            Any::Quad(x) => Any::Quad(x.map(|p| pose * p)),
        }
    }
}

/// Numbers that look random, the same in every run.
pub struct Dice(pub u64);

impl Dice {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn in_range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    pub fn whole(&mut self, below: u64) -> u64 {
        self.next() % below
    }
    /// The numbers of a valid shape: any, or small whole ones, which meet in every degenerate way.
    pub fn shape(&mut self, kind: usize, whole: bool, spread: f64) -> Vec<f64> {
        let mut number = |low: f64, high: f64| {
            if whole {
                (low + self.whole((high - low) as u64 + 1) as f64).clamp(low, high)
            } else {
                self.in_range(low, high)
            }
        };
        let mut x: Vec<f64> = (0..count(kind)).map(|_| number(-spread, spread)).collect();
        match kind {
            1 | 2 => {
                while x[2] == 0.0 && x[3] == 0.0 {
                    x[2] = number(-2.0, 2.0);
                    x[3] = number(-2.0, 2.0);
                }
            }
            5 => {
                x[2] = x[0] + number(0.0, 3.0);
                x[3] = x[1] + number(0.0, 3.0);
            }
            6 => {
                x[2] = number(0.0, 3.0);
                x[3] = number(0.0, 3.0);
                let turn = if whole {
                    0.25 * std::f64::consts::PI
                } else {
                    1.0
                };
                x[4] = turn * number(-3.0, 3.0);
            }
            7 => x[2] = number(0.0, 2.0),
            8 => x[4] = number(0.0, 2.0),
            9 => {
                // Around a box's border, counter-clockwise: one corner a side.
                let (cx, cy) = (x[0], x[1]);
                let mut part = || number(0.0, 2.0) - 1.0;
                let (a, b, c, d) = (part(), part(), part(), part());
                x = vec![
                    cx + a,
                    cy - 1.0,
                    cx + 1.0,
                    cy + b,
                    cx + c,
                    cy + 1.0,
                    cx - 1.0,
                    cy + d,
                ];
            }
            _ => {}
        }
        x
    }
}
