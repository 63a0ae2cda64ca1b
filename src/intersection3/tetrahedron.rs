//! The range of a line inside a tetrahedron, thin and flat ones included.
//!
//! Seen along the line, the corners are points of a plane and the line is its origin. The areas that the origin spans
//! with the six edges decide which faces the line meets; faces share them, so that no line passes between two, however
//! thin the solid is. Platis, Theoharis, Fast ray-tetrahedron intersection using Plücker coordinates, 2003.
use super::inside::{Beam, Border, Inside, sized};
use super::planes::triple_terms;
use crate::arrays::Each;
use crate::distance::share::Best;
use crate::distance3::near::size_of;
use crate::scalar::largest;
use crate::shape::Tetrahedron;
use crate::{Scalar, Vec3};

/// The corners of the faces, as of [`Tetrahedron::faces`].
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
/// The corners of the edges.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// A line meets a face if the point by the face's weights is within this number of roundings of the line.
const BESIDE: f64 = 16.0;

/// The corners as seen along a line.
struct Sight<S: Scalar> {
    /// The inner product of each corner with the direction.
    ahead: [S; 4],
    /// The cross product of the direction with each corner.
    aside: [Vec3<S>; 4],
    /// The area that the line spans with each edge, times the square of the direction; zero if it is within rounding.
    spans: [S; 6],
    /// These areas without rounding small ones to zero.
    raw: [S::Primal; 6],
    /// The largest rounding error of a corner on the line.
    slack: S::Primal,
}

impl<S: Scalar> Sight<S> {
    #[inline(always)]
    fn new(beam: Beam<S>, corners: [Vec3<S>; 4]) -> Self {
        let along = beam.along;
        let arms = corners.each_as(|corner| corner - beam.from);
        let aside = arms.each_as(|arm| along.cross(arm));
        let mut spans = EDGES.each_as(|[i, j]| along.dot(aside[i].cross(aside[j])));
        // Three roundings of a corner's coordinates and two of its product, times four for safety.
        let sizes = arms.each_as(|arm| S::from_primal(size_of(arm)));
        let length = size_of(along);
        let slack = largest(sizes) * length * S::Primal::rounding(8.0, 1);
        let wide = aside.each_as(size_of);
        let raw = spans.each_as(S::primal);
        for (k, [i, j]) in EDGES.into_iter().enumerate() {
            let (least, value) = (slack * length * (wide[i] + wide[j]), spans[k].primal());
            let zero = value.magnitude().at_most(least);
            spans[k] = spans[k].with_primal(S::Primal::select(zero, S::Primal::zero(), value));
        }
        Sight {
            ahead: arms.each_as(|arm| along.dot(arm)),
            aside,
            spans,
            raw,
            slack,
        }
    }
}

/// Returns the edges of a face, each opposite to a corner.
#[inline(always)]
fn around([i, j, k]: [usize; 3]) -> [[usize; 2]; 3] {
    [[j, k], [k, i], [i, j]]
}

/// Returns a number of an edge from one corner to another, which changes its sign with the direction.
#[inline(always)]
fn of_edge<S: Scalar>(numbers: [S; 6], from: usize, to: usize) -> S {
    // Edges are in the order of their corners.
    let at = |low: usize, high: usize| [0, 2, 3][low] + high - 1;
    match from < to {
        true => numbers[at(from, to)],
        false => -numbers[at(to, from)],
    }
}

/// Faces that a line meets in one point: the sum of the points, the normal of the first one, and their number.
struct FacesHit<S: Scalar> {
    place: S,
    normal: Vec3<S>,
    count: S,
}

impl<S: Scalar> FacesHit<S> {
    #[inline(always)]
    fn none() -> Self {
        FacesHit {
            place: S::zero(),
            normal: Vec3::zero(),
            count: S::zero(),
        }
    }
    #[inline(always)]
    fn join(self, is_met: S::Mask, place: S, normal: Vec3<S>) -> Self {
        let first = is_met & self.count.equals(S::zero());
        FacesHit {
            place: self.place + S::select(is_met, place, S::zero()),
            normal: Vec3::select(first, normal, self.normal),
            count: self.count + S::select(is_met, S::one(), S::zero()),
        }
    }
    #[inline(always)]
    fn is_some(&self) -> S::Mask {
        self.count.above(S::zero())
    }
    /// Returns the mean of the points.
    #[inline(always)]
    fn mean(&self) -> S {
        self.place.over(self.count.most(S::one()))
    }
}

