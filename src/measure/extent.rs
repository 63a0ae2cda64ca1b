//! The largest and the smallest extent of points: diameter and width.
use crate::arrays::Each;
use crate::hull::hull_search;
use crate::predicate::{Turn, turn_between};
use crate::reference::Reference;
use crate::{Scalar, Vec2};

/// The two points that are farthest apart, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Farthest {
    /// One of them.
    pub from: usize,
    /// The other one.
    pub to: usize,
}

/// The record of the width of a set of points, by index: between the line through two of them, neighbours on the hull,
/// and a third one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Narrowest {
    /// The edge of the hull from here ...
    pub start: usize,
    /// ... to here.
    pub end: usize,
    /// The point that is farthest from it.
    pub across: usize,
}

/// Visits all pairs of an edge of a hull (by the number of its start) and a vertex farthest from it, by rotating
/// calipers: `O(n)`.
pub(crate) fn calipers<S: Scalar<Mask = bool>>(
    points: &[Vec2<S>],
    hull: &[usize],
    mut visit: impl FnMut(usize, usize),
) {
    let n = hull.len();
    let at = |k: usize| points[hull[k % n]];
    let mut far = 1;
    for k in 0..n {
        far = far.max(k + 1);
        // At most once around, for any input.
        while far < k + n {
            let edge = [at(far), at(far + 1)];
            match turn_between([at(k), at(k + 1)], edge) {
                Turn::Left => far += 1,
                Turn::Straight => {
                    visit(k, (far + 1) % n);
                    break;
                }
                Turn::Right => break,
            }
        }
        visit(k, far % n);
    }
}

/// Returns the diameter of points, in units of length: the largest distance between two of them, and which
/// they are. `None` for no points; zero, between a point and itself, for one. `O(n log n)`.
///
/// Kink: several pairs equally far apart. Derivatives: see [`diameter_replay`].
///
/// ```
/// use geograd::{Vec2, measure::extent::{Farthest, diameter_search}};
/// let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (1.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(diameter_search(&points), Some((5.0, Farthest { from: 0, to: 2 })));
/// ```
#[must_use]
pub fn diameter_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Option<(S, Farthest)> {
    let hull = hull_search(points);
    let &first = hull.first()?;
    let seen = Reference::of_ring(points);
    let squared = |i: usize, j: usize| {
        let way = seen.place(points[i]) - seen.place(points[j]);
        way.length_squared().primal()
    };
    let last = hull[hull.len() - 1];
    let mut best = Farthest {
        from: first.min(last),
        to: first.max(last),
    };
    let mut most = squared(first, last);
    if hull.len() > 2 {
        calipers(points, &hull, |edge, across| {
            for end in [edge, (edge + 1) % hull.len()] {
                let (i, j) = (hull[end], hull[across]);
                let found = squared(i, j);
                if found.above(most) {
                    most = found;
                    best = Farthest {
                        from: i.min(j),
                        to: i.max(j),
                    };
                }
            }
        });
    }
    Some((diameter_replay(points, best), best))
}

/// Returns the distance of the two points of a record. Derivatives pull both apart; zero where they coincide.
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
#[inline]
pub fn diameter_replay<S: Scalar>(points: &[Vec2<S>], record: Farthest) -> S {
    let distance = |p: Vec2<S>, q: Vec2<S>| {
        let (x, y) = (p.x.halved() - q.x.halved(), p.y.halved() - q.y.halved());
        let half = x.hypot(y);
        (half + half).saturated().canonical()
    };
    distance(points[record.from], points[record.to])
}

/// Returns the width of points, in units of length: the least distance between two parallel lines that have
/// them all between them, and what decided it. `None` for no points, and for points on a line, whose
/// width is zero. `O(n log n)`.
///
/// Kink: several edges of the hull equally far from their farthest point. Derivatives: see
/// [`width_replay`]. Source: Houle and Toussaint, Computing the width of a set, 1988.
///
/// ```
/// use geograd::{Vec2, measure::extent::width_search};
/// let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(width_search(&points).unwrap().0, 1.0);
/// ```
#[must_use]
pub fn width_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Option<(S, Narrowest)> {
    let hull = hull_search(points);
    let mut best: Option<(S::Primal, Narrowest)> = None;
    if hull.len() > 2 {
        let seen = Reference::of_ring(points);
        let place = |k: usize| seen.place(points[k]);
        calipers(points, &hull, |edge, across| {
            let record = Narrowest {
                start: hull[edge],
                end: hull[(edge + 1) % hull.len()],
                across: hull[across],
            };
            let found = height(place(record.start), place(record.end), place(record.across));
            let found = found.primal();
            if best.is_none_or(|(least, _)| found.below(least)) {
                best = Some((found, record));
            }
        });
    }
    best.map(|(_, record)| (width_replay(points, record), record))
}

/// Returns the distance of a point to the left of the line from `start` to `end`, zero where those coincide.
fn height<S: Scalar>(start: Vec2<S>, end: Vec2<S>, point: Vec2<S>) -> S {
    (end - start).normalize_or_zero().perp_dot(point - start)
}

/// Returns the distance of the third point of a record from the line through the other two: the width as long
/// as these decide, with derivatives to all three.
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
#[inline]
pub fn width_replay<S: Scalar>(points: &[Vec2<S>], record: Narrowest) -> S {
    let three = [
        points[record.start],
        points[record.end],
        points[record.across],
    ];
    let seen = Reference::of_ring(&three);
    let [start, end, across] = three.each_as(|p| seen.place(p));
    seen.outer(height(start, end, across))
        .saturated()
        .canonical()
}
