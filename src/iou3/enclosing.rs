//! Shapes around a pair of axis-aligned or of upright boxes.
use super::ground::least_rectangle;
use super::terms::Terms;
use crate::arrays::Each;
use crate::clip::area_from_half;
use crate::clip::{frame, relate};
use crate::iou::{
    BoxesAround, across, bounds, hull_of_related, hull_scale, larger, part, share, unit,
    unit_of_pair,
};
use crate::shape::{Aabb3, YawBox3};
use crate::{Obb2, Scalar, Vec2, Vec3};

/// The shape around a pair of boxes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Enclosing {
    /// The smallest box along the axes of the world.
    Aabb,
    /// A box that turns with the pair. Axis-aligned and upright boxes: the rectangle of least area around both
    /// grounds times the height of both. Boxes of any orientation: the smaller one, by volume, of the boxes
    /// around both along the axes of either; equal ones, to within rounding, count half and half, but a box that
    /// holds the other one is the shape itself.
    Rectangle,
    /// The convex hull of both grounds times the height of both, for axis-aligned and upright boxes; boxes of
    /// any orientation as [`Rectangle`](Enclosing::Rectangle).
    Hull,
}

/// Returns the share of an enclosing shape that neither box covers, from those that they cover and their IoU.
#[inline(always)]
pub(super) fn outside<S: Scalar>(covered: [S; 2], shared: S, empty: S::Mask) -> S {
    let [a, b] = covered;
    // In differences that are exactly zero for a box within the other one that is all there is.
    let rest = (S::one() - a.most(b)) - (a.least(b) - shared);
    // Rounding can leave the shape around a little smaller than the boxes in it.
    let short = rest.below(S::zero());
    let rest = S::select(short, rest.with_primal(S::Primal::zero()), rest);
    S::select(empty, S::zero(), rest)
}

/// Returns the shared part, from the parts that both cover: with `I/U = i` and `U = A + B − I`.
#[inline(always)]
pub(super) fn shared<S: Scalar>(covered: [S; 2], iou: S) -> S {
    (covered[0] + covered[1]) * iou.over(S::one() + iou)
}

/// Returns the square of a difference of two sizes over a length that is no smaller than either.
#[inline(always)]
pub(super) fn gap<S: Scalar>(a: S, b: S, against: S) -> S {
    share(a - b, against).squared()
}

/// Returns the terms by the smallest axis-aligned box around two others.
#[inline(always)]
fn of_bounds<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> Terms<S> {
    let half = |low: S, high: S| high.halved() - low.halved();
    let size = |x: Aabb3<S>| {
        [
            half(x.min.x, x.max.x),
            half(x.min.y, x.max.y),
            half(x.min.z, x.max.z),
        ]
    };
    let (own, other, around) = (size(a), size(b), size(a.join(b)));
    let meet = size(a.meet(b));
    let apart = (a.max.x.at_most(b.min.x) | b.max.x.at_most(a.min.x))
        | (a.max.y.at_most(b.min.y) | b.max.y.at_most(a.min.y))
        | (a.max.z.at_most(b.min.z) | b.max.z.at_most(a.min.z));
    let zero = S::zero();
    let empty = (around[0].at_most(zero) | around[1].at_most(zero)) | around[2].at_most(zero);
    // Axis by axis: no product is of lengths.
    let covered = |size: [S; 3]| {
        let [x, y, z] = [0, 1, 2].each_as(|i| share(size[i], around[i]));
        (x * y) * z
    };
    let covered_by_both = S::select(apart, zero, covered(meet));
    let scale = unit(around);
    let way = |low: S, high: S| (low + high).halved() * scale;
    let way = Vec3::new(
        way(half(a.min.x, b.min.x), half(a.max.x, b.max.x)),
        way(half(a.min.y, b.min.y), half(a.max.y, b.max.y)),
        way(half(a.min.z, b.min.z), half(a.max.z, b.max.z)),
    );
    let diagonal = Vec3::new(around[0], around[1], around[2]) * scale;
    Terms {
        outside: outside([covered(own), covered(other)], covered_by_both, empty),
        way: part(way.length_squared(), diagonal.length_squared()),
        gaps: gap(own[0], other[0], around[0])
            + gap(own[1], other[1], around[1])
            + gap(own[2], other[2], around[2]),
    }
}

/// Returns the terms of two axis-aligned boxes.
#[inline(always)]
pub(super) fn of_aligned<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>, iou: S, kind: Enclosing) -> Terms<S> {
    if kind == Enclosing::Aabb {
        return of_bounds(a, b);
    }
    // Centres and sizes have their digits only near the origin.
    let origin = Vec3::new(a.min.x, a.min.y, a.min.z);
    let origin = Vec3::new(
        S::from_primal(origin.x.primal()),
        S::from_primal(origin.y.primal()),
        S::from_primal(origin.z.primal()),
    );
    let seen = |x: Aabb3<S>| YawBox3::from(Aabb3::new(x.min - origin, x.max - origin));
    of_upright(seen(a), seen(b), iou, kind)
}

