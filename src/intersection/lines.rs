//! Crossings of lines and of segments.
use super::turns::EndSides;
use crate::distance::edge::{scale_of, size_of};
use crate::scalar::Guard;
use crate::{Line2, Scalar, Segment2, Vec2};

/// The point in which two lines cross, and its parameters on both.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommonPoint<S> {
    /// The point; for parallel lines a's own point.
    pub point: Vec2<S>,
    /// Its parameter on a; 0 for parallel lines.
    #[shape(number)]
    pub along_a: S,
    /// Its parameter on b; 0 for parallel lines.
    #[shape(number)]
    pub along_b: S,
    /// 1 where the lines cross, 0 where they are parallel. A constant.
    #[shape(number)]
    pub found: S,
}

/// The part that two segments share: nothing, a point, or a segment.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommonPart<S> {
    /// The start of the shared part, in the direction of the longer segment.
    pub from: Vec2<S>,
    /// Its end.
    pub to: Vec2<S>,
    /// 0 for nothing, 1 for a point (`from` and `to` are equal), 2 for a segment. A constant.
    #[shape(number)]
    pub kind: S,
}

/// Returns 1 where the mask is true, else 0.
#[inline(always)]
pub(crate) fn flag<S: Scalar>(mask: S::Mask) -> S {
    S::select(mask, S::one(), S::zero())
}

/// Returns the point in which two lines cross, with its parameters on both.
///
/// Lines count as parallel by the sine of their angle, for all lengths of their directions: there is no tolerance in
/// units of length. Parallel lines have parameters 0 with derivative zero.
///
/// Derivatives grow with the square of the reciprocal of the sine of the angle. They are finite where every number is
/// zero or of a magnitude from 2⁻⁸ to 2⁸ in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
///
/// ```
/// use geograd::{Line2, Vec2, intersection::crossing_of_lines};
/// let wall = Line2::new(Vec2::new(2.0, 0.0), Vec2::new(0.0, 1.0)); // x = 2
/// let beam = Line2::new(Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0));
/// let found = crossing_of_lines(wall, beam);
/// assert_eq!((found.point, found.along_a, found.along_b), (Vec2::new(2.0, 3.0), 3.0, 2.0));
/// assert_eq!(crossing_of_lines(wall, wall).found, 0.0);
/// ```
#[must_use]
#[inline]
pub fn crossing_of_lines<S: Scalar>(a: Line2<S>, b: Line2<S>) -> CommonPoint<S> {
    let way = b.point - a.point;
    let scale = |v: Vec2<S>| scale_of::<S>(size_of(v));
    let (of_a, of_b, of_way) = (scale(a.direction), scale(b.direction), scale(way));
    let (da, db, w) = (a.direction * of_a, b.direction * of_b, way * of_way);
    let turn = da.perp_dot(db);
    let cross = turn.magnitude().above(S::rounding(1.0, 2));
    let safe = S::select(cross, turn, S::one());
    let along = |across: S, unit: S| {
        let local = S::select(cross, across, S::zero()).over(safe);
        // One factor after the other: their product need not be representable.
        (local * unit).over(of_way).saturated()
    };
    let along_a = along(w.perp_dot(db), of_a);
    let along_b = along(w.perp_dot(da), of_b);
    Guard::of(&a).and(&b).result(CommonPoint {
        point: (a.point + a.direction * along_a).canonical(),
        along_a: along_a.canonical(),
        along_b: along_b.canonical(),
        found: flag::<S>(cross),
    })
}

