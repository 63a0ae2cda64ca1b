//! Exact decisions about points: the turn of three points, and which of two directions is to the left.
//!
//! A search that makes one decision twice, in two forms, must decide equally, or its result is no polygon. These
//! decisions are those of exact arithmetic on the given numbers, for every input whose products neither over- nor
//! underflow in `f64` (coordinates are scaled by a power of two first, so only sizes that differ by more than 10¹⁵⁰
//! within one decision are at risk). Derivatives take no part: decisions are about values.
use crate::{Scalar, Vec2, twofold};
use std::any::Any;
use std::cmp::Ordering;

/// The turn of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Turn {
    /// Counter-clockwise.
    Left,
    /// Not at all: on a line (or a point repeated).
    Straight,
    /// Clockwise.
    Right,
}

impl Turn {
    /// Returns the turn of the mirror image.
    #[must_use]
    #[inline]
    pub fn mirrored(self) -> Self {
        match self {
            Turn::Left => Turn::Right,
            Turn::Straight => Turn::Straight,
            Turn::Right => Turn::Left,
        }
    }
}

/// Returns the value as an `f64`, exactly, for the formats that fit into one.
#[inline(always)]
fn widened<S: Scalar<Mask = bool>>(x: S) -> Option<f64> {
    let x = x.primal();
    let x: &dyn Any = &x;
    match x.downcast_ref::<f64>() {
        Some(&x) => Some(x),
        None => x.downcast_ref::<f32>().map(|&x| f64::from(x)),
    }
}

/// Returns the coordinates of a point as `f64`, exactly.
#[inline(always)]
pub(crate) fn wide<S: Scalar<Mask = bool>>(p: Vec2<S>) -> Option<[f64; 2]> {
    Some([widened(p.x)?, widened(p.y)?])
}

/// Returns a point as `f64`, exactly; the origin for a scalar without plain numbers.
#[inline(always)]
pub(crate) fn wide_place<S: Scalar<Mask = bool>>(p: Vec2<S>) -> Vec2<f64> {
    let [x, y] = wide(p).unwrap_or([0.0; 2]);
    Vec2::new(x, y)
}

/// Returns the turn of the path `a → b → c`: the sign of `(b − a) × (c − a)`, exactly.
///
/// ```
/// use geograd::Vec2;
/// use geograd::predicate::{Turn, turn};
/// let (a, b) = (Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.1));
/// assert_eq!(turn(a, b, Vec2::new(2.0, 0.2)), Turn::Straight);
/// assert_eq!(turn(a, b, Vec2::new(2.0, 0.2_f64.next_up())), Turn::Left);
/// ```
#[must_use]
#[inline]
pub fn turn<S: Scalar<Mask = bool>>(a: Vec2<S>, b: Vec2<S>, c: Vec2<S>) -> Turn {
    turn_between([a, b], [a, c])
}

/// Returns the side of the direction `from[0] → from[1]` to which the direction `to[0] → to[1]` points: the sign of the
/// cross product of the two differences, exactly.
#[must_use]
#[inline]
pub fn turn_between<S: Scalar<Mask = bool>>(from: [Vec2<S>; 2], to: [Vec2<S>; 2]) -> Turn {
    let all = (wide(from[0]), wide(from[1]), wide(to[0]), wide(to[1]));
    let sign = match all {
        (Some(a), Some(b), Some(c), Some(d)) => cross_sign(a, b, c, d),
        // Another format decides as well as its own arithmetic can.
        _ => {
            let cross = (from[1] - from[0]).perp_dot(to[1] - to[0]);
            if cross.above(S::zero()) {
                1.0
            } else if cross.below(S::zero()) {
                -1.0
            } else {
                0.0
            }
        }
    };
    if sign > 0.0 {
        Turn::Left
    } else if sign < 0.0 {
        Turn::Right
    } else {
        Turn::Straight
    }
}

