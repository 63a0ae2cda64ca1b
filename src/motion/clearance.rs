//! The least distance of two moving bodies.
use super::minimum::{Place, judged};
use super::moving::{Body3, Bounds, MovingPair};
use crate::distance3::decided::Decided;
use crate::predicate::order;
use crate::{Scalar, Vec3};

/// The least signed distance of two moving bodies of space, and its time.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Clearance3<S> {
    /// The signed distance: minus the largest depth where the bodies meet.
    pub distance: S,
    /// The time, from 0 to 1. A constant.
    #[shape(number)]
    pub time: S,
}

/// The largest number of distances that the division of time takes.
const MOST: usize = 4_096;
/// The number of parts that it begins with.
const PARTS: usize = 8;

/// A time, and the relation of the bodies then.
#[derive(Clone, Copy)]
struct Sample<P> {
    time: P,
    /// The signed distance.
    apart: P,
    /// The direction of its gap.
    normal: Vec3<P>,
}

/// The least distance so far, and how far from its time others were taken.
struct Least<P> {
    sample: Sample<P>,
    width: P,
}

/// A part of the time, with a bound of its distances.
struct Part<P> {
    start: Sample<P>,
    end: Sample<P>,
    bound: P,
}

/// The search for the least distance of a pair.
struct Search<'a, P, A, B> {
    pair: &'a MovingPair<P, A, B>,
    bounds: Bounds<P>,
    taken: usize,
}

impl<P, A, B> Search<'_, P, A, B>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    fn sample(&mut self, time: P) -> Sample<P> {
        self.taken += 1;
        let relation = self.pair.relation(time);
        Sample {
            time,
            apart: relation.apart,
            normal: relation.normal,
        }
    }
    /// Returns the part between two times, bounded by the gaps along the directions of both ends, and along the
    /// direction that goes from one to the other.
    fn part(&self, start: Sample<P>, end: Sample<P>) -> Part<P> {
        let time = end.time - start.time;
        let fixed = |a: P, b: P| self.bounds.least(a, b, time);
        let by_start = fixed(start.apart, self.pair.gap(end.time, start.normal));
        let by_end = fixed(self.pair.gap(start.time, end.normal), end.apart);
        let turned = self.turned(&start, &end, time);
        // Points that coincide prefer no direction.
        let known = [start.normal, end.normal].map(|n| n.length_squared().above(P::zero()));
        let bound = match known {
            [true, true] => by_start.most(by_end).most(turned),
            [true, false] => by_start,
            [false, true] => by_end,
            [false, false] => start.apart.least(end.apart) - self.bounds.speed * time.halved(),
        };
        Part { start, end, bound }
    }
    /// Returns the bound of the gap along the direction that goes straight from that of the start to that of the end. At
    /// both ends the gap is the distance; its second derivative has two more terms, from the change of the direction.
    fn turned(&self, start: &Sample<P>, end: &Sample<P>, time: P) -> P {
        let change = (end.normal - start.normal).length();
        let turn = self.bounds.speed * change * time * P::lit(0.25);
        let bound = self.bounds.least(start.apart, end.apart, time) - turn;
        // Directions on the way are shorter than one, which lessens a depth.
        let shortest = (P::one() - change * change * P::lit(0.25)).root();
        match bound.below(P::zero()) {
            true if shortest.at_most(P::zero()) => P::lowest(),
            true => bound.over(shortest),
            false => bound,
        }
    }
}

/// Returns the place of the least distance.
pub(super) fn search<P, A, B>(pair: &MovingPair<P, A, B>) -> Place<P>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    let bounds = pair.bounds();
    let mut search = Search {
        pair,
        bounds,
        taken: 0,
    };
    // 2⁻³⁰ and 2⁻¹² of the size: more than the roundings of a gap, little enough for the end of the search.
    let relative = if P::format().epsilon() < 1e-10 {
        1.0 / (1_u64 << 30) as f64
    } else {
        1.0 / 4096.0
    };
    let enough = bounds.size * P::lit(relative);
    let width = P::lit(1.0 / PARTS as f64);
    let samples: [Sample<P>; PARTS + 1] =
        std::array::from_fn(|i| search.sample(P::lit(i as f64 / PARTS as f64)));
    let mut least = Least {
        sample: samples[0],
        width,
    };
    for sample in samples {
        least.offer(sample, width);
    }
    let mut parts: Vec<Part<P>> = samples
        .windows(2)
        .map(|ends| search.part(ends[0], ends[1]))
        .collect();
    // The least bound is last: it is divided first.
    parts.sort_by(|a, b| order(b.bound, a.bound));
    while let Some(part) = parts.pop() {
        if search.taken >= MOST || part.bound.at_least(least.sample.apart - enough) {
            continue;
        }
        let half = (part.end.time - part.start.time).halved();
        let middle = search.sample(part.start.time + half);
        least.offer(middle, half);
        let halves = [
            search.part(part.start, middle),
            search.part(middle, part.end),
        ];
        let [first, second] = halves;
        match second.bound.below(first.bound) {
            true => parts.extend([first, second]),
            false => parts.extend([second, first]),
        }
    }
    let time = search.refined(&least);
    judged(pair, &bounds, time)
}

impl<P: Scalar<Mask = bool>> Least<P> {
    /// Takes a sample if it is less.
    fn offer(&mut self, sample: Sample<P>, width: P) {
        if sample.apart.below(self.sample.apart) {
            *self = Least { sample, width };
        } else if sample.time.equals(self.sample.time) {
            self.width = width;
        }
    }
}

/// The share of a bracket that the golden section keeps: (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// The number of times that it divides: it ends at a rounding of the time.
const SECTIONS: usize = 80;

impl<P, A, B> Search<'_, P, A, B>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    /// Returns the time of the least distance near a sample, by the golden section.
    fn refined(&mut self, least: &Least<P>) -> P {
        let (time, width) = (least.sample.time, least.width);
        let mut low = (time - width).most(P::zero());
        let mut high = (time + width).least(P::one());
        let mut best = least.sample;
        let inner = |low: P, high: P, share: f64| low + (high - low) * P::lit(share);
        let mut left = self.sample(inner(low, high, 1.0 - GOLDEN));
        let mut right = self.sample(inner(low, high, GOLDEN));
        for _ in 0..SECTIONS {
            for sample in [left, right] {
                if sample.apart.below(best.apart) {
                    best = sample;
                }
            }
            if (high - low).at_most(P::rounding(2.0, 1)) {
                break;
            }
            if right.apart.below(left.apart) {
                low = left.time;
                left = right;
                right = self.sample(inner(low, high, GOLDEN));
            } else {
                high = right.time;
                right = left;
                left = self.sample(inner(low, high, 1.0 - GOLDEN));
            }
        }
        best.time
    }
}
