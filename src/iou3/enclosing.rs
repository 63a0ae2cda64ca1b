//! Shapes around a pair of boxes.
use crate::iou::{hull_area_aabb2, hull_area_obb2};
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Obb2, Rotation2, Scalar, Vec2, Vec3};

/// What is put around a pair of boxes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Enclosing {
    /// The smallest box along the axes of the world.
    Aabb,
    /// A box that turns with the pair. Axis-aligned and upright boxes: the rectangle of least area around both grounds times
    /// the height of both. Boxes of any orientation: the smaller one of the boxes around both along the axes
    /// of either.
    Rectangle,
    /// The convex hull of both grounds times the height of both, for axis-aligned and upright boxes; boxes of
    /// any orientation as [`Rectangle`](Enclosing::Rectangle). Its size is that of the box around both, made
    /// narrower to the area of the hull.
    Hull,
}

/// The size of a box around a pair whose ground has the area of a hull within it.
#[inline(always)]
fn narrowed<S: Scalar>(around: Vec3<S>, hull: S) -> Vec3<S> {
    let empty = (around.x.at_most(S::zero())) | (around.y.at_most(S::zero()));
    let held = |x: S| S::select(empty, S::one(), x);
    let part = hull.over(held(around.x)).over(held(around.y));
    let narrow = S::select(empty, S::one(), part).root();
    Vec3::new(around.x * narrow, around.y * narrow, around.z)
}

#[inline(always)]
pub(super) fn of_bounds<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>, kind: Enclosing) -> Vec3<S> {
    let both = a.join(b).size();
    match kind {
        Enclosing::Aabb => both,
        // The rectangle of least area around both grounds may be a turned one.
        Enclosing::Rectangle => of_upright(a.into(), b.into(), kind),
        Enclosing::Hull => narrowed(both, hull_area_aabb2(a.birds_eye(), b.birds_eye())),
    }
}

#[inline(always)]
pub(super) fn of_upright<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>, kind: Enclosing) -> Vec3<S> {
    // Relative to the first box, so that far from the origin no digits are lost.
    let b = YawBox3 {
        center: b.center - a.center,
        ..b
    };
    let a = YawBox3 {
        center: Vec3::zero(),
        ..a
    };
    let both = a.bounding().join(b.bounding()).size();
    match kind {
        Enclosing::Aabb => both,
        Enclosing::Rectangle => {
            let ground = smallest_rectangle(a.birds_eye(), b.birds_eye());
            Vec3::new(ground.x, ground.y, both.z)
        }
        Enclosing::Hull => narrowed(both, hull_area_obb2(a.birds_eye(), b.birds_eye())),
    }
}

#[inline(always)]
pub(super) fn of_any<S: Scalar>(a: Obb3<S>, b: Obb3<S>, kind: Enclosing) -> Vec3<S> {
    match kind {
        Enclosing::Aabb => {
            let shifted = Obb3 {
                center: b.center - a.center,
                ..b
            };
            let own = Obb3 {
                center: Vec3::zero(),
                ..a
            };
            own.bounding().join(shifted.bounding()).size()
        }
        Enclosing::Rectangle | Enclosing::Hull => {
            let along = |one: Obb3<S>, other: Obb3<S>| {
                let back = one.rotation.inverse();
                let half = one.size * S::lit(0.5);
                let seen = Obb3 {
                    center: back * (other.center - one.center),
                    size: other.size,
                    rotation: back * other.rotation,
                };
                Aabb3::new(-half, half).join(seen.bounding()).size()
            };
            let (by_a, by_b) = (along(a, b), along(b, a));
            let volume = |v: Vec3<S>| v.x * v.y * v.z;
            let second = volume(by_b).below(volume(by_a));
            Vec3::new(
                S::select(second, by_b.x, by_a.x),
                S::select(second, by_b.y, by_a.y),
                S::select(second, by_b.z, by_a.z),
            )
        }
    }
}

/// The size of the rectangle of least area around two boxes of the plane, along the direction of one of its
/// sides and across.
///
/// A side of it lies along an edge of the convex hull: along a side of either box, or through a corner of
/// each. All eighteen such directions are tried, hull or not, since none of them can give less; so nothing is
/// sorted. The best one is found by values alone, so slopes are those of one rectangle and not of eighteen.
/// Kinks: where another direction becomes the best.
#[must_use]
pub fn smallest_rectangle<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Vec2<S> {
    let (p, q) = (a.corners(), b.corners());
    let points = [p[0], p[1], p[2], p[3], q[0], q[1], q[2], q[3]];
    let values = points.map(primal);
    let along = |heading: S| {
        let axis = Rotation2::from_angle(heading);
        Vec2::new(axis.cos, axis.sin)
    };
    let mut best = along(a.heading);
    let mut area = area_along(primal(best), values);
    let mut candidate = |way: Vec2<S>| {
        let axis = primal(way).normalize_or_zero();
        let own = area_along(axis, values);
        // Corners that are one have no direction.
        let better = axis.length_squared().above(S::Primal::zero()) & own.below(area);
        area = S::Primal::select(better, own, area);
        best = Vec2::new(
            S::select(better, way.x, best.x),
            S::select(better, way.y, best.y),
        );
    };
    candidate(along(b.heading));
    for from in p {
        for to in q {
            candidate(to - from);
        }
    }
    size_along(best.normalize_or_zero(), points)
}

/// A point's numbers alone.
fn primal<S: Scalar>(p: Vec2<S>) -> Vec2<S::Primal> {
    Vec2::new(p.x.primal(), p.y.primal())
}

/// The size of the rectangle around eight points, along a direction and across.
fn size_along<S: Scalar>(axis: Vec2<S>, points: [Vec2<S>; 8]) -> Vec2<S> {
    let extent = |axis: Vec2<S>| {
        let at = points.map(|p| axis.dot(p));
        let (mut low, mut high) = (at[0], at[0]);
        for x in &at[1..] {
            (low, high) = (low.least(*x), high.most(*x));
        }
        high - low
    };
    Vec2::new(extent(axis), extent(axis.perp()))
}

/// The area of that rectangle.
fn area_along<S: Scalar>(axis: Vec2<S>, points: [Vec2<S>; 8]) -> S {
    let size = size_along(axis, points);
    size.x * size.y
}
