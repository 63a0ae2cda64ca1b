//! Pairs of which one is curved, at random and hard, with supports of their own.
use super::draw::Random;
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid};

/// The families of inputs.
pub const FAMILIES: [&str; 12] = [
    "apart",
    "overlapping",
    "on a grid of one frame",
    "nearly parallel",
    "thin",
    "needles and plates, down to points",
    "concentric, one frame",
    "one frame",
    "far from each other",
    "without some extents",
    "equal numbers",
    "far from the origin",
];

/// The place of a shape, its turn, and lengths.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub at: Vec3<f64>,
    pub turn: Rotation3<f64>,
    pub lengths: [f64; 3],
}

fn turn(random: &mut Random) -> Rotation3<f64> {
    let v = random.vector(1.0);
    let made = Rotation3::from_axis_angle(v, random.within(-3.0, 3.0));
    if v.length() > 0.1 {
        made
    } else {
        Rotation3::identity()
    }
}

/// Two frames of a family.
pub fn frames(random: &mut Random, family: usize) -> [Frame; 2] {
    let lengths = |random: &mut Random| {
        let mut one = || match family {
            4 => random.power(-4.0, 0.0),
            5 => random.power(-9.0, 0.0),
            9 if random.below(3) == 0 => 0.0,
            2 => 0.5 * (1 + random.below(3)) as f64,
            _ => random.within(0.2, 1.2),
        };
        [one(), one(), one()]
    };
    let first = turn(random);
    let second = match family {
        2 | 6 | 7 | 10 => first,
        3 => {
            let angle = random.power(-15.0, -3.0);
            first * Rotation3::from_axis_angle(random.vector(1.0), angle)
        }
        _ => turn(random),
    };
    let mut shift = random.vector(1.0);
    match family {
        0 => shift = shift * (random.within(2.5, 5.0) / shift.length().max(0.1)),
        2 => {
            let mut step = || random.below(9) as f64 * 0.5 - 2.0;
            shift = first * Vec3::new(step(), step(), step());
        }
        6 | 10 => shift = Vec3::zero(),
        8 => shift = shift * 1e6,
        _ => {}
    }
    let at = match family {
        11 => random.vector(1e3),
        _ => random.vector(1.0),
    };
    let mut both = [lengths(random), lengths(random)];
    if family == 10 {
        both[1] = both[0];
    }
    [
        Frame {
            at,
            turn: first,
            lengths: both[0],
        },
        Frame {
            at: at + shift,
            turn: second,
            lengths: both[1],
        },
    ]
}

/// A shape of space with a support and a test of its own.
pub trait Body: Copy + std::fmt::Debug {
    fn drawn(frame: Frame) -> Self;
    /// The farthest point in a direction.
    fn high(&self, way: Vec3<f64>) -> Vec3<f64>;
    /// An upper bound of how far a point is outside.
    fn outside(&self, point: Vec3<f64>) -> f64;
    fn size(&self) -> f64;
    fn middle(&self) -> Vec3<f64>;
}

fn unit(v: Vec3<f64>) -> Vec3<f64> {
    let length = v.length();
    if length > 0.0 {
        v * (1.0 / length)
    } else {
        Vec3::zero()
    }
}

/// Along an axis, and across it.
fn split(arm: Vec3<f64>, axis: Vec3<f64>) -> (f64, Vec3<f64>) {
    let along = unit(axis);
    (along.dot(arm), arm - along * along.dot(arm))
}

/// The direction across an axis, of length one; zero for one that is along it within rounding.
fn side(way: Vec3<f64>, axis: Vec3<f64>) -> Vec3<f64> {
    // Once more: what is left of a direction along the axis is mostly rounding along it.
    let across = split(split(way, axis).1, axis).1;
    match across.length() > 1e-13 * way.length() {
        true => unit(across),
        false => Vec3::zero(),
    }
}

