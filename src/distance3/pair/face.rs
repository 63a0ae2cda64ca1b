//! Two faces, or a face and an edge, that are parallel: the middle of what faces each other.
use super::super::spot::part;
use super::dot;
use super::features::{larger, smaller};
use crate::Scalar;
use crate::arrays::Each;

/// The middle of what an interval about zero and one about a centre share, as a part of the first one's half.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn overlap<P: Scalar>(half: P, center: P, other: P) -> P {
    let low = larger(-half, center - other);
    let high = smaller(half, center + other);
    part((low + high).halved(), half)
}

/// A face of one box and what of the other one faces it.
pub(super) struct Facing<P> {
    /// The axes of the other box along the face's normal and its two sides.
    pub rows: [[P; 3]; 3],
    /// The centre of the other box along the same.
    pub center: [P; 3],
    /// Half the sides of the face.
    pub half: [P; 2],
    /// Half the size of the other box.
    pub other: [P; 3],
    /// The point of the other box that is nearest to the plane of the face, or one of them, as parts of half its size.
    pub nearest: [P; 3],
}

/// Points that are counted, and their sum.
#[derive(Clone, Copy)]
struct Mean<P> {
    sum: [P; 2],
    count: P,
}

impl<P: Scalar> Mean<P> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, where_: P::Mask, point: [P; 2]) {
        let one = P::select(where_, P::one(), P::zero());
        self.count += one;
        for (sum, x) in self.sum.iter_mut().zip(point) {
            *sum += x * one;
        }
    }
}

/// The middle.
pub(super) struct Middle<P: Scalar> {
    /// Along both sides of the face, in the unit of length.
    pub at: [P; 2],
    /// The same point of the other box: along its axes, as parts of half its size.
    pub other: [P; 3],
    /// `true` if an edge or a face of the other box is parallel to the face.
    pub parallel: P::Mask,
}

impl<P: Scalar> Facing<P> {
    /// The mean of the corners of what faces each other: corners over the face, corners of the face below the other
    /// one, and crossings of edges. Where rounding leaves none, the shapes meet beside each other: it is the middle of
    /// what their extents along both sides of the face share.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn middle(&self) -> Middle<P> {
        let (zero, one) = (P::zero(), P::one());
        let [normal, first, second] = self.rows;
        let free = normal.each_as(|x| x.equals(zero));
        let near = [0, 1, 2].each_as(|j| P::select(free[j], zero, self.nearest[j]));
        let at = [0, 1, 2].each_as(|j| near[j] * self.other[j]);
        let q = [
            self.center[1] + dot(first, at),
            self.center[2] + dot(second, at),
        ];
        let arms = [0, 1, 2].each_as(|j| {
            let half = P::select(free[j], self.other[j], zero);
            [first[j] * half, second[j] * half]
        });
        // At most two are not zero.
        let pick = |mask, x: [P; 2], y: [P; 2]| [0, 1].each_as(|k| P::select(mask, x[k], y[k]));
        let u = pick(free[0], arms[0], arms[1]);
        let v = pick(free[0] & free[1], arms[1], arms[2]);
        let half = self.half;
        let inside = |x: P, half: P| x.unsigned().at_most(half);
        let mut mean = Mean {
            sum: [zero; 2],
            count: zero,
        };
        let signs = [one, -one];
        // Corners over the face, and crossings of edges along `arm` with its sides.
        let det = u[0] * v[1] - u[1] * v[0];
        for (arm, aside) in [(u, v), (v, u)] {
            let over = arm.each_as(|x| one.over(P::select(x.equals(zero), one, x)));
            for s in signs {
                let from = [0, 1].each_as(|k| q[k] + aside[k] * s);
                for k in 0..2 {
                    let l = 1 - k;
                    for t in signs {
                        let bound = half[k] * t;
                        let part = (bound - from[k]) * over[k];
                        let along = from[l] + arm[l] * part;
                        let crosses = part.unsigned().below(one) & along.unsigned().below(half[l]);
                        let crosses = crosses & !arm[k].equals(zero);
                        let mut point = [bound; 2];
                        point[l] = along;
                        mean.add(crosses, point);
                    }
                }
            }
        }
        for s in signs {
            for t in signs {
                let corner = [0, 1].each_as(|k| q[k] + (u[k] * s + v[k] * t));
                let over = inside(corner[0], half[0]) & inside(corner[1], half[1]);
                mean.add(over, corner);
                let corner = [half[0] * s, half[1] * t];
                let arm = [corner[0] - q[0], corner[1] - q[1]];
                let by_u = (arm[0] * v[1] - arm[1] * v[0]).unsigned();
                let by_v = (u[0] * arm[1] - u[1] * arm[0]).unsigned();
                let size = det.unsigned();
                let below = by_u.at_most(size) & by_v.at_most(size) & !det.equals(zero);
                mean.add(below, corner);
            }
        }
        let none = mean.count.equals(zero);
        let count = P::select(none, one, mean.count);
        let beside = |k: usize| {
            let extent = u[k].unsigned() + v[k].unsigned();
            overlap(half[k], q[k], extent) * half[k]
        };
        let at = [0, 1].each_as(|k| P::select(none, beside(k), mean.sum[k].over(count)));
        let way = [at[0] - q[0], at[1] - q[1]];
        let other = [0, 1, 2].each_as(|j| {
            let along = way[0] * first[j] + way[1] * second[j];
            P::select(free[j], part(along, self.other[j]), near[j])
        });
        Middle {
            at,
            other,
            parallel: free[0] | free[1] | free[2],
        }
    }
}
