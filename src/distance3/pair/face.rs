//! Two faces, or a face and an edge, that are parallel: the middle of what faces each other.
use super::super::spot::part;
use super::features::{larger, smaller, weight};
use crate::Scalar;
use crate::arrays::Each;

/// Returns the middle of what an interval about zero and one about a centre share, as a part of the first one's half.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn overlap<P: Scalar>(half: P, center: P, other: P) -> P {
    let low = larger(-half, center - other);
    let high = smaller(half, center + other);
    part((low + high).halved(), half)
}

/// A face of one box, and the other box in its frame.
pub(super) struct Facing<P> {
    /// The axes of the other box along the face's normal and its two sides.
    pub rows: [[P; 3]; 3],
    /// The centre of the other box along these sides.
    pub center: [P; 3],
    /// Half the sides of the face.
    pub half: [P; 2],
    /// Half the size of the other box.
    pub other: [P; 3],
    /// The point of the other box that is nearest to the plane of the face, or one of them, as parts of half its size.
    pub nearest: [P; 3],
}

/// A point that the face and a face of the other box may share, seen along the normal.
#[derive(Clone, Copy)]
struct SharedPoint<P> {
    /// Along both sides of the face, in the unit of length.
    at: [P; 2],
    /// Along both sides of the other face, as parts of half of them.
    other: [P; 2],
    /// Its height over the middle of the other face, plus its distance outside of either face.
    cost: P,
}

/// The middle.
pub(super) struct Middle<P: Scalar> {
    /// Along both sides of the face, in the unit of length.
    pub at: [P; 2],
    /// The corresponding point of the other box: along its axes, as parts of half its size.
    pub other: [P; 3],
    /// `true` if an edge or a face of the other box is parallel to the face.
    pub parallel: P::Mask,
}

impl<P: Scalar> Facing<P> {
    /// Returns the mean of the lowest corners of what faces each other, of those that are at most some slack higher
    /// than the lowest one: corners over the face, corners of the face below the other one, and crossings of edges.
    ///
    /// The other box has one face that is the nearest to parallel, and its lowest points are there. The cost of a
    /// corner outside the other face is its distance from that face. Rounding may leave no corner inside if shapes meet
    /// in a point or an edge.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn middle(&self, side: P, slack: P) -> Middle<P> {
        let (zero, one) = (P::zero(), P::one());
        let [normal, first, second] = self.rows;
        let free = normal.each_as(|x| x.equals(zero));
        let near = [0, 1, 2].each_as(|j| P::select(free[j], zero, self.nearest[j]));
        let tilt = normal.each_as(P::unsigned);
        let by_first = tilt[0].at_least(tilt[1]) & tilt[0].at_least(tilt[2]);
        let by_second = !by_first & tilt[1].at_least(tilt[2]);
        let pick = |x: [P; 3]| P::select(by_first, x[0], P::select(by_second, x[1], x[2]));
        let arm = |j: usize| [normal, first, second].each_as(|row| row[j] * self.other[j]);
        let arms = [arm(0), arm(1), arm(2)];
        // The face that is the nearest to parallel, and its sides.
        let base = [0, 1, 2].each_as(|k| pick([0, 1, 2].each_as(|j| arms[j][k] * near[j])));
        let sides: [[P; 3]; 2] = [1, 2]
            .each_as(|n| [0, 1, 2].each_as(|k| pick([0, 1, 2].each_as(|j| arms[(j + n) % 3][k]))));
        let q = [self.center[1] + base[1], self.center[2] + base[2]];
        let [u, v] = sides.each_as(|arm| [arm[1], arm[2]]);
        let rise = sides.each_as(|arm| side * arm[0]);
        let half = self.half;
        let most = P::largest();
        let outside = |x: P, half: P| larger(x.unsigned() - half, zero);
        let signs = [one, -one];
        // Sides of length zero are replaced by such as are across the other one.
        let point = |arm: [P; 2]| arm[0].equals(zero) & arm[1].equals(zero);
        let (no_u, no_v) = (point(u), point(v));
        let either = |mask, x: [P; 2], y: [P; 2]| [0, 1].each_as(|k| P::select(mask, x[k], y[k]));
        let wide_u = either(no_u, either(no_v, [one, zero], [v[1], -v[0]]), u);
        let wide_v = either(no_v, [-wide_u[1], wide_u[0]], v);
        let det = wide_u[0] * wide_v[1] - wide_u[1] * wide_v[0];
        let over = one.over(P::select(det.equals(zero), one, det));
        let mut all = [SharedPoint {
            at: [zero; 2],
            other: [zero; 2],
            cost: most,
        }; 24];
        let mut free_place = all.iter_mut();
        let mut add = |shared| {
            if let Some(place) = free_place.next() {
                *place = shared;
            }
        };
        for (n, arm, aside) in [(0, u, v), (1, v, u)] {
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
                        let (mut at, mut other) = ([bound; 2], [s; 2]);
                        (at[l], other[n]) = (along, part);
                        let height = rise[n] * part + rise[1 - n] * s;
                        add(SharedPoint {
                            at,
                            other,
                            cost: P::select(crosses, height, most),
                        });
                    }
                }
            }
        }
        for s in signs {
            for t in signs {
                let at = [0, 1].each_as(|k| q[k] + (u[k] * s + v[k] * t));
                let beside = larger(outside(at[0], half[0]), outside(at[1], half[1]));
                let height = rise[0] * s + rise[1] * t;
                add(SharedPoint {
                    at,
                    other: [s, t],
                    cost: height + beside,
                });
                let at = [half[0] * s, half[1] * t];
                let arm = [at[0] - q[0], at[1] - q[1]];
                let by_u = (arm[0] * wide_v[1] - arm[1] * wide_v[0]) * over;
                let by_v = (wide_u[0] * arm[1] - wide_u[1] * arm[0]) * over;
                let other = [part(by_u, one), part(by_v, one)];
                let rest = |k: usize| (arm[k] - (u[k] * other[0] + v[k] * other[1])).unsigned();
                let inside = by_u.equals(other[0]) & by_v.equals(other[1]) & !no_u & !no_v;
                let beside = P::select(inside, zero, larger(rest(0), rest(1)));
                let height = rise[0] * other[0] + rise[1] * other[1];
                add(SharedPoint {
                    at,
                    other,
                    cost: height + beside,
                });
            }
        }
        let least = all.iter().fold(most, |least, one| smaller(least, one.cost));
        let least = least + slack;
        let (mut at, mut other, mut count) = ([zero; 2], [zero; 2], zero);
        for one in &all {
            let here = weight::<P>(one.cost.at_most(least));
            count += here;
            for k in 0..2 {
                at[k] += one.at[k] * here;
                other[k] += one.other[k] * here;
            }
        }
        let count = P::select(count.equals(zero), one, count);
        let at = at.each_as(|x| x.over(count));
        let [by_u, by_v] = other.each_as(|x| part(x, count));
        // In the order of the axes.
        let sort = |own: P, next: P, last: P| {
            [
                P::select(by_first, own, P::select(by_second, last, next)),
                P::select(by_first, next, P::select(by_second, own, last)),
                P::select(by_first, last, P::select(by_second, next, own)),
            ]
        };
        Middle {
            at,
            other: sort(pick(near), by_u, by_v),
            parallel: free[0] | free[1] | free[2],
        }
    }
}