impl Body for Ellipsoid<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, z],
        }: Frame,
    ) -> Self {
        Ellipsoid::new(at, Vec3::new(x, y, z), turn)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let local = self.rotation.inverse() * way;
        let Vec3 { x, y, z } = self.semi_axes;
        let seen = unit(Vec3::new(local.x * x, local.y * y, local.z * z));
        self.center + self.rotation * Vec3::new(seen.x * x, seen.y * y, seen.z * z)
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let local = self.rotation.inverse() * (point - self.center);
        let (at, size) = ([local.x, local.y, local.z], self.semi_axes);
        let size = [size.x, size.y, size.z];
        // The point drawn to the ellipsoid along each axis, thin ones first.
        let clamped = [0, 1, 2].map(|k| at[k].clamp(-size[k], size[k]));
        let shares = [0, 1, 2].map(|k| {
            if size[k] > 0.0 {
                clamped[k] / size[k]
            } else {
                0.0
            }
        });
        let length = shares.iter().map(|x| x * x).sum::<f64>().sqrt().max(1.0);
        let shift = |k: usize| at[k] - clamped[k] / length;
        let all = Vec3::new(shift(0), shift(1), shift(2)).length();
        // The thinnest coordinate alone makes up for a sum above one, if the others leave room.
        let thin = (0..3).min_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap();
        let rest: f64 = (0..3)
            .filter(|&k| k != thin)
            .map(|k| shares[k] * shares[k])
            .sum();
        if rest > 1.0 {
            return all;
        }
        let high = (1.0 - rest).sqrt() * size[thin];
        let own = at[thin] - clamped[thin].clamp(-high, high);
        let sides = (0..3)
            .filter(|&k| k != thin)
            .map(|k| (at[k] - clamped[k]).powi(2));
        all.min((own * own + sides.sum::<f64>()).sqrt())
    }
    fn size(&self) -> f64 {
        self.semi_axes.length()
    }
    fn middle(&self) -> Vec3<f64> {
        self.center
    }
}

impl Body for Cylinder<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, _],
        }: Frame,
    ) -> Self {
        let half = turn * Vec3::new(0.0, 0.0, if x > 0.0 { x } else { 0.7 });
        Cylinder::new(at - half, at + half, y)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let axis = self.end - self.start;
        let end = if axis.dot(way) > 0.0 {
            self.end
        } else {
            self.start
        };
        end + side(way, axis) * self.radius
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let axis = self.end - self.start;
        let (along, across) = split(point - self.start, axis);
        let beyond = (along - axis.length()).max(-along).max(0.0);
        beyond.hypot((across.length() - self.radius).max(0.0))
    }
    fn size(&self) -> f64 {
        (self.end - self.start).length() + self.radius
    }
    fn middle(&self) -> Vec3<f64> {
        (self.start + self.end) * 0.5
    }
}

impl Body for Cone<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, _],
        }: Frame,
    ) -> Self {
        let half = turn * Vec3::new(0.0, 0.0, if x > 0.0 { x } else { 0.7 });
        Cone::new(at + half, at - half, y)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let axis = self.base - self.apex;
        let rim = axis + side(way, axis) * self.radius;
        if rim.dot(way) > 0.0 {
            self.apex + rim
        } else {
            self.apex
        }
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let axis = self.base - self.apex;
        let (along, across) = split(point - self.apex, axis);
        let height = axis.length();
        let at = along.clamp(0.0, height);
        (along - at).hypot((across.length() - self.radius * at / height).max(0.0))
    }
    fn size(&self) -> f64 {
        (self.base - self.apex).length() + self.radius
    }
    fn middle(&self) -> Vec3<f64> {
        (self.apex + self.base) * 0.5
    }
}

impl Body for Disc<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, _],
        }: Frame,
    ) -> Self {
        Disc::new(at, turn * Vec3::new(0.0, 0.0, 0.5 + x), y)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        self.center + side(way, self.normal) * self.radius
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let (along, across) = split(point - self.center, self.normal);
        along.hypot((across.length() - self.radius).max(0.0))
    }
    fn size(&self) -> f64 {
        self.radius
    }
    fn middle(&self) -> Vec3<f64> {
        self.center
    }
}

impl Body for Obb3<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, z],
        }: Frame,
    ) -> Self {
        Obb3::new(at, Vec3::new(x, y, z) * 2.0, turn)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let high = |p: &Vec3<f64>, q: &Vec3<f64>| {
            way.dot(*p - self.center)
                .total_cmp(&way.dot(*q - self.center))
        };
        self.corners().into_iter().max_by(high).unwrap()
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let local = self.rotation.inverse() * (point - self.center);
        let one = |x: f64, size: f64| (x.abs() - 0.5 * size).max(0.0);
        Vec3::new(
            one(local.x, self.size.x),
            one(local.y, self.size.y),
            one(local.z, self.size.z),
        )
        .length()
    }
    fn size(&self) -> f64 {
        self.size.length()
    }
    fn middle(&self) -> Vec3<f64> {
        self.center
    }
}

