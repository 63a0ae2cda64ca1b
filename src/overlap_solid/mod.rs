//! Overlap of convex bodies with flat faces: volume of intersection, intersection over union, intersection over the
//! first; volume behind a plane, and the polygon in which a plane cuts a body.
//!
//! Bodies are tetrahedra, hulls, boxes of any orientation, upright and axis-aligned ones, in any two; two boxes have
//! formulas of their own, [`overlap3`](crate::overlap3). The second may be a half-space. The verbs are
//! [`IntersectionVolume`](crate::kernels::verbs::IntersectionVolume), `Iou` and `Iof`, and for the area in a plane
//! `IntersectionArea`.
//!
//! ```
//! use geograd::prelude::*;
//! let [x, y, z] = [Vec3::new(2.0_f64, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 0.0, 2.0)];
//! let wedge: Hull3<f64, 8> = Hull3::from_vertices(&[Vec3::zero(), x, y, z]);
//! let cube = Aabb3::new(Vec3::zero(), Vec3::new(1.0, 1.0, 1.0));
//! assert!((cube.intersection_volume(wedge) - 5.0 / 6.0).abs() < 1e-15);
//! let level = Plane3::new(Vec3::new(0.0, 0.0, 1.0), 1.0);
//! assert!((wedge.iof(level) - 7.0 / 8.0).abs() < 1e-15);
//! assert!((wedge.intersection_area(level) - 0.5).abs() < 1e-15);
//! assert_eq!(wedge.slice(level).len(), 3);
//! ```
//!
//! # The method
//!
//! A search in `f64` cuts the smaller body by the planes of the other one. Its surface is a closed mesh of corners and
//! of points between two others; it stays closed whatever the signs of heights over a plane are. So where faces are
//! nearly parallel rounding moves points along them, which changes no volume. The record has the mesh, and a replay sums
//! tetrahedra over it. Derivatives, up to the second, are those of Reynolds' theorem: the part of a face inside the other
//! body, times its move.
//!
//! Results are exactly zero, with all derivatives zero, for bodies that are apart or touch within two roundings of the
//! smaller one's size, and for those that are thinner than four of their own. The ratios are within `[0, 1]`; bodies with equal corners in one order give
//! exactly 1 with derivative zero. Of repeated vertices the first has the derivative.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`. The error is some roundings of the smaller body's surface times the size of the
//! larger one.
//!
//! Kinks: faces of both in one plane (either has half of the derivative), four corners of a hull in one plane (the
//! derivative is that of some triangles of the face), and bodies that begin to touch (derivative zero).
mod cutting_planes;
mod slice;
mod solid_cut;
mod volume_record;
mod volume_replay;
mod volume_search;

use crate::distance::edge::scale_of;
use crate::distance3::core::Core3;
use crate::distance3::cored::InflatedCore;
use crate::overlap::{Denominator, ratio_of_first, ratio_of_union};
use crate::overlap3::Overlaps;
use crate::scalar::largest;
use crate::shape::{Aabb3, Hull3, Obb3, Plane3, Tetrahedron, YawBox3};
use crate::{Pack, Scalar, Vec3};
use cutting_planes::Other;
pub use volume_record::VolumeRecord;
use volume_replay::SharedVolume;
use volume_search::Decisions;

/// A convex body with flat faces, or a half-space, as the second of two.
pub(crate) trait Cuts: Copy + Pack<Scalar: Scalar> {
    /// The corners; none for a half-space.
    type Corners: AsRef<[Vec3<Self::Scalar>]>;
    /// Returns the corners relative to a point, times a scale.
    fn placed(&self, from: Vec3<Self::Scalar>, scale: Self::Scalar) -> Self::Corners;
    /// Returns normal and offset of a half-space, relative to a point, times a scale.
    fn half_space(
        &self,
        _from: Vec3<Self::Scalar>,
        _scale: Self::Scalar,
    ) -> Option<(Vec3<Self::Scalar>, Self::Scalar)> {
        None
    }
}

/// A convex body with flat faces.
pub(crate) trait Solid: Cuts {
    /// Returns a point near its corners.
    fn anchor(&self) -> Vec3<Self::Scalar>;
}

/// Returns the vertices relative to a point; behind the last one the first is repeated.
fn vertices_from<S: Scalar, const N: usize>(hull: &Hull3<S, N>, from: Vec3<S>) -> [Vec3<S>; N] {
    let count = hull.count.clamp(1, N);
    let mut all = hull.vertices;
    for (k, corner) in all.iter_mut().enumerate() {
        *corner = hull.vertices[if k < count { k } else { 0 }] - from;
    }
    all
}

