//! The cores that convex shapes of space are made of: a point, a segment, a triangle, a tetrahedron, a box.
use super::deep::{PartingPlane, box_faces, triangle_face};
use super::near::{Edge, Low, Nearest, edge_near, face_near, square_of};
use super::straight::Straight;
use crate::arrays::Each;
use crate::distance::share::Best;
use crate::scalar::largest;
use crate::{Scalar, Vec3};

/// The core of a convex shape of space: the hull of some corners.
///
/// Three families of candidates make every distance: corners of one core against the faces and edges of the other,
/// the same the other way round, and edges against edges.
pub trait Core<S: Scalar>: Copy {
    /// The corners, in an array.
    type Corners: AsRef<[Vec3<S>]>;
    /// The edges, in an array.
    type Edges: AsRef<[Edge<S>]>;
    /// The ways along edges, parallel ones once, in an array.
    type Ways: AsRef<[Vec3<S>]>;
    /// 0 for a point, 1 for a segment, 2 for a triangle, 3 for what has a volume.
    const DIMENSION: usize;
    /// `true` if corners are computed from a centre, to which a distance from the origin would cost digits. Corners
    /// that are given lose some where they are moved.
    const CENTERED: bool = false;
    /// A point of it, from which the others are seen.
    fn anchor(&self) -> Vec3<S>;
    /// How far its corners are from a point at most, coordinate by coordinate, as a constant.
    fn extent(&self, from: Vec3<S>) -> S::Primal;
    /// The core seen from a point.
    #[must_use]
    fn seen_from(self, from: Vec3<S>) -> Self;
    /// The core seen from a point, in other units.
    #[must_use]
    fn placed(self, from: Vec3<S>, scale: S) -> Self;
    /// The corners.
    fn corners(&self) -> Self::Corners;
    /// The edges.
    fn edges(&self) -> Self::Edges;
    /// The ways from end to end of edges, parallel ones once.
    fn ways(&self) -> Self::Ways;
    /// The point of the core, or of its surface, that is nearest to one of some corners.
    fn near(&self, corners: &[Vec3<S>]) -> Best<S, Nearest<S>>;
    /// A point of the edge that is farthest against a direction, given that this is orthogonal to one of the
    /// [ways](Core::ways): of both ends of an edge along it one counts, lest rounding decides between them.
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Vec3<S>;
    /// The least of `normal · corner`, and the corner; corners that tie share the derivative, and the point is their
    /// mean.
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>);
    /// How much closer sides of length zero come along a direction as they grow: zero, with that derivative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn growth(&self, _normal: Vec3<S>) -> S {
        S::zero()
    }
    /// The core as a box, where it is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_box(&self) -> Option<BoxCore<S>> {
        None
    }
    /// The core as a straight feature, where it is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn straight(&self) -> Option<Straight<S>> {
        None
    }
    /// The face that parts the core best from some corners; `None` where it has no faces.
    fn deep(&self, corners: &[Vec3<S>]) -> Option<PartingPlane<S>>;
}

/// The lower of two points, seen from the first of some.
#[cfg_attr(not(debug_assertions), inline(always))]
fn lower<S: Scalar>(normal: Vec3<S>, from: Vec3<S>, one: Vec3<S>, other: Vec3<S>) -> Vec3<S> {
    let height = |point: Vec3<S>| normal.dot(point - from);
    Vec3::select(height(other).below(height(one)), other, one)
}

/// How far points are from another one at most.
#[cfg_attr(not(debug_assertions), inline(always))]
fn extent_of<S: Scalar, const N: usize>(points: [Vec3<S>; N], from: Vec3<S>) -> S::Primal {
    let sizes = points.each_as(|p| {
        let arm = p - from;
        S::from_primal(largest([arm.x, arm.y, arm.z]))
    });
    largest(sizes)
}

/// One point.
#[derive(Clone, Copy, Debug)]
pub struct PointCore<S>(pub Vec3<S>);

