//! Two cores of space against each other, once for all functions of distance.
use super::core::Core;
use super::deep::{PartingPlane, SLACK, deepest};
use super::near::{Nearest, edges_near};
use super::pair;
use crate::distance::edge::scale_of;
use crate::distance::share::Best;
use crate::scalar::speck;
use crate::{Scalar, Vec3};

/// The relation of two shapes to each other.
#[derive(Clone, Copy, Debug)]
pub struct Relation<S> {
    /// The signed distance.
    pub apart: S,
    /// The square of the distance.
    pub square: S,
    /// From a to b, of length one: the direction in which the shapes are apart or must part; zero where points
    /// coincide.
    pub normal: Vec3<S>,
    /// The point of a.
    pub on_a: Vec3<S>,
    /// The point of b.
    pub on_b: Vec3<S>,
}

impl<S: Scalar> Relation<S> {
    /// With a and b exchanged.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        Relation {
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            ..self
        }
    }
    /// The relation of shapes whose points are at most some radii from these.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn inflated(self, radius_a: S, radius_b: S) -> Self {
        let apart = self.apart - (radius_a + radius_b);
        Relation {
            apart,
            square: square_of_gap(apart),
            normal: self.normal,
            on_a: self.on_a + self.normal * radius_a,
            on_b: self.on_b - self.normal * radius_b,
        }
    }
}

/// The square of a signed distance, zero where that is negative.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn square_of_gap<S: Scalar>(apart: S) -> S {
    S::select(apart.above(S::zero()), apart * apart, S::zero())
}

/// The vector with length one; zero for none. Beside a speck it is a constant, whose derivatives are beyond the format.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn direction<S: Scalar>(way: Vec3<S>) -> Vec3<S> {
    let length = way.length();
    let none = length.at_most(S::zero());
    let over = S::select(none, S::one(), length);
    let unit = Vec3::new(way.x.over(over), way.y.over(over), way.z.over(over));
    Vec3::select(length.at_most(S::lit(speck::<S>())), unit.constant(), unit)
}

/// From where two cores are seen, and the units: those of their extent, so that no product over- or underflows. All
/// products are of differences, so that corners which are given need not be moved, which would round them.
#[cfg_attr(not(debug_assertions), inline(always))]
fn view<S: Scalar, A: Core<S>, B: Core<S>>(a: &A, b: &B) -> (Vec3<S>, S) {
    let anchor = a.anchor();
    let origin = match (A::CENTERED, B::CENTERED) {
        (true, _) => anchor,
        (_, true) => b.anchor(),
        _ => Vec3::zero(),
    };
    let size = a.extent(anchor).most(b.extent(anchor));
    (origin, scale_of::<S>(size))
}

/// The relation of two cores.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn relate<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> Relation<S> {
    if let (Some(a), Some(b)) = (a.as_box(), b.as_box()) {
        return pair::relate(a, b);
    }
    let (origin, scale) = view(&a, &b);
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let found = joined(nearest(&a, &b), deepest(&a, &b));
    let growth = a.growth(found.normal) + b.growth(found.normal);
    let square = found.square - (found.square.root() * growth + found.square.root() * growth);
    let back = |v: Vec3<S>| {
        let v = Vec3::new(v.x.over(scale), v.y.over(scale), v.z.over(scale));
        origin + v
    };
    Relation {
        apart: (found.apart - growth).over(scale),
        square: square.over(scale).over(scale),
        normal: found.normal,
        on_a: back(found.on_a),
        on_b: back(found.on_b),
    }
}

/// The nearest points of two cores that do not overlap.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nearest<S: Scalar, A: Core<S>, B: Core<S>>(a: &A, b: &B) -> Nearest<S> {
    let (corners_a, corners_b) = (a.corners(), b.corners());
    let of_b = |best: Nearest<S>| best.flipped();
    // A point is nothing but a corner: the other core's edges have seen it.
    if A::DIMENSION == 0 && B::DIMENSION > 0 {
        return of_b(b.near(corners_a.as_ref()).mean());
    }
    let mut best = a.near(corners_b.as_ref());
    if B::DIMENSION > 0 {
        let other = b.near(corners_a.as_ref());
        best = best.less(Best {
            sum: of_b(other.sum),
            ..other
        });
    }
    for &first in a.edges().as_ref() {
        for &second in b.edges().as_ref() {
            best = best.less(edges_near(first, second));
        }
    }
    best.mean()
}

/// The relation by the nearest points and by the plane that parts the cores best.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn joined<S: Scalar>(near: Nearest<S>, deep: Option<PartingPlane<S>>) -> Relation<S> {
    let given = near.normal.length_squared().above(S::zero());
    let direction = Vec3::select(given, direction(near.normal), direction(near.apart));
    let length = near.apart.length();
    // Duals of the length of a speck pass through numbers beyond the largest one.
    let along = near.apart.dot(direction.constant());
    let along = along.with_primal(length.primal());
    let length = S::select(length.at_most(S::lit(speck::<S>())), along, length);
    let none = length.at_most(S::zero());
    let square = near.apart.length_squared();
    let Some(deep) = deep else {
        // Without a volume nothing overlaps.
        return Relation {
            apart: length,
            square,
            normal: direction,
            on_a: near.on_a,
            on_b: near.on_b,
        };
    };
    let parted = deep.value.above(S::lit(-S::LARGEST));
    // Shifted by their depth, cores that overlap touch, and then a corner or an edge of one is on the other: without
    // the shift it is no farther from there than the depth. Faces too small to count would have parted any others.
    let reachable = (S::lit(SLACK * S::EPSILON) - deep.ahead) - deep.ahead;
    let behind = deep.ahead.below(S::zero()) & length.at_most(reachable);
    let inside = parted & (behind | none);
    // Cores with a point in common are not apart, however the height over a face was rounded.
    let rounded = none & deep.ahead.above(S::zero());
    let touching = deep.ahead.with_primal(S::Primal::zero());
    let ahead = S::select(rounded, touching, deep.ahead);
    let overlap = inside & deep.ahead.below(S::zero());
    Relation {
        apart: S::select(inside, ahead, length),
        square: S::select(overlap, S::zero(), square),
        normal: Vec3::select(inside, deep.normal, direction),
        on_a: Vec3::select(inside, deep.on_a, near.on_a),
        on_b: Vec3::select(inside, deep.on_b, near.on_b),
    }
}

/// The square of the longest way from a corner of one core to one of another; ties share.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn farthest<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> S {
    if let (Some(a), Some(b)) = (a.as_box(), b.as_box()) {
        return pair::farthest(a, b);
    }
    let (origin, scale) = view(&a, &b);
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let (from, to) = (a.corners(), b.corners());
    let squares = from.as_ref().iter().flat_map(|&p| {
        let to = to.as_ref().iter();
        to.map(move |&q| {
            let square = (q - p).length_squared();
            Best::of(square, square)
        })
    });
    Best::most_of(squares).mean().root().over(scale)
}