/// Returns points as plain numbers, exactly; `None` where one is not finite, or of another format.
fn numbers<S: Scalar>(points: &[Vec3<S>]) -> Option<Vec<Vec3<f64>>> {
    let wide = |Vec3 { x, y, z }: &Vec3<S>| {
        let point = Vec3::new(x.widened()?, y.widened()?, z.widened()?);
        point.is_finite().then_some(point)
    };
    points.iter().map(wide).collect()
}

/// Corners of a body in units of the smaller of two.
macro_rules! solids {
    ($([$($size:tt)*] $Shape:ty, $Corners:ty, |$shape:ident, $from:ident| $corners:expr, $anchor:expr;)*) => { $(
        impl<S: Scalar, $($size)*> Cuts for $Shape {
            type Corners = $Corners;
            #[inline]
            fn placed(&self, $from: Vec3<S>, scale: S) -> Self::Corners {
                let $shape = self;
                let mut corners = $corners;
                for corner in &mut corners {
                    *corner = *corner * scale;
                }
                corners
            }
        }
        impl<S: Scalar, $($size)*> Solid for $Shape {
            #[inline]
            fn anchor(&self) -> Vec3<S> {
                let $shape = self;
                $anchor
            }
        }
        impl<S: Scalar<Mask = bool>, $($size)*> $Shape {
            /// Returns the corners of the polygon in which a plane cuts it, counter-clockwise seen from the side to
            /// which the normal points; none where they do not meet.
            #[must_use]
            pub fn slice(&self, plane: Plane3<S>) -> Vec<Vec3<S>> {
                slice_of(self, plane)
            }
        }
    )* };
    (@cored $($Shape:ty, $Corners:ty;)*) => {
        solids! { $(
            [] $Shape, $Corners,
            |shape, from| shape.core().placed(from, S::one()).corners(), shape.core().anchor();
        )* }
    };
}
solids! { @cored
    Tetrahedron<S>, [Vec3<S>; 4];
    Aabb3<S>, [Vec3<S>; 8];
    YawBox3<S>, [Vec3<S>; 8];
    Obb3<S>, [Vec3<S>; 8];
}
solids! {
    [const N: usize] Hull3<S, N>, [Vec3<S>; N], |hull, from| vertices_from(hull, from), hull.vertices[0];
}

impl<S: Scalar> Cuts for Plane3<S> {
    type Corners = [Vec3<S>; 0];
    fn placed(&self, _: Vec3<S>, _: S) -> [Vec3<S>; 0] {
        []
    }
    fn half_space(&self, from: Vec3<S>, scale: S) -> Option<(Vec3<S>, S)> {
        let offset = self.offset - self.normal.dot(from);
        Some((self.normal, offset * scale))
    }
}

/// Two bodies relative to a point near the first, in units of the smaller one.
struct Placed<S, A, B> {
    a: A,
    b: B,
    half_space: Option<(Vec3<S>, S)>,
    scale: S,
}

impl<S: Scalar, A: AsRef<[Vec3<S>]>, B: AsRef<[Vec3<S>]>> Placed<S, A, B> {
    fn new<X, Y>(a: &X, b: &Y) -> Self
    where
        X: Solid<Scalar = S, Corners = A>,
        Y: Cuts<Scalar = S, Corners = B>,
    {
        let (from, one) = (a.anchor(), S::one());
        let extent = |corners: &[Vec3<S>]| {
            let first = corners[0];
            let arms = corners.iter().map(|&corner| corner - first);
            arms.fold(S::Primal::zero(), |most, arm| {
                let own = largest([arm.x, arm.y, arm.z]);
                S::Primal::select(most.below(own), own, most)
            })
        };
        let size = extent(a.placed(from, one).as_ref());
        let there = b.placed(from, one);
        let size = match there.as_ref() {
            [] => size,
            there => {
                let other = extent(there);
                S::Primal::select(other.below(size), other, size)
            }
        };
        let scale = scale_of::<S>(size);
        Placed {
            a: a.placed(from, scale),
            b: b.placed(from, scale),
            half_space: b.half_space(from, scale),
            scale,
        }
    }
    fn other(&self) -> Other<'_, S> {
        match self.half_space {
            Some((normal, offset)) => Other::HalfSpace(normal, offset),
            None => Other::Corners(self.b.as_ref()),
        }
    }
}

/// Returns the decisions for the volume that two bodies share; of bodies that are not finite none.
fn decisions<S, A, B>(a: &A, b: &B) -> Decisions
where
    S: Scalar<Mask = bool>,
    A: Solid<Scalar = S>,
    B: Cuts<Scalar = S>,
{
    let placed = Placed::new(a, b);
    let Some(a) = numbers(placed.a.as_ref()) else {
        return Decisions::default();
    };
    match placed.other() {
        Other::Corners(b) => match numbers(b) {
            Some(b) => volume_search::search(&a, Other::Corners(&b), S::format().epsilon()),
            None => Decisions::default(),
        },
        Other::HalfSpace(normal, offset) => match (numbers(&[normal]), offset.widened()) {
            (Some(normal), Some(offset)) if offset.is_finite() => volume_search::search(
                &a,
                Other::HalfSpace(normal[0], offset),
                S::format().epsilon(),
            ),
            _ => Decisions::default(),
        },
    }
}