/// Returns the range inside a tetrahedron, given its corners relative to the beam's anchor.
#[inline]
pub(super) fn in_tetrahedron<S: Scalar>(beam: Beam<S>, corners: [Vec3<S>; 4]) -> Inside<S> {
    let sight = Sight::new(beam, corners);
    let [a, b, c, d] = corners;
    let normals = Tetrahedron::new(a, b, c, d)
        .faces()
        .each_as(|face| sized(face.twice_area_normal()));
    let (zero, one) = (S::zero(), S::one());
    // By the side of them that faces the line: by spans without those within rounding; of those faces only the ones
    // that all digits agree on, if there are any, so that only exact ties are shared.
    let nothing = S::Primal::zero();
    let never = one.below(zero);
    let (mut lows, mut highs) = ([never; 4], [never; 4]);
    let (mut raw_lows, mut raw_highs) = ([never; 4], [never; 4]);
    for (face, pairs) in FACES.each_as(around).into_iter().enumerate() {
        let weights = pairs.each_as(|[from, to]| of_edge(sight.spans, from, to));
        let raw = pairs.each_as(|[from, to]| of_edge(sight.raw, from, to));
        let any = |is: fn(S, S) -> S::Mask| {
            is(weights[0], zero) | is(weights[1], zero) | is(weights[2], zero)
        };
        let no = |is: fn(S::Primal, S::Primal) -> S::Mask| {
            !(is(raw[0], nothing) | is(raw[1], nothing) | is(raw[2], nothing))
        };
        let (low, high) = (any(S::below), any(S::above));
        // The point is the mean of the corners by their weights. For a face that is seen edge-on or has no area the
        // weights are rounding, and the point is off the line.
        let of = FACES[face].each_as(|corner| sight.aside[corner]);
        let plain = weights.each_as(|weight| S::from_primal(weight.primal()));
        let weighted = (of[0] * plain[0] + of[1] * plain[1]) + of[2] * plain[2];
        let all = weights.each_as(|weight| weight.primal().unsigned());
        let bound = (all[0] + all[1] + all[2]) * sight.slack * S::Primal::lit(BESIDE);
        let is_there = size_of(weighted).at_most(bound);
        (lows[face], highs[face]) = (low & !high & is_there, high & !low & is_there);
        raw_lows[face] = lows[face] & no(S::Primal::above);
        raw_highs[face] = highs[face] & no(S::Primal::below);
    }
    let some = |masks: [S::Mask; 4]| masks[0] | masks[1] | masks[2] | masks[3];
    let (raw_low, raw_high) = (some(raw_lows), some(raw_highs));
    let (mut against, mut with) = (FacesHit::<S>::none(), FacesHit::<S>::none());
    for (face, [i, j, k]) in FACES.into_iter().enumerate() {
        let weights = around([i, j, k]).each_as(|[from, to]| of_edge(sight.spans, from, to));
        let met = lows[face] | highs[face];
        let area = (weights[0] + weights[1]) + weights[2];
        let sum = (weights[0] * sight.ahead[i] + weights[1] * sight.ahead[j])
            + weights[2] * sight.ahead[k];
        let place = sum.over(S::select(met, area, one));
        let low = raw_lows[face] | lows[face] & !raw_low;
        let high = raw_highs[face] | highs[face] & !raw_high;
        against = against.join(low, place, normals[face]);
        with = with.join(high, place, normals[face]);
    }
    let both = against.is_some() & with.is_some();
    // The chord of a flat solid is one point, which is on all faces.
    let (low, high) = (against.mean(), with.mean());
    let pick = |mask: S::Mask, yes: S, no: S| S::select(mask, yes, no);
    let length = S::from_primal(size_of(beam.along));
    let fine = S::from_primal(sight.slack) * length;
    let [b, c, d] = [b, c, d].each_as(|corner| corner - a);
    let least = triple_terms(b, c, d) * S::rounding(1.0, 1);
    let touch = b.cross(c).dot(d).magnitude().at_most(least);
    let all = (against.place + with.place).over((against.count + with.count).most(one));
    let turned = high.below(low);
    let enter = pick(touch, all, pick(turned, high, low));
    let exit = pick(touch, all, pick(turned, low, high));
    let enter_normal = Vec3::select(turned, -with.normal, against.normal);
    let exit_normal = Vec3::select(turned, -against.normal, with.normal);
    // Without faces on both sides it is seen edge-on: as a segment or a point; a chord between edges is a point of the
    // face that is met.
    let edges = edges_met(&sight);
    let no_edge = edges.1.value.below(edges.0.value);
    let alone =
        no_edge & (against.is_some() & !with.is_some() | with.is_some() & !against.is_some());
    let enter = pick(alone, all, enter);
    let exit = pick(alone, all, exit);
    let square = beam.along.length_squared();
    let still = square.at_most(zero);
    let safe = S::select(still, one, square);
    let border = |face: S, normal: Vec3<S>, edge: S| {
        let place = S::select(both | alone, face, edge);
        // The line's own point on the surface is at zero.
        let start = place.magnitude().at_most(fine);
        let place = S::select(start, place.with_primal(S::Primal::zero()), place);
        Border {
            t: place.over(safe),
            normal: Vec3::select(both, normal, Vec3::zero()),
        }
    };
    Inside::new(
        border(enter, enter_normal, edges.0.mean()),
        border(exit, exit_normal, edges.1.mean()),
    )
    .unless(still | !both & !alone & no_edge)
}

/// Returns the first and the last point of the corners and edges that the line meets; the fraction along an edge is a
/// constant.
#[inline(always)]
fn edges_met<S: Scalar>(sight: &Sight<S>) -> (Best<S, S>, Best<S, S>) {
    let wide = sight.aside.each_as(size_of);
    let (zero, large) = (S::zero(), S::largest());
    let (mut first, mut last) = (Best::of(large, large), Best::of(-large, -large));
    let mut add = |is_met: S::Mask, place: S| {
        first = first.less(Best::of(S::select(is_met, place, large), place));
        last = last.most(Best::of(S::select(is_met, place, -large), place));
    };
    for (place, wide) in sight.ahead.into_iter().zip(wide) {
        add(wide.at_most(sight.slack), place);
    }
    for (k, [i, j]) in EDGES.into_iter().enumerate() {
        let apart = sight.aside[i].dot(sight.aside[j]).below(zero);
        let is_met = sight.spans[k].equals(zero) & apart;
        let sum = S::Primal::select(is_met, wide[i] + wide[j], S::Primal::one());
        let share = S::from_primal(wide[i].over(sum));
        add(
            is_met,
            sight.ahead[i] + (sight.ahead[j] - sight.ahead[i]) * share,
        );
    }
    (first, last)
}
