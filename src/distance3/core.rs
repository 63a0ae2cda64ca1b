//! The cores of convex shapes of space: a point, a segment, a triangle, a tetrahedron, a box.
use super::near::{Candidate, Edge, Nearest};
use super::parting::{Lowest, PartingPlane};
use super::spot::{self, MeanSpot, Pull, Spot, fixed_vector};
use super::straight::Straight;
use crate::arrays::Each;
use crate::scalar::largest;
use crate::{Scalar, Vec3};

/// The core of a convex shape of space: the hull of some corners.
///
/// Three families of candidates give every distance: corners of one core against the faces and edges of the other, the
/// reverse, and edges against edges. Cores of plain numbers ([`plain`](Core3::plain)) are searched for the nearest
/// features; the core with derivatives finds these by their [`Spot`].
pub(crate) trait Core3<S: Scalar>: Copy {
    /// The core without derivatives.
    type Plain: Core3<S::Primal>;
    /// The corners, in an array.
    type Corners: AsRef<[Vec3<S>]> + Each<Vec3<S>>;
    /// The edges, in an array.
    type Edges: AsRef<[Edge<S>]> + Each<Edge<S>>;
    /// The vectors along edges, parallel ones once, in an array.
    type Ways: AsRef<[Vec3<S>]> + Each<Vec3<S>>;
    /// A number for each of its faces, in an array.
    type Faces: Each<usize>;
    /// 0 for a point, 1 for a segment, 2 for a triangle, 3 for what has a volume.
    const DIMENSION: usize;
    /// `true` if corners are computed from a centre, to which a distance from the origin would cost digits. Corners
    /// that are given lose some where they are moved.
    const CENTERED: bool = false;
    /// Returns a point of it, to which the others are relative.
    fn anchor(&self) -> Vec3<S>;
    /// Returns the largest absolute coordinate of its corners relative to a point, as a constant.
    fn extent(&self, from: Vec3<S>) -> S::Primal;
    /// Returns the core relative to a point.
    #[must_use]
    fn seen_from(self, from: Vec3<S>) -> Self;
    /// Returns the core relative to a point, in other units.
    #[must_use]
    fn placed(self, from: Vec3<S>, scale: S) -> Self;
    /// Returns the core without derivatives.
    fn plain(&self) -> Self::Plain;
    /// Returns the point at a spot, which is fixed on the core.
    fn point(&self, spot: Spot<S::Primal>) -> Vec3<S>;
    /// Returns the directions along which the feature of a spot is free, and their number; zero in place of missing
    /// ones.
    fn free(&self, spot: Spot<S::Primal>) -> ([Vec3<S>; 2], S::Primal);
    /// Returns the spot of a corner.
    fn at_corner(&self, k: usize) -> Spot<S>;
    /// Returns the spot on an edge, from 0 to 1, whose ends are not counted among its points.
    fn at_edge(&self, k: usize, t: S) -> Spot<S>;
    /// Returns the derivative of the heights of spots along a direction, less that of others.
    fn pull(&self, spot: MeanSpot<S>, less: MeanSpot<S>, normal: Vec3<S>) -> Pull<S>;
    /// Returns a height with this derivative, up to a constant.
    fn height(&self, pull: Pull<S::Primal>) -> S;
    /// Returns the corners.
    fn corners(&self) -> Self::Corners;
    /// Returns the edges.
    fn edges(&self) -> Self::Edges;
    /// Returns the vectors from end to end of edges, parallel ones once.
    fn ways(&self) -> Self::Ways;
    /// Returns the numbers of its faces.
    fn faces(&self) -> Self::Faces;
    /// Returns the point of the core, or of its surface, that is nearest to a corner of another one, at a spot there.
    fn near(&self, corner: Vec3<S>, there: Spot<S>) -> Candidate<S>;
    /// Returns the lowest edge along one of the [vectors](Core3::ways), seen along a direction orthogonal to it: for
    /// boxes by its middle, for others by its first end.
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Lowest<S>;
    /// Returns the edge on the side of a point, of edges along a direction that are equally far within rounding.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn beside(
        &self,
        lowest: Lowest<S>,
        _normal: Vec3<S>,
        _way: usize,
        _point: Vec3<S>,
    ) -> Lowest<S> {
        lowest
    }
    /// Returns the spot at a parameter along a vector from that of [`lowest`](Core3::lowest).
    fn along(&self, spot: Spot<S>, way: usize, t: S) -> Spot<S>;
    /// Returns the least of `normal · corner`, and the corner; corners that tie share the derivative, and the point is
    /// their mean.
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>);
    /// Returns the growth of the extent along a direction by sides of length zero: the value zero, with the derivative
    /// by these sides.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn growth(&self, _normal: Vec3<S>) -> S {
        S::zero()
    }
    /// Returns the core as a box, where it is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_box(&self) -> Option<BoxCore<S>> {
        None
    }
    /// Returns the core as a straight feature, where it is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn straight(&self) -> Option<Straight<S>> {
        None
    }
    /// Returns the plane along a face that separates the core from another one.
    fn parting<B: Core3<S>>(&self, face: usize, other: &B) -> PartingPlane<S>;
}

