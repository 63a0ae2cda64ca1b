//! The rectangle of least area around two boxes of the plane.
//!
//! A side of it lies along an edge of the convex hull. As in [`iou`](crate::iou::HullOfBoxes), the normals of the eight
//! sides alternate, one of a, one of b. Between two neighbours the hull passes from a corner of one box to one of the
//! other if different boxes reach farther along them. These are eight directions, and those of both boxes' own sides
//! are two more; nothing is sorted.
//!
//! Several directions often give one area: for boxes with one centre, opposite edges do, and both boxes reach equally
//! far across them on both sides. Areas, and lengths along a direction, count as equal if they differ within rounding;
//! equal ones share the derivative.
use crate::arrays::Each;
use crate::clip::{Relative, frame, relate};
use crate::iou::unit;
use crate::{Obb2, Scalar, Vec2};

/// The number of roundings within which numbers count as equal.
const ROUNDINGS: f64 = 4.0;

/// The rectangle of least area, in units of `1 / scale`; the mean of all of that area.
pub(super) struct Rectangle<S> {
    pub area: S,
    /// The square of the diagonal.
    pub diagonal: S,
    /// The size along the side nearer to the first box's own x axis, and across.
    pub size: Vec2<S>,
}

/// A rectangle along a direction of any length.
struct RectangleAlong<S: Scalar> {
    length: S,
    width: S,
    /// The square of the length of the direction.
    squared: S,
    /// `true` where the direction is nearer to y than to x.
    steep: S::Mask,
    /// `true` where it is along an edge of the hull.
    is_edge: S::Mask,
}

/// Compares `x` with the sum of `terms` as constants: 1 if `x` is larger, 0 if it is smaller, ½ if they tie within
/// rounding.
#[inline(always)]
fn weight<S: Scalar>(x: S, terms: [S; 3]) -> S::Primal {
    let [a, b, c] = terms.each_as(S::primal);
    let (x, y) = (x.primal(), (a + b) + c);
    let all = x + (a.unsigned() + b + c);
    let near = (x - y)
        .unsigned()
        .at_most(all * S::Primal::rounding(ROUNDINGS, 1));
    let won = S::Primal::select(x.above(y), S::Primal::one(), S::Primal::zero());
    S::Primal::select(near, S::Primal::lit(0.5), won)
}

/// Returns the larger of a's extent `own` and b's extent `other` from its centre at `way`. A tie within rounding shares
/// the derivative, and so does a known one (`tie`).
#[inline(always)]
fn farther<S: Scalar>(own: S, way: S, other: S, tie: S::Mask) -> S {
    let reach = way + other;
    let all = (own.primal() + way.primal().unsigned()) + other.primal();
    let slack = S::from_primal(all * S::Primal::rounding(ROUNDINGS, 1));
    let near = tie | (own - reach).unsigned().at_most(slack);
    let longer = S::select(own.below(reach), reach, own);
    S::select(near, own.halved() + reach.halved(), longer)
}

/// Both boxes in the frame of a, mirrored so that b is turned counter-clockwise.
struct MirroredPair<S: Scalar> {
    center: Vec2<S>,
    turn: Vec2<S>,
    half_a: Vec2<S>,
    half_b: Vec2<S>,
}

