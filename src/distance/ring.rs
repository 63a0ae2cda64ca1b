//! Distances of a point from polylines, rings and polygons of any kind, edge by edge.
//!
//! [`EdgeFold`] is the state of a fold over edges in any order: start with
//! [`EdgeFold::empty`], [`with_edge`](EdgeFold::with_edge) for every edge, [`join`](EdgeFold::join)
//! partial results, and [`signed_distance`](EdgeFold::signed_distance) at the end. A polygon with
//! holes is the fold over the edges of all of its rings, the holes clockwise (or, with
//! [`Fill::EvenOdd`], either way round).
use super::edge::{edge_sides, edge_winding};
use super::search::nearest;
use crate::{Scalar, Vec2};

/// Which points of the plane a ring's winding number puts inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Points with a winding number other than zero: loops add up.
    #[default]
    NonZero,
    /// Points with an odd winding number: every crossing changes sides.
    EvenOdd,
}

/// The state of a point after some edges.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
pub struct EdgeFold<S> {
    /// The distance of the nearest edge so far, with the derivative of the edges that tie.
    pub distance: S,
    /// The sum of the distances of the edges that tie.
    sum: S,
    /// How many they are.
    count: S,
    /// The distance to the left of an edge that the point is exactly on: zero but for derivatives. It counts here
    /// if the winding number on that side is the point's own.
    left: S,
    /// The same if the winding number on the right side is the point's own.
    right: S,
    /// The winding number so far.
    pub winding: S,
}

impl<S> EdgeFold<S> {
    /// Which of its numbers the winding number is.
    pub(crate) const WINDING: usize = 5;
}

impl<S: Scalar> EdgeFold<S> {
    /// No edges: the largest finite distance, winding number 0.
    #[inline(always)]
    pub fn empty() -> Self {
        EdgeFold {
            distance: S::lit(S::LARGEST),
            sum: S::zero(),
            count: S::zero(),
            left: S::zero(),
            right: S::zero(),
            winding: S::zero(),
        }
    }
    /// One edge, seen from a point.
    #[inline(always)]
    pub fn of_edge(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> Self {
        let (distance, side) = edge_sides(point, from, to);
        // A point at the height of a level edge, or of an end, counts as just above it.
        let upwards = from.y.below(to.y) | (from.y.equals(to.y) & to.x.below(from.x));
        EdgeFold {
            distance,
            sum: distance,
            count: S::one(),
            left: S::select(upwards, S::zero(), side),
            right: S::select(upwards, side, S::zero()),
            winding: edge_winding(point, from, to),
        }
    }
    /// From the distance of the nearest edge and the winding number of all.
    #[inline(always)]
    pub(super) fn nearest(distance: S, winding: S) -> Self {
        EdgeFold {
            distance,
            sum: distance,
            count: S::one(),
            left: S::zero(),
            right: S::zero(),
            winding,
        }
    }
    /// With another edge that ties, though rounding may tell.
    #[inline(always)]
    pub(super) fn and_also(mut self, distance: S) -> Self {
        self.sum += distance;
        self.count += S::one();
        self
    }
    /// Both sets of edges together: the nearer one, the sum of the winding numbers.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        let nearer = self.distance.below(other.distance);
        let tie = self.distance.equals(other.distance);
        let pick = |a: S, b: S| S::select(nearer, a, b);
        let both = |a: S, b: S| S::select(tie, a + b, pick(a, b));
        EdgeFold {
            distance: pick(self.distance, other.distance),
            sum: both(self.sum, other.sum),
            count: both(self.count, other.count),
            left: both(self.left, other.left),
            right: both(self.right, other.right),
            winding: self.winding + other.winding,
        }
    }
    /// With one more edge.
    #[must_use]
    #[inline(always)]
    pub fn with_edge(self, point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> Self {
        self.join(Self::of_edge(point, from, to))
    }
    /// The distance of the nearest edge; the largest finite number without edges. Edges that tie share
    /// the derivative equally.
    #[must_use]
    #[inline(always)]
    pub fn distance(self) -> S {
        // With the bits of the distance itself: a third of three thirds need not be one.
        let none = self.count.equals(S::zero());
        let mean = self.sum.over(S::select(none, S::one(), self.count));
        mean.with_primal(self.distance.primal()).canonical()
    }
    /// `true` where the point is inside: by the rule, a winding number that is not zero, or that is odd.
    #[must_use]
    #[inline(always)]
    pub fn inside(self, fill: Fill) -> S::Mask {
        fills(self.winding, fill)
    }
    /// The distance of the border, negative inside. Exactly on an edge, across which it is smooth, the derivative
    /// is that of the outward normal; where several edges meet it is zero.
    #[must_use]
    #[inline(always)]
    pub fn signed_distance(self, fill: Fill) -> S {
        let distance = self.distance();
        let inside = self.inside(fill);
        let off = S::select(inside, -distance, distance);
        // Crossing an edge from its right to its left adds one to the winding number.
        let beyond = |by: S| fills(self.winding + by, fill);
        let outward = |to_left: S, left: S::Mask, right: S::Mask| {
            let of_left = S::select(left & !right, -to_left, S::zero());
            S::select(right & !left, to_left, of_left)
        };
        let normal = outward(self.left, inside, beyond(-S::one()))
            + outward(self.right, beyond(S::one()), inside);
        // Between two edges the winding number on either side of one depends on the other.
        let alone = self.count.equals(S::one());
        let normal = S::select(alone, normal, S::zero());
        let border = self.distance.equals(S::zero());
        let on = normal.with_primal(S::Primal::zero());
        S::select(border, on, off).canonical()
    }
}

/// `true` where a rule puts a winding number inside.
#[inline(always)]
fn fills<S: Scalar>(winding: S, fill: Fill) -> S::Mask {
    match fill {
        Fill::NonZero => !winding.equals(S::zero()),
        Fill::EvenOdd => !is_even(winding),
    }
}

/// `true` where a whole number is even.
#[inline(always)]
fn is_even<S: Scalar>(whole: S) -> S::Mask {
    // Adding and taking away 1.5 / ε rounds to a whole number.
    let shift = S::lit(1.5 / S::EPSILON);
    let half = whole.halved();
    ((half + shift) - shift).equals(half)
}

/// The distance from a point to the edges of a polyline, not negative; 0 with derivative zero on it. For a
/// single vertex the distance to it, for none the largest finite number.
///
/// Edges that are equally near share the derivative equally.
///
/// ```
/// use geograd::{Vec2, distance::ring::distance_to_polyline};
/// let path = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0)];
/// assert_eq!(distance_to_polyline(Vec2::new(1.0, 2.0), &path), 2.0);
/// ```
#[must_use]
#[inline]
pub fn distance_to_polyline<S: Scalar<Mask = bool>>(point: Vec2<S>, path: &[Vec2<S>]) -> S {
    fold_path(point, path).distance()
}

/// The distance from a point to the edges of a ring, not negative, inside as outside.
#[must_use]
#[inline]
pub fn distance_to_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    fold_ring(point, ring).distance()
}

