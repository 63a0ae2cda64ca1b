//! Distances of lines and rays of space from each other, from segments and from points, each inflated by a radius; and
//! from any other core by the part of the line that is near it.
use super::apart::Apart;
use super::aside;
use super::between::{self, joined};
use super::core::Core3;
use super::cored::InflatedCore;
use super::near::{Nearest, across, normal, size_of};
use super::relation::Relation;
use super::simplex::{SegmentCore, SimplexCore};
use super::spot::{plain, vanish};
use super::straight::{Straight, StraightKind};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::Guard;
use crate::shape::{Line3, Ray3};
use crate::{Scalar, Vec3};

impl<S: Scalar> Straight<S> {
    /// Returns the relation of a line or ray to a core, in coordinates relative to the core: far from the origin the
    /// ends of a part of the line would lose digits.
    #[inline(always)]
    fn relation<B: Core3<S>>(self, core: B) -> Relation<S> {
        let anchor = core.anchor();
        let seen = Straight {
            from: self.from - anchor,
            ..self
        };
        let core = core.seen_from(anchor);
        let found = between::relate(seen.before(&core), core);
        Relation {
            on_a: anchor + found.on_a,
            on_b: anchor + found.on_b,
            ..found
        }
    }
    /// Returns a direction across the line or ray and a core that meet.
    #[inline(always)]
    fn aside<B: Core3<S>>(self, core: B) -> Vec3<S> {
        let unit = |way: Vec3<S::Primal>| way * scale_of::<S::Primal>(size_of(way));
        let (core, along) = (core.plain(), plain(self.along));
        let ways = core.ways();
        let ways = ways.as_ref().iter().copied();
        aside::across(ways.chain([along]).map(unit))
    }
    /// Returns the part of a line or ray that a core can be near to. Its ends are beyond the line's nearest points to
    /// the core by more than the core's size, so that no translation along it is shorter than one across.
    #[inline(always)]
    fn before<B: Core3<S>>(&self, core: &B) -> SegmentCore<S> {
        let anchor = core.anchor();
        // No corner is farther from the anchor than √3 extents, and no shift across is longer than another.
        let reach = S::from_primal(core.extent(anchor)) * S::lit(2.75);
        SimplexCore(self.near(anchor, reach))
    }
    /// Returns the ends of the part of a line or ray that is no farther than a length from the foot of a point.
    #[inline(always)]
    pub(super) fn near(&self, point: Vec3<S>, reach: S) -> [Vec3<S>; 2] {
        let plain = |x: S| S::from_primal(x.primal());
        let way = self.along * scale_of::<S>(size_of(self.along));
        let square = way.length_squared();
        let none = square.at_most(S::zero());
        let square = S::select(none, S::one(), square);
        let margin = reach.over(square.root());
        let foot = way.dot(point - self.from).over(square);
        let (low, high) = (foot - margin, foot + margin);
        let (low, high) = match self.reach {
            StraightKind::Line => (low, high),
            _ => (low.most(S::zero()), high.most(margin)),
        };
        // Results do not depend on where an end is, so that it has no derivative of its own.
        [low, high].each_as(|t| self.from + way * plain(t))
    }
}