/// Returns the record of the volume that two bodies share.
pub(crate) fn volume_search<S, A, B, const N: usize>(a: &A, b: &B) -> VolumeRecord<N>
where
    S: Scalar<Mask = bool>,
    A: Solid<Scalar = S>,
    B: Cuts<Scalar = S>,
{
    VolumeRecord::of(decisions(a, b))
}

/// Returns a measure of the volume that two bodies share, along the record of [`volume_search`]; NaN where that does
/// not hold all decisions.
pub(crate) fn volume_replay<S, A, B, const N: usize>(
    over: Denominator,
    a: &A,
    b: &B,
    record: &VolumeRecord<N>,
) -> S
where
    S: Scalar,
    A: Solid<Scalar = S>,
    B: Cuts<Scalar = S>,
{
    match record.decisions() {
        Some(found) => measure(over, a, b, &found),
        None => S::lit(f64::NAN),
    }
}

/// Returns a measure of the volume that two bodies share, along decisions.
fn measure<S, A, B>(over: Denominator, a: &A, b: &B, found: &Decisions) -> S
where
    S: Scalar,
    A: Solid<Scalar = S>,
    B: Cuts<Scalar = S>,
{
    let placed = Placed::new(a, b);
    let volumes = volume_replay::replay(placed.a.as_ref(), placed.other(), found);
    let SharedVolume {
        shared,
        first,
        second,
    } = volumes;
    let scale = placed.scale;
    let value = match over {
        Denominator::None => shared.over(scale).over(scale).over(scale).saturated(),
        // The union with a half-space has no end.
        Denominator::Union if placed.half_space.is_some() => S::zero(),
        Denominator::Union if found.same && found.has_volume() => S::one(),
        Denominator::Union => ratio_of_union(shared, first, second),
        Denominator::First => ratio_of_first(shared, first),
    };
    value.canonical()
}

/// Boxes with other bodies, and with half-spaces.
macro_rules! boxes_overlap {
    ($($Box:ident)*) => { $(
        boxes_overlap!(@with $Box, [] Tetrahedron<S>);
        boxes_overlap!(@with $Box, [const N: usize] Hull3<S, N>);
        boxes_overlap!(@with $Box, [] Plane3<S>);
    )* };
    (@with $Box:ident, [$($size:tt)*] $Other:ty) => {
        impl<S: Scalar<Mask = bool>, $($size)*> Overlaps<$Other> for $Box<S> {
            type Scalar = S;
            #[inline]
            fn volume_shared_with(self, other: $Other) -> S {
                measure(Denominator::None, &self, &other, &decisions(&self, &other))
            }
            #[inline]
            fn iou_with(self, other: $Other) -> S {
                measure(Denominator::Union, &self, &other, &decisions(&self, &other))
            }
            #[inline]
            fn iof_with(self, other: $Other) -> S {
                measure(Denominator::First, &self, &other, &decisions(&self, &other))
            }
        }
    };
}
boxes_overlap! { Aabb3 YawBox3 Obb3 }

/// Returns the area in which a plane cuts a body, along the record of [`volume_search`]; NaN where that does not hold all
/// decisions.
pub(crate) fn slice_replay<S, A, const N: usize>(
    a: &A,
    plane: Plane3<S>,
    record: &VolumeRecord<N>,
) -> S
where
    S: Scalar,
    A: Solid<Scalar = S>,
{
    let Some(found) = record.decisions() else {
        return S::lit(f64::NAN);
    };
    let placed = Placed::new(a, &plane);
    let area = slice::area(placed.a.as_ref(), placed.other(), &found);
    let area = area.over(placed.scale).over(placed.scale);
    area.saturated().canonical()
}

fn slice_of<S: Scalar<Mask = bool>, A: Solid<Scalar = S>>(a: &A, plane: Plane3<S>) -> Vec<Vec3<S>> {
    let placed = Placed::new(a, &plane);
    let found = decisions(a, &plane);
    let (from, scale) = (a.anchor(), placed.scale);
    let polygon = slice::polygon(placed.a.as_ref(), placed.other(), &found);
    let back = |p: Vec3<S>| from + Vec3::new(p.x.over(scale), p.y.over(scale), p.z.over(scale));
    polygon.into_iter().map(back).collect()
}
