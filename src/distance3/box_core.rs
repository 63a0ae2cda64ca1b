//! Boxes of any orientation as cores.
use super::core::{BoxCore, Core3};
use super::deep::{EQUAL, box_faces};
use super::near::{Candidate, Edge, Nearest, square_of};
use super::parting::{Lowest, PartingPlane};
use super::spot::{self, MeanSpot, Pull, Spot, fixed, fixed_vector, part};
use crate::arrays::Each;
use crate::scalar::largest;
use crate::{Scalar, Vec3};

impl<S: Scalar> BoxCore<S> {
    /// Returns the vector from a point to the centre.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn center_from(&self, from: Vec3<S>) -> Vec3<S> {
        (self.given - from) + self.arm
    }
    /// Returns the vectors from the centre to the faces.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arms(&self) -> [Vec3<S>; 3] {
        let [x, y, z] = self.axes;
        [x * self.half[0], y * self.half[1], z * self.half[2]]
    }
}

/// The corners that begin an edge along each of the three axes: its number in `corners()` without the axis' bit.
const STARTS: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];

impl<S: Scalar> Core3<S> for BoxCore<S> {
    type Plain = BoxCore<S::Primal>;
    type Corners = [Vec3<S>; 8];
    type Edges = [Edge<S>; 12];
    type Ways = [Vec3<S>; 3];
    type Faces = [usize; 3];
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
        let arm = self.center_from(from);
        let half = self.half.each_as(S::primal);
        largest([arm.x, arm.y, arm.z]) + (half[0] + half[1] + half[2])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn seen_from(self, from: Vec3<S>) -> Self {
        BoxCore {
            given: self.given - from,
            center: self.center_from(from),
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
        let center = self.center_from(from) * scale;
        BoxCore {
            given: center,
            arm: Vec3::zero(),
            center,
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
    fn plain(&self) -> BoxCore<S::Primal> {
        BoxCore {
            given: spot::plain(self.given),
            arm: spot::plain(self.arm),
            center: spot::plain(self.center),
            half: self.half.each_as(S::primal),
            flat: self.flat.each_as(S::primal),
            axes: self.axes.each_as(spot::plain),
        }
    }
    /// Returns the point of a spot; sides that the spot has at an end move with the box's size.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, spot: Spot<S::Primal>) -> Vec3<S> {
        (0..3).fold(self.center, |sum, k| {
            let at = spot.parts[1 + k];
            let part = fixed::<S>(part(at, self.half[k].primal()));
            sum + self.axes[k] * (self.half[k] * part).with_primal(at.primal())
        })
    }
    /// Returns the directions along which a spot is free; its feature has a bit for every such axis.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn free(&self, spot: Spot<S::Primal>) -> ([Vec3<S>; 2], S::Primal) {
        let lit = S::Primal::lit;
        let mut rest = spot.feature;
        let mut found = ([Vec3::zero(); 2], S::Primal::zero());
        for k in [2, 1, 0] {
            let bit = lit((1 << k) as f64);
            let here = rest.at_least(bit);
            rest = S::Primal::select(here, rest - bit, rest);
            found.0[1] = Vec3::select(here, found.0[0], found.0[1]);
            found.0[0] = Vec3::select(here, self.axes[k], found.0[0]);
            found.1 += S::Primal::select(here, lit(1.0), lit(0.0));
        }
        found
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_corner(&self, n: usize) -> Spot<S> {
        let side = |k: usize| {
            if n >> k & 1 == 1 {
                self.half[k]
            } else {
                -self.half[k]
            }
        };
        Spot {
            parts: [S::one(), side(0), side(1), side(2)],
            feature: S::zero(),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_edge(&self, k: usize, t: S) -> Spot<S> {
        let axis = k / 4;
        let mut spot = self.at_corner(STARTS[axis][k % 4]);
        spot.parts[1 + axis] = self.half[axis] * ((t + t) - S::one());
        spot.feature = S::lit((1 << axis) as f64);
        spot
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull(&self, spot: MeanSpot<S>, less: MeanSpot<S>, normal: Vec3<S>) -> Pull<S> {
        Pull {
            parts: [0, 1, 2, 3].each_as(|k| normal * (spot.part(k) - less.part(k))),
            half: [0, 1, 2].each_as(|k| {
                let part = |all: MeanSpot<S>| part(all.spot.parts[1 + k], self.half[k]) * all.count;
                normal.dot(self.axes[k]) * (part(spot) - part(less))
            }),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn height(&self, pull: Pull<S::Primal>) -> S {
        let [x, y, z] = self.axes;
        let mut sum = S::zero();
        for (pull, vector) in pull.parts.into_iter().zip([self.center, x, y, z]) {
            sum += fixed_vector::<S>(pull).dot(vector);
        }
        for (pull, half) in pull.half.into_iter().zip(self.half) {
            sum += half * fixed::<S>(pull);
        }
        sum
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
    fn faces(&self) -> [usize; 3] {
        [0, 1, 2]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corner: Vec3<S>, there: Spot<S>) -> Candidate<S> {
        let (zero, at) = (S::zero(), self.seen(corner));
        let out: [S; 3] = std::array::from_fn(|k| {
            let (x, half) = (at[k], self.half[k]);
            let beyond = x.magnitude() - half;
            S::select(beyond.above(zero), beyond.signed_as(x), zero)
        });
        let [x, y, z] = self.axes;
        let apart = x * out[0] + y * out[1] + z * out[2];
        let within = out.each_as(|out| out.equals(zero));
        let spot = |k: usize| S::select(within[k], at[k], self.half[k].signed_as(at[k]));
        let bit = |k: usize| S::select(within[k], S::lit((1 << k) as f64), zero);
        let here = Spot {
            parts: [S::one(), spot(0), spot(1), spot(2)],
            feature: bit(0) + bit(1) + bit(2),
        };
        let near = Nearest::of(apart, corner - apart, corner);
        Candidate {
            square: square_of(out),
            ..Candidate::new(near, here, there)
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec3<S>, way: usize) -> Lowest<S> {
        let arms = self.arms();
        let (mut point, mut spot) = (self.center, Spot::corner(0));
        for k in (0..3).filter(|&k| k != way) {
            let up = normal.dot(arms[k]).above(S::zero());
            point += Vec3::select(up, -arms[k], arms[k]);
            spot.parts[1 + k] = S::select(up, -self.half[k], self.half[k]);
        }
        Lowest::edge(point, spot)
    }
    /// Moves the lowest edge to the side of a point. Two edges are equally far along a face's normal: a segment across
    /// the face crosses it near that side, or crosses an edge along the other axis.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn beside(&self, lowest: Lowest<S>, normal: Vec3<S>, way: usize, point: Vec3<S>) -> Lowest<S> {
        let (arms, at, zero) = (self.arms(), self.seen(point), S::zero());
        let mut found = lowest;
        for k in (0..3).filter(|&k| k != way) {
            let rise = normal.dot(arms[k]).magnitude();
            let here = lowest.spot.parts[1 + k];
            let side = S::one().signed_as(here);
            let turn = (at[k] * side).below(zero) & rise.at_most(S::rounding(EQUAL, 1));
            let step = arms[k] * (side + side);
            found.point -= Vec3::select(turn, step, Vec3::zero());
            found.spot.parts[1 + k] = S::select(turn, -here, here);
            found.rest -= S::select(turn, rise + rise, zero);
        }
        found
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn along(&self, mut spot: Spot<S>, way: usize, t: S) -> Spot<S> {
        let half = self.half[way];
        spot.parts[1 + way] += (half + half) * t;
        spot.feature = S::lit((1 << way) as f64);
        spot
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn support(&self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (zero, mut found) = (S::zero(), (normal.dot(self.arm), self.arm));
        for k in 0..3 {
            let slope = normal.dot(self.axes[k]);
            let side = S::select(slope.equals(zero), zero, S::one().signed_as(slope));
            found.0 -= slope.magnitude() * self.half[k];
            found.1 -= self.axes[k] * (self.half[k] * side);
        }
        (normal.dot(self.given) + found.0, self.given + found.1)
    }
    fn facing(&self, toward: Vec3<S>) -> ([usize; 4], usize)
    where
        S: Scalar<Mask = bool>,
    {
        let slopes = self.axes.each_as(|axis| axis.dot(toward));
        let steeper = |k: usize, i: usize| slopes[i].unsigned().above(slopes[k].unsigned());
        let first = if steeper(0, 1) { 1 } else { 0 };
        let k = if steeper(first, 2) { 2 } else { first };
        let side = usize::from(slopes[k].above(S::zero())) << k;
        let [i, j] = [1 << ((k + 1) % 3), 1 << ((k + 2) % 3)];
        ([side, side | i, side | i | j, side | j], 4)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parting<B: Core3<S>>(&self, face: usize, other: &B) -> PartingPlane<S> {
        box_faces(self, face, other)
    }
}