/// Returns the order of two numbers; equal where one is NaN.
#[inline]
pub(crate) fn order<S: Scalar<Mask = bool>>(a: S, b: S) -> Ordering {
    match (a.below(b), b.below(a)) {
        (true, _) => Ordering::Less,
        (_, true) => Ordering::Greater,
        _ => Ordering::Equal,
    }
}

/// Returns the order of two points by x, then by y.
#[inline]
pub(crate) fn left_to_right<S: Scalar<Mask = bool>>(a: Vec2<S>, b: Vec2<S>) -> Ordering {
    order(a.x, b.x).then(order(a.y, b.y))
}

/// Returns `true` if two points have equal coordinates.
#[inline]
pub(crate) fn same<S: Scalar<Mask = bool>>(a: Vec2<S>, b: Vec2<S>) -> bool {
    a.x.equals(b.x) && a.y.equals(b.y)
}

/// Returns a number with the sign of `(b − a) × (d − c)`.
///
/// The plain value decides when it is farther from zero than its rounding can be (Shewchuk, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, 1997); else the sum of all sixteen exact parts
/// decides.
#[inline]
fn cross_sign(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    // Three roundings of a product and one of the difference, in units of 2⁻⁵³, and some more.
    const ROUNDING: f64 = 3.0 * f64::EPSILON;
    const SMALL: f64 = 1e-140;
    const LARGE: f64 = 1e150;
    let (ux, uy, vx, vy) = (b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]);
    let (left, right) = (ux * vy, uy * vx);
    let (det, bound) = (left - right, left.abs() + right.abs());
    if det.abs() > ROUNDING * bound && bound > SMALL && bound < LARGE {
        return det;
    }
    exact_cross(a, b, c, d)
}

#[cold]
#[inline(never)]
fn exact_cross(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    // Each difference is scaled near one by a power of two, which does not change the sign.
    let u = differences(a, b);
    let v = differences(c, d);
    let mut sum = Expansion::default();
    for (ux, uy) in u[0].into_iter().zip(u[1]) {
        for (vx, vy) in v[0].into_iter().zip(v[1]) {
            sum.add_product(ux, vy);
            sum.add_product(-uy, vx);
        }
    }
    sum.sign()
}

/// Returns the two coordinates of `b − a`, each as an exact sum of two numbers, times a power of two.
fn differences(a: [f64; 2], b: [f64; 2]) -> [[f64; 2]; 2] {
    let largest = a
        .iter()
        .chain(&b)
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    let scale = if largest > 0.0 && largest < f64::INFINITY {
        // Half of it: the difference may be twice as large as the largest coordinate.
        Scalar::binade(largest)
    } else {
        1.0
    };
    [0, 1].map(|k| {
        let (p, q) = (a[k] * scale, b[k] * scale);
        let rounded = q - p;
        [rounded, twofold::lost(q, p, rounded)]
    })
}

/// An exact sum of floats: parts that do not overlap, from small to large.
#[derive(Default)]
struct Expansion {
    parts: [f64; 17],
    count: usize,
}

impl Expansion {
    /// Adds the exact product of two numbers.
    fn add_product(&mut self, x: f64, y: f64) {
        let product = x * y;
        self.add(x.mul_add(y, -product));
        self.add(product);
    }
    /// Adds a number (Shewchuk's grow-expansion).
    fn add(&mut self, x: f64) {
        let (mut carry, mut kept) = (x, 0);
        for k in 0..self.count {
            let [lost, sum] = twofold::sum(carry, self.parts[k]);
            if lost != 0.0 {
                self.parts[kept] = lost;
                kept += 1;
            }
            carry = sum;
        }
        if carry != 0.0 {
            self.parts[kept] = carry;
            kept += 1;
        }
        self.count = kept;
    }
    /// Returns a number with the sign of the sum: its largest part.
    fn sign(&self) -> f64 {
        self.count.checked_sub(1).map_or(0.0, |k| self.parts[k])
    }
}