/// Returns the relation of two straight features.
///
/// The parameter of the first one is that of the common normal; for parallel features it is the middle of their common
/// range, as far as that ends. A sine below eight roundings counts as parallel. The other parameter follows from it, so
/// that the distance errs by the square only.
#[inline(always)]
fn relate<S: Scalar>(a: Straight<S>, b: Straight<S>) -> Relation<S> {
    let way = b.from - a.from;
    let scale = scale_of::<S>(size_of(way).most(a.extent()).most(b.extent()));
    let (u, v, w) = (a.way(scale), b.way(scale), way * scale);
    let (zero, one) = (S::zero(), S::one());
    let safe = |square: S| {
        let none = square.at_most(S::rounding(1.0, 4));
        (none, S::select(none, one, square))
    };
    let ((point_a, uu), (point_b, vv)) = (safe(u.length_squared()), safe(v.length_squared()));
    let (mut cross, uv) = (normal(u, v), u.dot(v));
    // Rounding decides the crossing of nearly parallel features, and nothing bounds its distance.
    let rounding = S::rounding(8.0, 2);
    cross.none = cross.none | cross.square.at_most(uu * vv * rounding);
    // As for parallel features: the ends of b in parameters of a.
    let seen = |end: Vec3<S>| a.held(end.dot(u).over(uu)).0;
    let start = match b.reach {
        StraightKind::Line => zero,
        _ => seen(w),
    };
    let same = uv.above(zero);
    let end = match (b.reach, a.reach) {
        (StraightKind::Segment, _) => seen(w + v),
        (StraightKind::Ray, StraightKind::Segment) => S::select(same, one, zero),
        (StraightKind::Ray, StraightKind::Ray) => S::select(same, start, zero),
        (StraightKind::Line, StraightKind::Segment) => one,
        // The middle of both points that are given, whichever line comes first.
        (StraightKind::Line, StraightKind::Line) => seen(w),
        _ => start,
    };
    let middle = start.halved() + end.halved();
    let free = w.cross(v).dot(cross.long).over(cross.square);
    let s = S::select(cross.none, middle, a.held(free).0);
    let s = S::select(point_a, zero, s);
    let (t, mut inside) = b.held((uv * s - w.dot(v)).over(vv));
    let t = S::select(point_b, zero, t);
    inside = inside & !point_b;
    let again = a.held((uv * t + w.dot(u)).over(uu)).0;
    let s = S::select(inside | point_a, s, again);
    let (_, between) = a.held(s);
    let crossing = inside & between & !cross.none;
    // The vector between two features that cross is along their normal.
    let fixed = |x: S| S::from_primal(x.primal());
    let way = w + v * fixed(t) - u * fixed(s);
    let (straight, direction) = across(cross, way);
    let (on_a, on_b) = (u * s, w + v * t);
    let near = Nearest {
        apart: Vec3::select(crossing, straight, on_b - on_a),
        on_a,
        on_b,
        normal: Vec3::select(crossing, direction, Vec3::zero()),
    };
    let slides = crossing & !cross.clear;
    let (r, q) = (vanish(u.dot(way)), vanish(v.dot(way)));
    let less = (v * r - u * q).length_squared().over(cross.square);
    let found = bent(joined(near, None).relation, slides, less);
    let back = |v: Vec3<S>| {
        let v = Vec3::new(v.x.over(scale), v.y.over(scale), v.z.over(scale));
        a.from + v
    };
    Relation {
        apart: found.apart.over(scale),
        square: found.square.over(scale).over(scale),
        normal: found.normal,
        on_a: back(found.on_a),
        on_b: back(found.on_b),
    }
}

/// Returns the relation of two features that cross, with second derivatives where their normal has few digits.
///
/// The vector between two points held fixed has the first derivatives alone. Both points slide. With the residuals r
/// and q of orthogonality to u and v, which are zero, the squared distance is less by `|v r − u q|² / |u × v|²`.
#[inline(always)]
fn bent<S: Scalar>(found: Relation<S>, slides: S::Mask, less: S) -> Relation<S> {
    let slides = slides & found.apart.above(S::speck());
    let less = S::select(slides, less, S::zero());
    let length = S::select(slides, found.apart, S::one());
    Relation {
        apart: found.apart - less.over(length).halved(),
        square: found.square - less,
        ..found
    }
}

macro_rules! endless {
    ($($Shape:ident: $field:ident $StraightKind:ident, other $($Endless:ident)*;)*) => { $(
        impl<S: Scalar> $Shape<S> {
            /// Returns the line or ray as a feature.
            #[inline(always)]
            pub(super) fn feature(self) -> Straight<S> {
                Straight {
                    from: self.$field,
                    along: self.direction,
                    reach: StraightKind::$StraightKind,
                }
            }
        }
        impl<S: Scalar, B: InflatedCore<Scalar = S>> Apart<B> for $Shape<S> {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &B) -> Guard<S> {
                Guard::of(self).and(other)
            }
            #[inline]
            fn relation(self, other: B) -> Relation<S> {
                let (line, core) = (self.feature(), other.core());
                let found = match core.straight() {
                    Some(straight) => relate(line, straight),
                    None => line.relation(core),
                };
                match B::ROUND {
                    true => found.inflated(S::zero(), other.radius(), line.aside(core)),
                    false => found,
                }
            }
        }
        impl<S: Scalar, A: InflatedCore<Scalar = S>> Apart<$Shape<S>> for A {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &$Shape<S>) -> Guard<S> {
                Guard::of(other).and(self)
            }
            #[inline]
            fn relation(self, other: $Shape<S>) -> Relation<S> {
                other.relation(self).flipped()
            }
        }
        $(
            impl<S: Scalar> Apart<$Endless<S>> for $Shape<S> {
                type Scalar = S;
                #[inline(always)]
                fn guarded_with(&self, other: &$Endless<S>) -> Guard<S> {
                    Guard::of(self).and(other)
                }
                #[inline]
                fn relation(self, other: $Endless<S>) -> Relation<S> {
                    relate(self.feature(), other.feature())
                }
            }
        )*
    )* };
}
endless! {
    Line3: point Line, other Line3 Ray3;
    Ray3: point Ray, other Line3 Ray3;
}