/// Returns the part that two segments share: nothing, a point, or a segment where they lie along each other. Ends
/// belong to segments.
///
/// Their common points are decided as in exact arithmetic on the given numbers: segments lie along each other if their
/// four ends are on one line, and end on each other if an end is on the other segment. An end in which they meet is the
/// result itself. Without a meeting both points are the start of the longer segment. Derivatives are those of the kind
/// that was found; ends that tie share.
///
/// ```
/// use geograd::{Segment2, Vec2, intersection::meeting_of_segments};
/// let at = |x: f64, y: f64| Vec2::new(x, y);
/// let a = Segment2::new(at(0.0, 0.0), at(4.0, 0.0));
/// let across = meeting_of_segments(a, Segment2::new(at(1.0, -1.0), at(1.0, 1.0)));
/// assert_eq!((across.kind, across.from), (1.0, at(1.0, 0.0)));
/// let along = meeting_of_segments(a, Segment2::new(at(6.0, 0.0), at(3.0, 0.0)));
/// assert_eq!((along.kind, along.from, along.to), (2.0, at(3.0, 0.0), at(4.0, 0.0)));
/// let corner = Segment2::new(at(0.1, 0.3), at(0.0, 0.0));
/// assert_eq!(meeting_of_segments(corner, Segment2::new(at(0.1, 0.1), at(0.0, 0.0))).kind, 1.0);
/// ```
#[must_use]
#[inline]
pub fn meeting_of_segments<S: Scalar>(a: Segment2<S>, b: Segment2<S>) -> CommonPart<S> {
    // The longer one is the base, so that a segment of length zero lies along the other.
    let swap = size_of(a.along()).below(size_of(b.along()));
    let pick = |yes: Segment2<S>, no: Segment2<S>| {
        Segment2::new(
            Vec2::select(swap, yes.from, no.from),
            Vec2::select(swap, yes.to, no.to),
        )
    };
    let (base, other) = (pick(b, a), pick(a, b));
    let (along, along_other, way) = (base.along(), other.along(), other.from - base.from);
    let scale = scale_of::<S>(size_of(along).most(size_of(way)));
    let (d, e, w) = (along * scale, along_other * scale, way * scale);
    let (ends, others) = (
        [base.from, base.to].map(plain),
        [other.from, other.to].map(plain),
    );
    let sides = EndSides::of(ends, others, scale.primal());
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let apart =
        |[p, q]: [S::Primal; 2]| (p.below(zero) & q.below(zero)) | (p.above(zero) & q.above(zero));
    let ([p, q], [r, s]) = (sides.of_other, sides.of_base);
    let [on_p, on_q, on_r, on_s] = [p, q, r, s].map(|side| side.equals(zero));
    let line = on_p & on_q & on_r & on_s;
    let across = !line & !apart(sides.of_other) & !apart(sides.of_base);

    // Across: the parameter on the base is a quotient. The divisor is the difference of the sides of its ends.
    let turn = S::select(across, d.perp_dot(e), S::one());
    let turn = turn.with_primal(S::Primal::select(across, r - s, one));
    let over = w.perp_dot(e).with_primal(r);
    let t = S::select(across, over, S::zero()).over(turn);

    // Along: the parameters of the other's ends on the base.
    let square = d.length_squared();
    let point = square.at_most(S::rounding(1.0, 4));
    let square = S::select(point, S::one(), square);
    let far = (other.to - base.from) * scale;
    let (first, second) = (w.dot(d).over(square), far.dot(d).over(square));
    let low = first.least(second).most(S::zero());
    let high = first.most(second).least(S::one());
    let shared = CommonSegment::of(ends, others);
    let along = line & shared.meet;

    let at = base.point_at(t);
    let end = [
        (on_s, ends[1]),
        (on_r, ends[0]),
        (on_q, others[1]),
        (on_p, others[0]),
    ]
    .into_iter()
    .fold(plain(at), |at, (on, end)| {
        Vec2::select(across & on, end, at)
    });
    let pick = |along_t: S, place: Vec2<S::Primal>| {
        let at = Vec2::select(along, base.point_at(along_t), at);
        let place = Vec2::select(along, place, end);
        Vec2::new(at.x.with_primal(place.x), at.y.with_primal(place.y)).canonical()
    };
    Guard::of(&a).and(&b).result(CommonPart {
        from: pick(low, shared.from),
        to: pick(high, shared.to),
        kind: S::select(along & shared.two, S::lit(2.0), flag::<S>(along | across)),
    })
}

/// Returns a point without derivatives, as one of plain numbers.
#[inline(always)]
pub(super) fn plain<S: Scalar>(v: Vec2<S>) -> Vec2<S::Primal> {
    Vec2::new(v.x.primal(), v.y.primal())
}

/// The common part of two segments of one line, by comparing coordinates.
struct CommonSegment<P: Scalar> {
    meet: P::Mask,
    two: P::Mask,
    from: Vec2<P>,
    to: Vec2<P>,
}

impl<P: Scalar> CommonSegment<P> {
    /// Returns the common part of two segments of one line from their ends; `base` is the longer one.
    #[inline(always)]
    fn of(base: [Vec2<P>; 2], other: [Vec2<P>; 2]) -> Self {
        let way = base[1] - base[0];
        let flat = way.x.unsigned().at_least(way.y.unsigned());
        let rising = P::select(flat, way.x, way.y);
        let key = |p: Vec2<P>| P::select(flat, p.x, p.y).signed_as(rising);
        let back = key(other[1]).below(key(other[0]));
        let first = Vec2::select(back, other[1], other[0]);
        let last = Vec2::select(back, other[0], other[1]);
        let from = Vec2::select(key(base[0]).below(key(first)), first, base[0]);
        let to = Vec2::select(key(last).below(key(base[1])), last, base[1]);
        let (low, high) = (key(from), key(to));
        // Two points coincide if their y coordinates are equal, too.
        let apart =
            way.x.equals(P::zero()) & way.y.equals(P::zero()) & !base[0].y.equals(other[0].y);
        CommonSegment {
            meet: low.at_most(high) & !apart,
            two: low.below(high),
            from,
            to,
        }
    }
}
