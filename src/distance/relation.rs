//! Two cores against each other, once for all functions of distance.
use super::convex::Convex;
use super::corners::Core;
use super::edge::{direction, scale_of};
use super::outcome::Contact;
use super::share::{Best, Deepest, Nearest};
use crate::{Scalar, Vec2};

/// The relation of two convex shapes. Lengths are in units of `1 / scale`, points are relative to `origin`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relation<S: Scalar> {
    /// The signed distance of the cores.
    pub apart: S,
    /// From a to b: the unit vector along which the cores are apart, or must part; zero where points
    /// coincide.
    pub normal: Vec2<S>,
    /// The point of a's core.
    pub on_a: Vec2<S>,
    /// The point of b's core.
    pub on_b: Vec2<S>,
    /// `true` where the cores overlap without end: no translation separates them.
    pub endless: S::Mask,
    /// `true` where the cores share more than a border.
    pub overlap: S::Mask,
    /// The vector between the nearest points of cores that are apart.
    pub way: Vec2<S>,
    pub origin: Vec2<S>,
    pub scale: S,
}

impl<S: Scalar> Relation<S> {
    /// Returns the signed distance of the shapes, of which both radii together are taken away.
    #[inline(always)]
    pub fn signed(&self, radius: S) -> S {
        self.parted(self.apart.over(self.scale) - radius)
            .canonical()
    }
    /// Returns the squared distance of cores without radii: no root, so that curvature is right, too, where it
    /// vanishes.
    #[inline(always)]
    pub fn square(&self) -> S {
        S::select(
            self.overlap | self.endless,
            S::zero(),
            self.way.length_squared(),
        )
    }
    /// Converts a square to the unit of length.
    #[inline(always)]
    pub fn unscaled_square(&self, square: S) -> S {
        let square = square.over(self.scale).over(self.scale);
        square.saturated().canonical()
    }
    /// Returns the depth of overlap with both radii together, and a direction.
    #[inline(always)]
    pub fn penetration(&self, radius: S, direction: Vec2<S>) -> Contact<S> {
        let depth = -self.parted(self.apart.over(self.scale) - radius);
        Contact {
            depth: S::select(depth.above(S::zero()), depth, S::zero()).canonical(),
            direction: direction.canonical(),
        }
    }
    /// Converts a vector to the unit of length.
    #[inline(always)]
    pub fn unscaled(&self, way: Vec2<S>) -> Vec2<S> {
        Vec2::new(way.x.over(self.scale), way.y.over(self.scale))
    }
    /// Returns minus the largest finite number for two lines that cross: no translation separates them.
    #[inline(always)]
    fn parted(&self, apart: S) -> S {
        S::select(self.endless, S::lowest(), apart)
    }
}

/// The number of roundings of the unit by which heights and vectors may differ, if all sizes are at most four.
pub(super) const SLACK: f64 = 64.0;

/// Ask for how far only.
pub(crate) const LENGTH: u8 = 0;
/// Ask for the normal, too.
pub(crate) const NORMAL: u8 = 1;
/// Ask for the points, too.
pub(crate) const POINTS: u8 = 2;

