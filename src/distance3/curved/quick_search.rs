//! The touch of two solids that are clearly apart, or overlap clearly, where it is regular: most of them.
//!
//! An iteration by supports says after a few steps which pieces are near. Newton's step on these converges by the square;
//! where it does not, the iteration goes on. The same proof as of other searches decides: the gap of the supports along
//! the normal is the distance of two points of the solids. Solids that are apart have one least distance, so that it does
//! not matter how its place was guessed. Solids that overlap have other directions, too: an expansion bounds their depth,
//! and directions beside the touch and around the axes are tried, as in the full search.
use super::super::gjk::{CodedDifference, gap_until, of_triangle};
use super::super::mix::Mix;
use super::bend::{FEW, across, moved, step};
use super::expand::exits;
use super::piece::Place;
use super::solid_pair::{Found, Solids};
use super::touch::{Constants, Touch};
use crate::Vec3;

/// The relative gaps of both bounds of the squared distance at which Newton's steps are tried.
const TRIES: [f64; 3] = [5e-2, 1e-3, 1e-5];
/// The number of Newton's steps of a try.
const STEPS: usize = 6;
/// The length of the last step, whose square is none.
const LAST: f64 = 1e-7;
/// The error up to which a touch is exact, relative to the size.
const EXACT: f64 = 1e-13;
/// The distance above which solids are clearly apart, and the depth of those that clearly overlap, relative to the size.
const APART: f64 = 1e-6;

/// Returns by how much clamping has moved a place.
fn shift(p: &Place<f64>, q: &Place<f64>) -> f64 {
    (p.y[0] - q.y[0]).abs() + (p.y[1] - q.y[1]).abs() + (p.s - q.s).abs()
}