impl<S: Scalar> Core<S> for PointCore<S> {
    type Corners = [Vec3<S>; 1];
    type Edges = [Edge<S>; 0];
    type Ways = [Vec3<S>; 0];
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
    fn near(&self, corners: &[Vec3<S>]) -> Best<S, Nearest<S>> {
        Best::least(
            corners
                .iter()
                .map(|&corner| Nearest::of(corner - self.0, self.0, corner)),
        )
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, _: Vec3<S>, _: usize) -> Vec3<S> {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>) {
        (normal.dot(self.0), self.0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep(&self, _: &[Vec3<S>]) -> Option<PartingPlane<S>> {
        None
    }
}

/// The hull of `C` corners with `E` edges and `F` triangles as faces: a segment, a triangle or a tetrahedron.
#[derive(Clone, Copy, Debug)]
pub struct SimplexCore<S, const C: usize, const E: usize, const F: usize>(pub [Vec3<S>; C]);

/// A segment.
pub type SegmentCore<S> = SimplexCore<S, 2, 1, 0>;
/// A triangle, which has two sides.
pub type TriangleCore<S> = SimplexCore<S, 3, 3, 1>;
/// A tetrahedron.
pub type TetrahedronCore<S> = SimplexCore<S, 4, 6, 4>;

/// The corners of edges: of a segment the first, of a triangle the first three.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
/// The corners of faces, and the corner that is not in it: of a triangle the first face.
const FACES: [[usize; 4]; 4] = [[0, 1, 2, 3], [0, 3, 1, 2], [1, 3, 2, 0], [2, 3, 0, 1]];

impl<S: Scalar, const C: usize, const E: usize, const F: usize> SimplexCore<S, C, E, F> {
    /// The corners of a face.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn face(&self, k: usize) -> [Vec3<S>; 3] {
        [0, 1, 2].each_as(|i| self.0[FACES[k][i]])
    }
}

impl<S: Scalar, const C: usize, const E: usize, const F: usize> Core<S>
    for SimplexCore<S, C, E, F>
{
    type Corners = [Vec3<S>; C];
    type Edges = [Edge<S>; E];
    type Ways = [Vec3<S>; E];
    const DIMENSION: usize = C - 1;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn straight(&self) -> Option<Straight<S>> {
        (C == 2).then(|| Straight::segment([self.0[0], self.0[C - 1]]))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec3<S> {
        self.0[0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec3<S>) -> S::Primal {
        extent_of(self.0, from)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn seen_from(self, from: Vec3<S>) -> Self {
        SimplexCore(self.0.each_as(|corner| corner - from))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec3<S>, scale: S) -> Self {
        SimplexCore(self.0.each_as(|corner| (corner - from) * scale))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec3<S>; C] {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn edges(&self) -> [Edge<S>; E] {
        std::array::from_fn(|k| {
            let [i, j] = EDGES[k];
            Edge::between(self.0[i], self.0[j])
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ways(&self) -> [Vec3<S>; E] {
        self.edges().each_as(|edge| edge.along)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec3<S>]) -> Best<S, Nearest<S>> {
        Best::least(corners.iter().map(|&corner| {
            let edges = self.edges().each_as(|edge| edge_near(edge, corner));
            let mut best = Best::least(edges.into_iter());
            for k in 0..F {
                best = best.less(face_near(self.face(k), corner));
            }
            best
        }))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Vec3<S> {
        let [start, end] = EDGES[way];
        let others = (0..C).filter(|&k| k != start && k != end);
        others.fold(self.0[start], |low, k| {
            lower(normal, self.0[0], low, self.0[k])
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let from = self.0[0];
        let arms = self.0.iter().map(|&corner| {
            let arm = corner - from;
            let height = normal.dot(arm);
            Best::of(height, Low(height, arm))
        });
        let Low(height, arm) = Best::least(arms).mean();
        (normal.dot(from) + height, from + arm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep(&self, corners: &[Vec3<S>]) -> Option<PartingPlane<S>> {
        let mut best = None;
        for (k, ends) in FACES.iter().enumerate().take(F) {
            let behind = (C == 4).then(|| self.0[ends[3]]);
            let face = triangle_face(self.face(k), behind, corners);
            best = Some(best.map_or(face, |best: PartingPlane<S>| best.most(face)));
        }
        best
    }
}

/// A box of any orientation.
#[derive(Clone, Copy, Debug)]
pub struct BoxCore<S> {
    /// The centre.
    pub center: Vec3<S>,
    /// Half the size along its own axes.
    pub half: [S; 3],
    /// The same of sides of length zero, zero of all others. Corners at both ends of such a side are one place: which
    /// of them comes closer as it grows only the direction to the other shape tells.
    pub flat: [S; 3],
    /// Its own axes, of length one.
    pub axes: [Vec3<S>; 3],
}

impl<S: Scalar> BoxCore<S> {
    /// A point as its own axes see it, from the centre.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn seen(&self, point: Vec3<S>) -> [S; 3] {
        let arm = point - self.center;
        self.axes.each_as(|axis| axis.dot(arm))
    }
    /// The ways from the centre to the faces.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arms(&self) -> [Vec3<S>; 3] {
        let [x, y, z] = self.axes;
        [x * self.half[0], y * self.half[1], z * self.half[2]]
    }
}

/// The corners that begin an edge along each of the three axes: its number in `corners()` without the axis' bit.
const STARTS: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];

impl<S: Scalar> Core<S> for BoxCore<S> {
    type Corners = [Vec3<S>; 8];
    type Edges = [Edge<S>; 12];
    type Ways = [Vec3<S>; 3];
    const DIMENSION: usize = 3;
    const CENTERED: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_box(&self) -> Option<BoxCore<S>> {
        Some(*self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec3<S> {
        self.center
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec3<S>) -> S::Primal {
        let arm = self.center - from;
        let half = self.half.each_as(S::primal);
        largest([arm.x, arm.y, arm.z]) + (half[0] + half[1] + half[2])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn seen_from(self, from: Vec3<S>) -> Self {
        BoxCore {
            center: self.center - from,
            ..self
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec3<S>, scale: S) -> Self {
        let zero = S::zero();
        let sides = self.half.each_as(|half| {
            let (half, flat) = (half * scale, half.equals(zero));
            (S::select(flat, zero, half), S::select(flat, half, zero))
        });
        BoxCore {
            center: (self.center - from) * scale,
            half: sides.each_as(|(half, _)| half),
            flat: sides.each_as(|(_, flat)| flat),
            axes: self.axes,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn growth(&self, normal: Vec3<S>) -> S {
        let along = |k: usize| normal.dot(self.axes[k]).magnitude() * self.flat[k];
        along(0) + along(1) + along(2)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec3<S>; 8] {
        let ([x, y, z], c) = (self.arms(), self.center);
        let (low, high) = (c - z, c + z);
        let [a, b, c, d] = [low - y, low + y, high - y, high + y];
        [a - x, a + x, b - x, b + x, c - x, c + x, d - x, d + x]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn edges(&self) -> [Edge<S>; 12] {
        let (corners, ways) = (self.corners(), self.ways());
        std::array::from_fn(|k| {
            let (axis, start) = (k / 4, STARTS[k / 4][k % 4]);
            Edge {
                from: corners[start],
                to: corners[start + (1 << axis)],
                along: ways[axis],
            }
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ways(&self) -> [Vec3<S>; 3] {
        self.arms().each_as(|arm| arm + arm)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec3<S>]) -> Best<S, Nearest<S>> {
        Best::least(corners.iter().map(|&corner| {
            let at = self.seen(corner);
            let out: [S; 3] = std::array::from_fn(|k| {
                let (x, half) = (at[k], self.half[k]);
                let beyond = x.magnitude() - half;
                S::select(beyond.above(S::zero()), beyond.signed_as(x), S::zero())
            });
            let [x, y, z] = self.axes;
            let apart = x * out[0] + y * out[1] + z * out[2];
            Best {
                value: square_of(out),
                ..Nearest::of(apart, corner - apart, corner)
            }
        }))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Vec3<S> {
        let arms = self.arms();
        let others = (0..3).filter(|&k| k != way);
        others.fold(self.center, |at, k| {
            let up = normal.dot(arms[k]).above(S::zero());
            at + Vec3::select(up, -arms[k], arms[k])
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (zero, mut found) = (S::zero(), (normal.dot(self.center), self.center));
        for k in 0..3 {
            let slope = normal.dot(self.axes[k]);
            let side = S::select(slope.equals(zero), zero, S::one().signed_as(slope));
            found.0 -= slope.magnitude() * self.half[k];
            found.1 -= self.axes[k] * (self.half[k] * side);
        }
        found
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep(&self, corners: &[Vec3<S>]) -> Option<PartingPlane<S>> {
        Some(box_faces(self, corners))
    }
}
