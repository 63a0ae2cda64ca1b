//! Hulls of a few corners: segments, triangles, tetrahedra.
use super::core::{Core3, extent_of};
use super::deep::{MORE, triangle_face};
use super::near::{Candidate, Edge, Low, edge_near, face_near};
use super::parting::{Lowest, PartingPlane};
use super::spot::{self, MeanSpot, Pull, Spot, fixed, fixed_vector};
use super::straight::Straight;
use crate::arrays::Each;
use crate::distance::share::{Best, Carry};
use crate::{Scalar, Vec3};

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
/// The number of the first face as a feature, after those of six edges.
const FACE: usize = 8;

/// Returns a spot in the plane of a face by shares of its corners.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn on_face<S: Scalar>(k: usize, shares: [S; 3]) -> Spot<S> {
    let mut parts = [S::zero(); 4];
    for (&corner, share) in FACES[k].iter().zip(shares) {
        parts[corner] = share;
    }
    Spot {
        parts,
        feature: S::lit((FACE + k) as f64),
    }
}

impl<S: Scalar, const C: usize, const E: usize, const F: usize> SimplexCore<S, C, E, F> {
    /// Returns the corners of a face.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn face(&self, k: usize) -> [Vec3<S>; 3] {
        [0, 1, 2].each_as(|i| self.0[FACES[k][i]])
    }
}

impl<S: Scalar, const C: usize, const E: usize, const F: usize> Core3<S>
    for SimplexCore<S, C, E, F>
{
    type Plain = SimplexCore<S::Primal, C, E, F>;
    type Corners = [Vec3<S>; C];
    type Edges = [Edge<S>; E];
    type Ways = [Vec3<S>; E];
    type Faces = [usize; F];
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
    fn plain(&self) -> SimplexCore<S::Primal, C, E, F> {
        SimplexCore(self.0.each_as(spot::plain))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, spot: Spot<S::Primal>) -> Vec3<S> {
        // Relative to a corner of the face: shares beyond a needle are large, and rounding of their sum matters.
        let last = spot.feature.equals(S::Primal::lit((FACE + 2) as f64));
        let from = match F > 2 {
            true => Vec3::select(last, self.0[1], self.0[0]),
            false => self.0[0],
        };
        let arm = |k: usize| (self.0[k] - from) * fixed::<S>(spot.parts[k]);
        let first = if F > 2 { 0 } else { 1 };
        (first..C).fold(from, |sum, k| sum + arm(k))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn free(&self, spot: Spot<S::Primal>) -> ([Vec3<S>; 2], S::Primal) {
        let (zero, one) = (S::Primal::zero(), S::Primal::one());
        let mut found = ([Vec3::zero(); 2], zero);
        let is = |feature: usize| spot.feature.equals(S::Primal::lit(feature as f64));
        for (k, edge) in self.edges().into_iter().enumerate() {
            let here = is(1 + k);
            found.0[0] = Vec3::select(here, edge.along, found.0[0]);
            found.1 = S::Primal::select(here, one, found.1);
        }
        for k in 0..F {
            let here = is(FACE + k);
            let [from, to, last] = self.face(k);
            for (found, way) in found.0.iter_mut().zip([to - from, last - from]) {
                *found = Vec3::select(here, way, *found);
            }
            found.1 = S::Primal::select(here, one + one, found.1);
        }
        found
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_corner(&self, k: usize) -> Spot<S> {
        Spot::corner(k)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_edge(&self, k: usize, t: S) -> Spot<S> {
        let mut parts = [S::zero(); 4];
        let [from, to] = EDGES[k];
        (parts[from], parts[to]) = (S::one() - t, t);
        Spot {
            parts,
            feature: S::lit((1 + k) as f64),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull(&self, spot: MeanSpot<S>, less: MeanSpot<S>, normal: Vec3<S>) -> Pull<S> {
        let mut parts = [Vec3::zero(); 4];
        for (k, pull) in parts.iter_mut().enumerate().take(C) {
            *pull = normal * (spot.part(k) - less.part(k));
        }
        Pull {
            parts,
            half: [S::zero(); 3],
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn height(&self, pull: Pull<S::Primal>) -> S {
        let corner = |k: usize| fixed_vector::<S>(pull.parts[k]).dot(self.0[k]);
        (1..C).fold(corner(0), |sum, k| sum + corner(k))
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
    fn faces(&self) -> [usize; F] {
        std::array::from_fn(|k| k)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corner: Vec3<S>, there: Spot<S>) -> Candidate<S> {
        let edge = |k: usize| {
            let [from, to] = EDGES[k];
            let (near, t, free) = edge_near(Edge::between(self.0[from], self.0[to]), corner);
            Candidate::new(near, self.at_edge(k, t).on(free, 1 + k), there)
        };
        let face = |k: usize| {
            let (near, shares, clear) = face_near(self.face(k), corner);
            Candidate::new(near, on_face(k, shares).on(clear, FACE + k), there)
        };
        let best = (1..E).fold(edge(0), |best, k| best.less(edge(k)));
        (0..F).fold(best, |best, k| best.less(face(k)))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Lowest<S> {
        let ([start, end], zero) = (EDGES[way], S::zero());
        let from = self.0[start];
        let others = (0..C).filter(|&k| k != start && k != end);
        let mut found = Lowest::edge(from, Spot::corner(start));
        let mut least = (zero, from, found.spot);
        for k in others {
            let height = normal.dot(self.0[k] - from);
            let lower = height.below(least.0);
            let none = lower & !lower;
            least = (
                S::select(lower, height, least.0),
                Vec3::select(lower, self.0[k], least.1),
                Spot::corner(k).join(least.2, lower, none),
            );
        }
        // Corners that rounding may have put below the edge leave it the lowest.
        let (rest, none) = (least.0, zero.below(zero));
        found.is_edge = rest.at_least(S::rounding(-MORE, 1));
        found.rest = S::select(found.is_edge, rest, zero);
        found.point = Vec3::select(found.is_edge, from, least.1);
        found.spot = found.spot.join(least.2, found.is_edge, none);
        found
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn along(&self, mut spot: Spot<S>, way: usize, t: S) -> Spot<S> {
        let [start, end] = EDGES[way];
        spot.parts[start] -= t;
        spot.parts[end] += t;
        spot.feature = S::lit((1 + way) as f64);
        spot
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
    fn facing(&self, toward: Vec3<S>) -> ([usize; 4], usize)
    where
        S: Scalar<Mask = bool>,
    {
        if C < 4 {
            return ([0, 1, 2, 3], C);
        }
        let facing = |k: usize| {
            let [a, b, c] = self.face(k);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let behind = normal.dot(self.0[FACES[k][3]] - a);
            let slope = normal.dot(toward);
            match behind.above(S::zero()) {
                true => -slope,
                false => slope,
            }
        };
        let mut best = 0;
        for k in 1..F {
            if facing(k).above(facing(best)) {
                best = k;
            }
        }
        (FACES[best], 3)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parting<B: Core3<S>>(&self, face: usize, other: &B) -> PartingPlane<S> {
        let behind = (C == 4).then(|| self.0[FACES[face][3]]);
        let spot = |shares: [S; 3]| on_face(face, shares);
        triangle_face(self.face(face), behind, other, spot)
    }
}