impl Body for Vec3<f64> {
    fn drawn(frame: Frame) -> Self {
        frame.at
    }
    fn high(&self, _: Vec3<f64>) -> Vec3<f64> {
        *self
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        (point - *self).length()
    }
    fn size(&self) -> f64 {
        0.0
    }
    fn middle(&self) -> Vec3<f64> {
        *self
    }
}

impl Body for Capsule3<f64> {
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, _],
        }: Frame,
    ) -> Self {
        let half = turn * Vec3::new(0.0, 0.0, x);
        Capsule3::new(at - half, at + half, 0.5 * y)
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let end = if (self.end - self.start).dot(way) > 0.0 {
            self.end
        } else {
            self.start
        };
        end + unit(way) * self.radius
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        (Segment3::new(self.start, self.end).distance(point) - self.radius).max(0.0)
    }
    fn size(&self) -> f64 {
        (self.end - self.start).length() + self.radius
    }
    fn middle(&self) -> Vec3<f64> {
        (self.start + self.end) * 0.5
    }
}

/// The hulls of corners.
macro_rules! cornered {
    ($($Shape:ident: |$at:ident, $x:ident, $y:ident, $z:ident| $made:expr, |$shape:ident| $corners:expr;)*) => { $(
        impl Body for $Shape<f64> {
            fn drawn(Frame { at: $at, turn, lengths }: Frame) -> Self {
                let axis = |k: usize| {
                    let one = |j: usize| if j == k { lengths[k] } else { 0.0 };
                    turn * Vec3::new(one(0), one(1), one(2))
                };
                let [$x, $y, $z] = [0, 1, 2].map(axis);
                let _ = ($y, $z);
                $made
            }
            fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
                let $shape = self;
                let all = $corners;
                let high = |p: &Vec3<f64>, q: &Vec3<f64>| way.dot(*p - all[0]).total_cmp(&way.dot(*q - all[0]));
                all.into_iter().max_by(high).unwrap()
            }
            fn outside(&self, point: Vec3<f64>) -> f64 {
                // Straight shapes have tests of their own.
                self.distance(point)
            }
            fn size(&self) -> f64 {
                let $shape = self;
                let all = $corners;
                all.into_iter().map(|corner| (corner - all[0]).length()).fold(0.0, f64::max)
            }
            fn middle(&self) -> Vec3<f64> {
                let $shape = self;
                let all = $corners;
                all[0]
            }
        }
    )* };
}
cornered! {
    Segment3: |at, x, y, z| Segment3::new(at - x, at + x), |s| [s.start, s.end];
    Triangle3: |at, x, y, z| Triangle3::new(at - x, at + x, at + y), |s| s.corners();
    Tetrahedron: |at, x, y, z| Tetrahedron::new(at - x, at + x, at + y, at + z), |s| s.corners();
}

/// A hull in a test of curved shapes.
pub type Hull<S> = Hull3<S, 8>;

impl Body for Hull<f64> {
    /// A roof over a rectangle, with a vertex inside and one on an edge.
    fn drawn(
        Frame {
            at,
            turn,
            lengths: [x, y, z],
        }: Frame,
    ) -> Self {
        let corner = |u: f64, v: f64, w: f64| at + turn * Vec3::new(u * x, v * y, w * z);
        Hull3::from([
            corner(-1.0, -1.0, -1.0),
            corner(0.1, 0.2, -0.3),
            corner(1.0, -1.0, -1.0),
            corner(1.0, 1.0, -1.0),
            corner(-1.0, 1.0, -1.0),
            corner(0.0, 1.0, -1.0),
            corner(-0.75, 0.0, 1.0),
            corner(0.5, 0.0, 1.0),
        ])
    }
    fn high(&self, way: Vec3<f64>) -> Vec3<f64> {
        let height = |p: &Vec3<f64>| way.dot(*p - self.vertices[0]);
        let higher = |p: &Vec3<f64>, q: &Vec3<f64>| height(p).total_cmp(&height(q));
        self.vertices.into_iter().max_by(higher).unwrap()
    }
    fn outside(&self, point: Vec3<f64>) -> f64 {
        // Hulls have tests of their own.
        self.distance(point)
    }
    fn size(&self) -> f64 {
        let lengths = self
            .vertices
            .iter()
            .map(|&p| (p - self.vertices[0]).length());
        lengths.fold(0.0, f64::max)
    }
    fn middle(&self) -> Vec3<f64> {
        self.vertices[0]
    }
}
