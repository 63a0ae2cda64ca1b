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
    /// The change of the distance with time.
    rate: P,
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
            rate: self.pair.rate(time, &relation),
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

/// The largest number of distances that the end of the search takes: every third one halves the time in question, so
/// that it ends at a rounding.
const TRIALS: usize = 160;
/// The number of roundings of the largest speed that a rate of zero may have.
const STILL: f64 = 8.0;

impl<P, A, B> Search<'_, P, A, B>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    /// Returns the time of the least distance near a sample, between a time at which the distance falls and one at which
    /// it rises.
    ///
    /// The secant of both rates leads to the zero of the rate of a smooth distance. Tangents of both sides meet at the time
    /// at which one distance takes the place of another.
    fn refined(&mut self, least: &Least<P>) -> P {
        let (time, width) = (least.sample.time, least.width);
        let still = self.bounds.speed * P::rounding(STILL, 1);
        let rounding = self.bounds.rounding();
        let (mut best, mut lowest) = (least.sample, least.sample.apart);
        let mut low = self.sample((time - width).most(P::zero()));
        let mut high = self.sample((time + width).least(P::one()));
        let mut next = best;
        for trial in 0..TRIALS {
            // Distances that differ by their rounding are told from each other by rates.
            if next.apart.at_most(lowest + rounding) {
                (best, lowest) = (next, lowest.least(next.apart));
                if best.rate.unsigned().at_most(still) {
                    break;
                }
                match best.rate.below(P::zero()) {
                    true => low = best,
                    false => high = best,
                }
            } else if next.time.below(best.time) {
                low = next;
            } else {
                high = next;
            }
            let width = high.time - low.time;
            if width.at_most(P::rounding(2.0, 1)) {
                break;
            }
            let way = match trial % 3 {
                0 => width * low.rate.over(low.rate - high.rate),
                1 => (low.apart - high.apart + high.rate * width).over(high.rate - low.rate),
                _ => width.halved(),
            };
            let is_between = way.above(P::zero()) && way.below(width);
            let way = if is_between { way } else { width.halved() };
            next = self.sample(low.time + way);
        }
        best.time
    }
}