/// The grounds of two upright boxes and the shape around them, lengths in units of `1 / scale`.
struct Ground<S: Scalar> {
    /// The shares of its area that both cover.
    covered: [S; 2],
    empty: S::Mask,
    /// The squared distance of the centres and the square of the diameter.
    way: S,
    across: S,
    sizes: [Vec2<S>; 2],
    /// The divisors of the differences of the sizes.
    against: Vec2<S>,
    scale: S,
}

/// Returns the grounds of two upright boxes.
#[inline(always)]
fn ground<S: Scalar>(a: Obb2<S>, b: Obb2<S>, kind: Enclosing) -> Ground<S> {
    let (a, b) = (frame(a), frame(b));
    let scale = unit_of_pair(&a, &b);
    let covered = |size: [S; 2], around: S, empty: S::Mask| {
        let held = S::select(empty, S::one(), around);
        let covered = |x: S| S::select(empty, S::zero(), part(x, held));
        [covered(size[0]), covered(size[1])]
    };
    let none = |area: S| area.at_most(S::lit(S::format().empty()));
    match kind {
        Enclosing::Aabb => {
            let BoxesAround { around, way, sizes } = bounds(a, b, scale);
            let area = around.x * around.y;
            let empty = none(area);
            let own = |size: Vec2<S>| size.x * size.y;
            // A turned box may be longer than the box around both.
            let against = |x: S, a: S, b: S| larger(larger(x, a), b);
            Ground {
                covered: covered([own(sizes[0]), own(sizes[1])], area, empty),
                empty,
                way: way.length_squared(),
                across: around.length_squared(),
                sizes,
                against: Vec2::new(
                    against(around.x, sizes[0].x, sizes[1].x),
                    against(around.y, sizes[0].y, sizes[1].y),
                ),
                scale: scale.halved(),
            }
        }
        Enclosing::Rectangle => {
            let pair = relate::<S, true>(a, b, scale);
            let least = least_rectangle(&pair);
            let empty = none(least.area);
            let own = [area_from_half(pair.half_a), area_from_half(pair.half_b)];
            let diagonal = least.diagonal.root();
            let size = |half: Vec2<S>| (half + half) * scale;
            Ground {
                covered: covered(own, least.area, empty),
                empty,
                way: pair.u * pair.u + pair.v * pair.v,
                across: least.diagonal,
                sizes: [size(a.half), size(b.half)],
                against: Vec2::new(diagonal, diagonal),
                scale,
            }
        }
        Enclosing::Hull => {
            let pair = relate::<S, true>(a, b, hull_scale(&a, &b));
            let area = hull_of_related(&pair).area();
            let empty = none(area);
            let own = [area_from_half(pair.half_a), area_from_half(pair.half_b)];
            let across = across(a, b, scale);
            let diameter = across.squared.root();
            Ground {
                covered: covered(own, area, empty),
                empty,
                way: across.way.length_squared(),
                across: across.squared,
                sizes: across.sizes,
                against: Vec2::new(diameter, diameter),
                scale,
            }
        }
    }
}

/// Returns the terms of two upright boxes.
#[inline(always)]
pub(super) fn of_upright<S: Scalar>(
    a: YawBox3<S>,
    b: YawBox3<S>,
    iou: S,
    kind: Enclosing,
) -> Terms<S> {
    let ground = ground(a.birds_eye(), b.birds_eye(), kind);
    // All heights are halved.
    let up = b.center.z.halved() - a.center.z.halved();
    let (high_a, high_b) = (a.size.z.halved(), b.size.z.halved());
    let (reach_a, reach_b) = (high_a.halved(), high_b.halved());
    let high = reach_a.most(reach_b + up) + reach_a.most(reach_b - up);
    let flat = high.at_most(S::zero());
    let covered = [
        ground.covered[0] * share(high_a, high),
        ground.covered[1] * share(high_b, high),
    ];
    // In the unit of whichever is longer, the ground or the heights.
    let (scale, point) = (unit([high]), ground.across.at_most(S::zero()));
    let tall = (point | scale.below(ground.scale)) & !flat;
    let scale = S::select(tall, scale, ground.scale);
    let by_ground = S::select(point, ground.scale, scale)
        .over(ground.scale)
        .squared();
    let full = |half: S| (half + half) * scale;
    Terms {
        outside: outside(covered, shared(covered, iou), ground.empty | flat),
        way: part(
            ground.way * by_ground + full(up).squared(),
            ground.across * by_ground + full(high).squared(),
        ),
        gaps: gap(ground.sizes[0].x, ground.sizes[1].x, ground.against.x)
            + gap(ground.sizes[0].y, ground.sizes[1].y, ground.against.y)
            + gap(high_a, high_b, high),
    }
}