impl<S: Scalar> MirroredPair<S> {
    #[inline(always)]
    fn of(pair: &Relative<S>) -> Self {
        let mirrored = pair.sin.below(S::zero());
        MirroredPair {
            center: Vec2::new(pair.u, S::select(mirrored, -pair.v, pair.v)),
            turn: Vec2::new(pair.cos, pair.sin.unsigned()),
            half_a: pair.half_a,
            half_b: pair.half_b,
        }
    }
    /// Returns the rectangle around both boxes along a direction. `flat` is true where both boxes reach equally far across
    /// it, on both sides.
    #[inline(always)]
    fn along(&self, way: Vec2<S>, is_edge: S::Mask, flat: S::Mask) -> RectangleAlong<S> {
        let way = way * unit([way.x, way.y]);
        let (x, y, turn) = (way.x, way.y, self.turn);
        let in_b = Vec2::new(x * turn.x + y * turn.y, y * turn.x - x * turn.y);
        let shadow = |x: S, y: S, half: Vec2<S>| x.magnitude() * half.x + y.magnitude() * half.y;
        let extent = |center: S, own: S, other: S, tie: S::Mask| {
            farther(own, center, other, tie) + farther(own, -center, other, tie)
        };
        let never = S::one().below(S::zero());
        let c = self.center;
        let squared = way.length_squared();
        let point = squared.at_most(S::zero());
        RectangleAlong {
            length: extent(
                x * c.x + y * c.y,
                shadow(x, y, self.half_a),
                shadow(in_b.x, in_b.y, self.half_b),
                never,
            ),
            width: extent(
                x * c.y - y * c.x,
                shadow(y, x, self.half_a),
                shadow(in_b.y, in_b.x, self.half_b),
                flat,
            ),
            squared: S::select(point, S::one(), squared),
            steep: x.unsigned().below(y.unsigned()),
            is_edge: is_edge & !point,
        }
    }
    /// Returns the ten directions.
    #[inline(always)]
    fn directions(&self) -> [RectangleAlong<S>; 10] {
        let (c, turn, a, b) = (self.center, self.turn, self.half_a, self.half_b);
        let (p, q) = (
            Vec2::new(b.x * turn.x, b.x * turn.y),
            Vec2::new(-(b.y * turn.y), b.y * turn.x),
        );
        // The extents of b along the sides of a, and of a along the sides of b.
        let (bx, by) = (p.x - q.x, p.y + q.y);
        let (ax, ay) = (a.x * turn.x + a.y * turn.y, a.y * turn.x + a.x * turn.y);
        let (e, f) = (c.x * turn.x + c.y * turn.y, c.y * turn.x - c.x * turn.y);
        let zero = S::zero();
        let of_a = [
            weight(a.x, [c.x, bx, zero]),
            weight(a.y, [c.y, by, zero]),
            weight(a.x, [-c.x, bx, zero]),
            weight(a.y, [-c.y, by, zero]),
        ];
        let one = S::Primal::one();
        let of_b = [
            one - weight(b.x, [-e, ax, zero]),
            one - weight(b.y, [-f, ay, zero]),
            one - weight(b.x, [e, ax, zero]),
            one - weight(b.y, [f, ay, zero]),
        ];
        let differ = |x: S::Primal, y: S::Primal| !x.equals(y);
        let (none, all) = (S::Primal::zero(), one);
        // Sides of no length have no direction.
        let is_long = |x: S| x.primal().above(none);
        let sides_of_a = (differ(of_a[0], none) | differ(of_a[2], none)) & is_long(a.y)
            | (differ(of_a[1], none) | differ(of_a[3], none)) & is_long(a.x);
        let sides_of_b = (differ(of_b[0], all) | differ(of_b[2], all)) & is_long(b.y)
            | (differ(of_b[1], all) | differ(of_b[3], all)) & is_long(b.x);
        // From a corner of a to one of b, and where that is an edge; opposite ones four indices apart.
        let over = |side: Vec2<S>, arm: Vec2<S>| (c + arm) - side;
        let [a0, a1] = [a, Vec2::new(-a.x, a.y)];
        let (b0, b1) = (p + q, q - p);
        let minus = |v: Vec2<S>| Vec2::new(-v.x, -v.y);
        let edges = [
            (over(a0, minus(b1)), differ(of_a[0], of_b[0])),
            (over(a0, b0), differ(of_b[0], of_a[1])),
            (over(a1, b0), differ(of_a[1], of_b[1])),
            (over(a1, b1), differ(of_b[1], of_a[2])),
            (over(minus(a0), b1), differ(of_a[2], of_b[2])),
            (over(minus(a0), minus(b0)), differ(of_b[2], of_a[3])),
            (over(minus(a1), minus(b0)), differ(of_a[3], of_b[3])),
            (over(minus(a1), minus(b1)), differ(of_b[3], of_a[0])),
        ];
        let never = S::one().below(zero);
        let along = |k: usize| {
            let ((way, is_edge), (back, is_too)) = (edges[k], edges[(k + 4) % 8]);
            let parallel = way.perp_dot(back).equals(zero);
            self.along(way, is_edge, is_edge & is_too & parallel)
        };
        [
            self.along(Vec2::new(S::one(), zero), sides_of_a, never),
            self.along(turn, sides_of_b, never),
            along(0),
            along(1),
            along(2),
            along(3),
            along(4),
            along(5),
            along(6),
            along(7),
        ]
    }
}

/// Returns the rectangle of least area around a related pair.
#[inline(always)]
pub(super) fn least_rectangle<S: Scalar>(pair: &Relative<S>) -> Rectangle<S> {
    let all = MirroredPair::of(pair).directions();
    let area = |x: &RectangleAlong<S>| (x.length * x.width).over(x.squared);
    let mut least = S::Primal::largest();
    for x in &all {
        let own = area(x).primal();
        let better = x.is_edge & own.below(least);
        least = S::Primal::select(better, own, least);
    }
    let slack = least * S::Primal::lit(1.0 + ROUNDINGS * S::format().epsilon());
    let (mut count, zero) = (S::Primal::zero(), S::zero());
    let mut sum = Rectangle {
        area: zero,
        diagonal: zero,
        size: Vec2::zero(),
    };
    for x in &all {
        let own = area(x);
        let takes = x.is_edge & own.primal().at_most(slack);
        let taken = |value: S| S::select(takes, value, zero);
        count += S::Primal::select(takes, S::Primal::one(), S::Primal::zero());
        sum.area += taken(own);
        let diagonal = x.length.squared() + x.width.squared();
        sum.diagonal += taken(diagonal.over(x.squared));
        let by = x.squared.root();
        let (length, width) = (x.length.over(by), x.width.over(by));
        sum.size.x += taken(S::select(x.steep, width, length));
        sum.size.y += taken(S::select(x.steep, length, width));
    }
    // Two points that coincide have no direction, and nothing is around them.
    let count = count.most(S::Primal::one());
    let mean = |x: S| x.over(S::from_primal(count));
    Rectangle {
        area: mean(sum.area),
        diagonal: mean(sum.diagonal),
        size: Vec2::new(mean(sum.size.x), mean(sum.size.y)),
    }
}

/// Returns the size of the rectangle of least area around two boxes of the plane, in units of length: along the side
/// nearer to the first box's own x axis, and across. If several are equal to within rounding, it is their mean.
///
/// Kinks: where another direction becomes the best; exact ties, and areas that differ by less than rounding,
/// share the derivative.
///
/// ```
/// use geograd::{Obb2, Vec2, iou3::smallest_rectangle};
/// let (a, b) = (Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0), Obb2::new(3.0, 0.0, 2.0, 2.0, 0.0));
/// assert_eq!(smallest_rectangle(a, b), Vec2::new(6.0, 2.0));
/// ```
#[must_use]
pub fn smallest_rectangle<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Vec2<S> {
    let (a, b) = (frame(a), frame(b));
    let scale = crate::iou::unit_of_pair(&a, &b);
    let size = least_rectangle(&relate::<S, true>(a, b, scale)).size;
    let outer = |x: S| x.over(scale).saturated().canonical();
    Vec2::new(outer(size.x), outer(size.y))
}