/// The signed distance from a point to a ring in either orientation: negative inside, by the winding
/// number. Self-intersecting rings are valid. Without vertices the largest finite number.
///
/// Derivatives: the unit vector from the nearest point of the ring (inside: towards it), to the ends of
/// its edge by the share with which they take part; exactly on an edge the outward normal, on a vertex
/// zero. Kinks: the points with several nearest edges, which share the derivative equally.
///
/// ```
/// use geograd::{Vec2, distance::ring::signed_distance_to_ring};
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(signed_distance_to_ring(Vec2::new(0.25, 0.5), &square), -0.25);
/// assert_eq!(signed_distance_to_ring(Vec2::new(2.0, 0.0), &square), 1.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance_to_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    fold_ring(point, ring).signed_distance(Fill::NonZero)
}

/// The winding number of a ring around a point. On the ring it is that of one of its sides.
///
/// ```
/// use geograd::{Vec2, distance::ring::winding_of_ring};
/// let clockwise = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(winding_of_ring(Vec2::new(0.2, 0.2), &clockwise), -1.0);
/// ```
#[must_use]
#[inline]
pub fn winding_of_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    edges(ring)
        .map(|(from, to)| edge_winding(point, from, to))
        .fold(S::zero(), |sum, edge| sum + edge)
}

/// The fold over the edges of a polyline; over its vertex where it has only one.
#[must_use]
#[inline]
pub fn fold_path<S: Scalar<Mask = bool>>(point: Vec2<S>, path: &[Vec2<S>]) -> EdgeFold<S> {
    if let [only] = path {
        return EdgeFold::of_edge(point, *only, *only);
    }
    nearest(point, path, false).unwrap_or_else(|| {
        path.windows(2).fold(EdgeFold::empty(), |state, ends| {
            state.with_edge(point, ends[0], ends[1])
        })
    })
}

/// The fold over the edges of a ring.
#[must_use]
#[inline]
pub fn fold_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> EdgeFold<S> {
    nearest(point, ring, true).unwrap_or_else(|| {
        edges(ring).fold(EdgeFold::empty(), |state, (from, to)| {
            state.with_edge(point, from, to)
        })
    })
}

/// The edges of a ring, the closing one first.
#[inline(always)]
fn edges<S: Copy>(ring: &[Vec2<S>]) -> impl Iterator<Item = (Vec2<S>, Vec2<S>)> {
    let previous = ring.last().into_iter().chain(ring);
    previous.zip(ring).map(|(&from, &to)| (from, to))
}