/// A box of any orientation.
#[derive(Clone, Copy, Debug)]
pub struct BoxCore<S> {
    /// A point of the box that is given: the centre, or a corner.
    pub given: Vec3<S>,
    /// The vector from there to the centre. Far from the origin their sum has fewer digits than either.
    pub arm: Vec3<S>,
    /// The centre.
    pub center: Vec3<S>,
    /// Half the size along its own axes.
    pub half: [S; 3],
    /// Half of each side of length zero, zero for all others. Corners at both ends of such a side coincide; the
    /// direction to the other shape decides which of them comes closer as the side grows.
    pub flat: [S; 3],
    /// Its own axes, of length one.
    pub axes: [Vec3<S>; 3],
}

impl<S: Scalar> BoxCore<S> {
    /// Returns the coordinates of a point along its own axes, relative to the centre.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn seen(&self, point: Vec3<S>) -> [S; 3] {
        let arm = point - self.center;
        self.axes.each_as(|axis| axis.dot(arm))
    }
}

/// Returns the largest absolute coordinate of points relative to another one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn extent_of<S: Scalar, const N: usize>(
    points: [Vec3<S>; N],
    from: Vec3<S>,
) -> S::Primal {
    let sizes = points.each_as(|p| {
        let arm = p - from;
        S::from_primal(largest([arm.x, arm.y, arm.z]))
    });
    largest(sizes)
}

/// One point.
#[derive(Clone, Copy, Debug)]
pub struct PointCore<S>(pub Vec3<S>);

impl<S: Scalar> Core3<S> for PointCore<S> {
    type Plain = PointCore<S::Primal>;
    type Corners = [Vec3<S>; 1];
    type Edges = [Edge<S>; 0];
    type Ways = [Vec3<S>; 0];
    type Faces = [usize; 0];
    const DIMENSION: usize = 0;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn straight(&self) -> Option<Straight<S>> {
        Some(Straight::point(self.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec3<S> {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec3<S>) -> S::Primal {
        extent_of([self.0], from)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn seen_from(self, from: Vec3<S>) -> Self {
        PointCore(self.0 - from)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec3<S>, scale: S) -> Self {
        PointCore((self.0 - from) * scale)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn plain(&self) -> PointCore<S::Primal> {
        PointCore(spot::plain(self.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, _: Spot<S::Primal>) -> Vec3<S> {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn free(&self, _: Spot<S::Primal>) -> ([Vec3<S>; 2], S::Primal) {
        ([Vec3::zero(); 2], S::Primal::zero())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_corner(&self, _: usize) -> Spot<S> {
        Spot::corner(0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_edge(&self, _: usize, _: S) -> Spot<S> {
        Spot::corner(0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull(&self, spot: MeanSpot<S>, less: MeanSpot<S>, normal: Vec3<S>) -> Pull<S> {
        let mut parts = [Vec3::zero(); 4];
        parts[0] = normal * (spot.part(0) - less.part(0));
        Pull {
            parts,
            half: [S::zero(); 3],
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn height(&self, pull: Pull<S::Primal>) -> S {
        fixed_vector::<S>(pull.parts[0]).dot(self.0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec3<S>; 1] {
        [self.0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn edges(&self) -> [Edge<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ways(&self) -> [Vec3<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn faces(&self) -> [usize; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corner: Vec3<S>, there: Spot<S>) -> Candidate<S> {
        let near = Nearest::of(corner - self.0, self.0, corner);
        Candidate::new(near, Spot::corner(0), there)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, _: Vec3<S>, _: usize) -> Lowest<S> {
        Lowest::edge(self.0, Spot::corner(0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn along(&self, spot: Spot<S>, _: usize, _: S) -> Spot<S> {
        spot
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>) {
        (normal.dot(self.0), self.0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parting<B: Core3<S>>(&self, _: usize, _: &B) -> PartingPlane<S> {
        PartingPlane::none()
    }
}
