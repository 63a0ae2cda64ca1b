//! The rectangle of least area around points.
use crate::arrays::Each;
use crate::hull::hull_search;
use crate::predicate::{Turn, turn_between};
use crate::reference::Reference;
use crate::{Obb2, Scalar, Vec2};

/// The points that a rectangle around points rests on, by index: an edge of their hull lies along its bottom,
/// three more points on its other sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Resting {
    /// The edge along the bottom, from here ...
    pub start: usize,
    /// ... to here, from left to right.
    pub end: usize,
    /// The point on the right side.
    pub right: usize,
    /// The point on the top.
    pub top: usize,
    /// The point on the left side.
    pub left: usize,
}

/// Returns a vector turned back by a quarter, whose dot product is the cross product with the original.
fn turned_back<S: Scalar>(p: Vec2<S>) -> Vec2<S> {
    Vec2::new(p.y, -p.x)
}

/// Advances a vertex number around a hull while its next edge leads along a direction, at most once around.
fn advance<S: Scalar<Mask = bool>>(
    at: impl Fn(usize) -> Vec2<S>,
    direction: [Vec2<S>; 2],
    mut from: usize,
    n: usize,
) -> usize {
    let end = from + n;
    while from < end && turn_between(direction, [at(from), at(from + 1)]) == Turn::Left {
        from += 1;
    }
    from
}

/// Returns the rectangle of least area that has all points inside, and the record of the points on its sides. Its
/// heading is that of an edge of the hull. `None` for no points, and for points on a line. `O(n log n)`.
///
/// Kink: several rectangles of equal area. Derivatives: see [`rectangle_replay`]. Source: Freeman and Shapira 1975 (one
/// side lies along an edge of the hull); rotating calipers, Toussaint 1983.
///
/// ```
/// use geograd::{Obb2, measure::rectangle::rectangle_search};
/// let car = Obb2::new(3.0_f64, 1.0, 4.0, 2.0, 0.5);
/// let (around, _) = rectangle_search(&car.corners()).unwrap();
/// assert!((around.area() - 8.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn rectangle_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Option<(Obb2<S>, Resting)> {
    let hull = hull_search(points);
    let n = hull.len();
    if n < 3 {
        return None;
    }
    let seen = Reference::of_ring(points);
    let at = |k: usize| points[hull[k % n]];
    let (mut right, mut top, mut left) = (0, 0, 0);
    let mut best: Option<(S::Primal, Resting)> = None;
    for k in 0..n {
        let along = [at(k), at(k + 1)];
        // Directions as pairs of points: along the edge, left of it, and back.
        let back = [along[1], along[0]];
        right = advance(at, along.each_as(turned_back), right.max(k + 1), n);
        top = advance(at, along, top.max(right), n);
        left = advance(at, back.each_as(turned_back), left.max(top), n);
        let record = Resting {
            start: hull[k],
            end: hull[(k + 1) % n],
            right: hull[right % n],
            top: hull[top % n],
            left: hull[left % n],
        };
        let [width, height] = sides(&seen, points, record).size;
        let area = (width * height).primal();
        if best.is_none_or(|(least, _)| area.below(least)) {
            best = Some((area, record));
        }
    }
    best.map(|(_, record)| (rectangle_replay(points, record), record))
}

/// A rectangle in local coordinates.
struct LocalRectangle<S> {
    axis: Vec2<S>,
    /// Along the bottom edge from its start, to the middle of the rectangle.
    middle: S,
    size: [S; 2],
}

fn sides<S: Scalar>(seen: &Reference<S>, points: &[Vec2<S>], record: Resting) -> LocalRectangle<S> {
    let place = |k: usize| seen.place(points[k]);
    let start = place(record.start);
    let axis = (place(record.end) - start).normalize_or_zero();
    let along = |k: usize| axis.dot(place(k) - start);
    let (low, high) = (along(record.left), along(record.right));
    LocalRectangle {
        axis,
        middle: (low + high).halved(),
        size: [high - low, axis.perp_dot(place(record.top) - start)],
    }
}

/// Returns the rectangle that rests on the points of a record, with derivatives to all five.
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
pub fn rectangle_replay<S: Scalar>(points: &[Vec2<S>], record: Resting) -> Obb2<S> {
    let five = [
        record.start,
        record.end,
        record.right,
        record.top,
        record.left,
    ];
    let seen = Reference::of_ring(&five.each_as(|k| points[k]));
    let LocalRectangle { axis, middle, size } = sides(&seen, points, record);
    let start = seen.place(points[record.start]);
    let center = start + axis * middle + axis.perp() * size[1].halved();
    let outer = |x: S| seen.outer(x).saturated().canonical();
    Obb2 {
        center: seen.outer_place(center).canonical(),
        size: Vec2::new(outer(size[0]), outer(size[1])),
        heading: axis.angle().canonical(),
    }
}