/// Relates two shapes; results that are not needed are zero. All functions that need one relation of a pair call one
/// function, which compilers may share.
#[inline]
pub(crate) fn relate<S: Scalar, A: Convex<S>, B: Convex<S>, const ASK: u8>(
    a: A,
    b: B,
) -> Relation<S> {
    let whole = relate_all(a, b);
    let zero = Vec2::zero();
    Relation {
        normal: if ASK >= NORMAL { whole.normal } else { zero },
        on_a: if ASK >= POINTS { whole.on_a } else { zero },
        on_b: if ASK >= POINTS { whole.on_b } else { zero },
        ..whole
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn relate_all<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Relation<S> {
    let (a, b) = (a.core(), b.core());
    // Relative to a point of the two, in units of their extent: no digits are lost by the distance from the origin, and
    // no product over- or underflows.
    let origin = a.anchor();
    let scale = scale_of::<S>(a.extent(origin).most(b.extent(origin)));
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let bounded = A::Core::BOUNDED || B::Core::BOUNDED;
    let near = nearest(a, b).mean();
    let direction = direction(near.apart);
    joined((near, direction), deepest(a, b), bounded, origin, scale)
}

/// Returns the relation of two cores by their nearest points, the direction from a to b there, and by the face that
/// separates them best, relative to `origin` in units of `1 / scale`. `bounded` is `true` if one of them is bounded.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn joined<S: Scalar>(
    (near, direction): (Nearest<S>, Vec2<S>),
    deepest: Option<Best<S, Deepest<S>>>,
    bounded: bool,
    origin: Vec2<S>,
    scale: S,
) -> Relation<S> {
    let length = near.apart.length();
    // Duals of a tiny length pass through numbers beyond the largest one.
    let along = near.apart.dot(direction.constant());
    let along = along.with_primal(length.primal());
    let length = S::select(length.at_most(S::speck()), along, length);
    let none = length.at_most(S::zero());
    let never = S::one().below(S::zero());
    let Some(deep) = deepest else {
        // Without an area nothing overlaps.
        return Relation {
            apart: length,
            normal: direction,
            on_a: near.on_a,
            on_b: near.on_b,
            endless: never,
            overlap: never,
            way: near.apart,
            origin,
            scale,
        };
    };
    let parted = deep.value.above(S::lowest());
    let deep = deep.mean();
    // Shifted by their depth, cores that overlap touch, and then a corner of one is on an edge of the other: without
    // the shift it is no farther from there than the depth. Faces too short to count would have separated all others.
    let reachable = (S::rounding(SLACK, 1) - deep.ahead) - deep.ahead;
    let behind = deep.ahead.below(S::zero()) & length.at_most(reachable);
    // For a point on an edge, its offset and the face decide the side with different roundings. Few shapes are so
    // close, and batches leave out what only these need.
    let slack = S::rounding(SLACK, 1);
    let close = near.apart.length_squared().at_most(slack.squared());
    let against = near.apart.dot(deep.lead).below(S::zero());
    let opposite = close & !deep.ahead.below(S::zero()) & against;
    let inside = parted & (behind | none | opposite);
    // Cores with a point in common are not apart, however the height over a face was rounded.
    let rounded = none & deep.ahead.above(S::zero());
    let touching = deep.ahead.with_primal(S::Primal::zero());
    let ahead = S::select(rounded, touching, deep.ahead);
    Relation {
        apart: S::select(inside, ahead, length),
        normal: Vec2::select(inside, deep.normal, direction),
        on_a: Vec2::select(inside, deep.on_a, near.on_a),
        on_b: Vec2::select(inside, deep.on_b, near.on_b),
        // Bounded cores have a face that separates them unless both are points, for which the vector between them
        // decides.
        endless: if bounded { never } else { !parted },
        overlap: parted & (behind | none) & deep.ahead.below(S::zero()),
        way: near.apart,
        origin,
        scale,
    }
}

/// Returns the nearest points of two cores that do not overlap.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nearest<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> Best<S, Nearest<S>> {
    // A point is only a corner, which the other core's edges have been compared with.
    if A::DIMENSION == 0 && B::DIMENSION > 0 {
        return b.near(a.corners().as_ref()).flipped();
    }
    let first = a.near(b.corners().as_ref());
    if B::DIMENSION == 0 {
        return first;
    }
    first.less(b.near(a.corners().as_ref()).flipped())
}

/// Returns the face that separates two cores best; `None` if neither their overlap nor their difference has an area.
/// The faces of the set of all differences of two convex sets are the faces of both sets.
#[cfg_attr(not(debug_assertions), inline(always))]
fn deepest<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> Option<Best<S, Deepest<S>>> {
    if A::DIMENSION + B::DIMENSION < 2 {
        return None;
    }
    let of_a = || a.deep(&b);
    let of_b = || b.deep(&a).flipped();
    let bounded = A::BOUNDED && B::BOUNDED;
    Some(if A::DIMENSION == 0 {
        of_b()
    } else if B::DIMENSION == 0 {
        of_a()
    } else if bounded {
        of_a().most_of_faces(of_b())
    } else {
        of_a().most(of_b())
    })
}