impl Solids<'_> {
    /// Returns the touch to which Newton's steps lead from a normal and the pieces that points are on whose weighted mean is
    /// the nearest one, if it is proved, and the constants of its replay. In the last try less likely pieces count, too.
    fn guessed<'d>(
        &self,
        normal: Vec3<f64>,
        weighted: impl Iterator<Item = (&'d CodedDifference, f64)>,
        side: f64,
        is_last: bool,
    ) -> Option<(Found, Constants<FEW>)> {
        let mut mixes = [Mix::default(); 2];
        let (mut on_a, mut way) = (Vec3::zero(), Vec3::zero());
        for (corner, weight) in weighted {
            mixes[0].add(corner.codes[0] as usize, weight);
            mixes[1].add(corner.codes[1] as usize, weight);
            on_a += corner.a * weight;
            way += corner.way * weight;
        }
        let attempt = |of_a: Option<(usize, Place<f64>)>, of_b: Option<(usize, Place<f64>)>| {
            let ((i, a), (j, b)) = (of_a?, of_b?);
            self.stepped([i, j], Touch { normal, a, b }, side)
        };
        let of_a = self.a.likely(&mixes[0], on_a, normal);
        let of_b = self.b.likely(&mixes[1], on_a + way, -normal);
        let found = attempt(of_a, of_b);
        if found.is_some() || !is_last {
            return found;
        }
        let or_a = self.a.less_likely(&mixes[0], on_a, normal);
        let or_b = self.b.less_likely(&mixes[1], on_a + way, -normal);
        attempt(or_a, of_b)
            .or_else(|| attempt(of_a, or_b))
            .or_else(|| attempt(or_a, or_b))
    }
    /// Returns the touch of two pieces to which Newton's steps lead from a first one, if it is proved, and the constants of its
    /// replay.
    fn stepped(
        &self,
        [i, j]: [usize; 2],
        mut touch: Touch<f64>,
        side: f64,
    ) -> Option<(Found, Constants<FEW>)> {
        for _ in 0..STEPS {
            let normal = touch.normal;
            let across = across(normal);
            let of_a = self.a.bend(i, &touch.a, normal, &across);
            let of_b = self.b.bend(j, &touch.b, -normal, &across);
            let bends = [&of_a, &of_b];
            let (pair, changes) = step(bends, normal, across)?;
            let square = changes.iter().map(|x| x * x).sum::<f64>();
            if !square.is_finite() {
                return None;
            }
            let limited = match square > 0.25 {
                true => changes.map(|x| x * (0.5 / square.sqrt())),
                false => changes,
            };
            let shares = bends.map(|bend| bend.shares);
            touch = moved(&touch, &across, shares, limited);
            if square <= LAST * LAST {
                let found = self.proved([i, j], shares, &touch, side)?;
                return Some((found, pair.constants(bends)));
            }
        }
        None
    }
    /// Returns the touch of two pieces of some dimensions with its value, if that is proved, and clear, with the sign of a
    /// side, and no other points are as near along its normal.
    fn proved(
        &self,
        pieces: [usize; 2],
        own: [usize; 2],
        touch: &Touch<f64>,
        side: f64,
    ) -> Option<Found> {
        let normal = touch.normal;
        let value = self.value(normal);
        let on = Touch {
            normal,
            a: self.a.clamped(pieces[0], &touch.a),
            b: self.b.clamped(pieces[1], &touch.b),
        };
        let [i, j] = pieces;
        let a = self.a.point(i, &on.a, normal);
        let b = self.b.point(j, &on.b, -normal);
        let error = ((b - a) - normal * value).length_squared().sqrt();
        let off = shift(&touch.a, &on.a) + shift(&touch.b, &on.b);
        let clear = value * side > APART * self.size;
        let exact = error <= EXACT * self.size && clear && off <= LAST * LAST;
        if !exact {
            return None;
        }
        let slack = EXACT * self.size;
        let flat = [
            self.a.flatness(normal, slack),
            self.b.flatness(-normal, slack),
        ];
        let level = flat[0] > 0 && flat[1] > 0 && flat != own;
        let plain = self.a.is_plain(normal, own[0]) && self.b.is_plain(-normal, own[1]);
        // Newton's steps may have turned the normal to where a flat ellipsoid or a needle jumps from end to end.
        let steady = self.a.is_steady(i, normal) && self.b.is_steady(j, -normal);
        (steady && plain && !level).then_some(Found {
            pieces,
            touch: on,
            value,
            error,
            regular: true,
            settled: true,
        })
    }
    /// Returns the point of b less a that is the lowest along a vector, with codes.
    pub(super) fn lowest_coded(&self, way: Vec3<f64>) -> CodedDifference {
        let ((a, of_a), (b, of_b)) = (self.a.coded(way), self.b.coded(-way));
        CodedDifference {
            way: b - a,
            a,
            codes: [of_a as u32, of_b as u32],
        }
    }
    /// Returns the touch of solids that are clearly apart or overlap clearly, and the constants of its replay, if it is found at
    /// once.
    pub fn quick(&self) -> Option<(Found, Constants<FEW>)> {
        let way = self.b.middle() - self.a.middle();
        let length = way.length();
        let is_apart = length > APART * self.size;
        if !is_apart {
            return None;
        }
        let start = self.lowest_coded(way);
        let (mut found, mut tried) = (None, 0);
        let least = way.dot(start.way) / length;
        let seen = gap_until(
            |way| self.lowest_coded(way),
            start,
            least,
            |gap, off| {
                let due = tried < TRIES.len() && off <= TRIES[tried] && gap.least > 0.0;
                if due {
                    while tried < TRIES.len() && off <= TRIES[tried] {
                        tried += 1;
                    }
                    let normal = gap.way * (1.0 / gap.way.length_squared().sqrt());
                    found = self.guessed(normal, gap.weighted(), 1.0, tried == TRIES.len());
                }
                found.is_some() || tried == TRIES.len()
            },
        );
        match seen.inside {
            true => self.quick_overlap(),
            false => found,
        }
    }
    /// Returns the touch of solids that clearly overlap, and the constants of its replay, if it is found at once and no other
    /// direction is better.
    fn quick_overlap(&self) -> Option<(Found, Constants<FEW>)> {
        let exits = exits(&|way| self.lowest_coded(way));
        let (best, corners) = (exits.all[0], exits.face?);
        let (weights, _) = of_triangle(corners.map(|corner| corner.way));
        let weighted = corners.iter().zip(weights);
        let weighted = weighted.filter(|(_, weight)| *weight > 0.0);
        let (found, constants) = self.guessed(best.normal, weighted, -1.0, true)?;
        let depth = -found.value;
        let deepest = depth <= best.depth + EXACT * self.size;
        let alone = exits.all[1..].iter().all(|exit| exit.depth >= depth);
        let none_better = || {
            let round = self.a.may_be_round() && self.b.may_be_round();
            let around = || round.then(|| self.around(&found))?;
            self.better(&found).or_else(around).is_none()
        };
        (deepest && alone && none_better()).then_some((found, constants))
    }
}
