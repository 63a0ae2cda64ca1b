//! Crossings of lines and of segments.
use crate::distance::edge::{scale_of, size_of};
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
    /// 0 for nothing, 1 for a point (`from` and `to` are the same), 2 for a segment. A constant.
    #[shape(number)]
    pub kind: S,
}

/// 1 where the mask is true, else 0.
#[inline(always)]
pub(crate) fn flag<S: Scalar>(mask: S::Mask) -> S {
    S::select(mask, S::one(), S::zero())
}

/// The point in which two lines cross, with its parameters on both.
///
/// Lines count as parallel by the sine of their angle, whatever the lengths of their directions:
/// there is no tolerance in units of length. Parallel lines have parameters 0 with derivative zero.
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
    let cross = turn.magnitude().above(S::lit(S::EPSILON.powi(2)));
    let safe = S::select(cross, turn, S::one());
    let along = |across: S, unit: S| {
        let local = S::select(cross, across, S::zero()).over(safe);
        // One factor after the other: their product need not be representable.
        (local * unit).over(of_way).saturated()
    };
    let along_a = along(w.perp_dot(db), of_a);
    let along_b = along(w.perp_dot(da), of_b);
    CommonPoint {
        point: (a.point + a.direction * along_a).canonical(),
        along_a: along_a.canonical(),
        along_b: along_b.canonical(),
        found: flag::<S>(cross),
    }
}

/// The part that two segments share: nothing, a point, or a segment where they lie along each other. Ends belong
/// to segments.
///
/// Segments lie along each other if cross products are exactly zero; after rounding,
/// nearly parallel segments share nothing or one point. Without a meeting both points are the start
/// of the longer segment. Derivatives are those of the kind that was found; ends that tie share.
///
/// ```
/// use geograd::{Segment2, Vec2, intersection::meeting_of_segments};
/// let at = |x: f64, y: f64| Vec2::new(x, y);
/// let a = Segment2::new(at(0.0, 0.0), at(4.0, 0.0));
/// let across = meeting_of_segments(a, Segment2::new(at(1.0, -1.0), at(1.0, 1.0)));
/// assert_eq!((across.kind, across.from), (1.0, at(1.0, 0.0)));
/// let along = meeting_of_segments(a, Segment2::new(at(6.0, 0.0), at(3.0, 0.0)));
/// assert_eq!((along.kind, along.from, along.to), (2.0, at(3.0, 0.0), at(4.0, 0.0)));
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
    let (zero, one) = (S::zero(), S::one());
    let within = |x: S, most: S| zero.at_most(x) & x.at_most(most);

    // Across: t on the base and u on the other are quotients with the same divisor.
    let turn = d.perp_dot(e);
    let (over_t, over_u) = (w.perp_dot(e).signed_as(turn), w.perp_dot(d).signed_as(turn));
    let turn = turn.unsigned();
    let crossing = turn.above(zero);
    let across = crossing & within(over_t, turn) & within(over_u, turn);
    let safe = S::select(across, turn, one);
    let t = S::select(across, over_t, zero).over(safe);

    // Along: the parameters of the other's ends on the base.
    let square = d.length_squared();
    let point = square.at_most(S::lit(S::EPSILON.powi(4)));
    let square = S::select(point, one, square);
    let (first, second) = (w.dot(d).over(square), (w + e).dot(d).over(square));
    let low = first.least(second).most(zero);
    let high = first.most(second).least(one);
    let same = w.x.equals(zero) & w.y.equals(zero);
    let line = !crossing & d.perp_dot(w).equals(zero) & (!point | same);
    let along = line & low.at_most(high);

    let pick = |along_t: S| S::select(along, along_t, S::select(across, t, zero));
    let (low, high) = (pick(low), pick(high));
    let kind = S::select(
        along & low.below(high),
        S::lit(2.0),
        flag::<S>(along | across),
    );
    CommonPart {
        from: base.point_at(low),
        to: base.point_at(high),
        kind,
    }
}
