//! The first time at which two moving bodies touch.
use super::moving::{Body3, Bounds, MovingPair};
use crate::distance3::decided::Decided;
use crate::distance3::relation::Relation;
use crate::{Scalar, Vec3};

/// The first touch of two moving bodies of space.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact3<S> {
    /// The time, from 0 to 1; the largest finite number for a miss.
    #[shape(number)]
    pub time: S,
    /// The place of the touch, on the first body; zero for a miss.
    pub point: Vec3<S>,
    /// The direction, of length one, in which the second body is in the way of the first; zero for a miss.
    #[shape(direction)]
    pub normal: Vec3<S>,
    /// 0 for a miss, 1 for an impact, 2 where the bodies touch or overlap at time 0. A constant.
    #[shape(number)]
    pub kind: S,
}

/// The share of a gap that a step leaves at least, so that the next direction comes in time.
const LEFT: f64 = 0.125;
/// The largest number of steps. Each divides the gap by at least two; an approach that grazes takes one step per
/// halving of the time that is left, too.
const STEPS: usize = 2_000;
/// The largest number of gaps per step.
const TRIALS: usize = 12;

/// How two bodies meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Meeting {
    /// They touch or overlap at time 0.
    AtStart,
    /// They touch with hardly a speed toward each other: the time has no derivative.
    Grazing,
    /// One runs into the other.
    Head,
}

/// The moment of an impact as plain numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<P> {
    /// The time.
    pub time: P,
    /// The change of the gap with time then.
    pub rate: P,
    /// How the bodies meet.
    pub meeting: Meeting,
}

/// Returns the first time at which the distance is some roundings.
pub(super) fn search<P, A, B>(pair: &MovingPair<P, A, B>) -> Option<Moment<P>>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    let bounds = pair.bounds();
    let enough = bounds.rounding();
    let mut time = P::zero();
    for _ in 0..STEPS {
        let relation = pair.relation(time);
        if relation.apart.at_most(enough) {
            return Some(moment(pair, time, &relation, &bounds));
        }
        let gap = |after: P| pair.gap(time + after, relation.normal);
        time += step(gap, relation.apart, P::one() - time, &bounds)?;
    }
    // The gap is a rounding as far as these numbers tell.
    Some(moment(pair, time, &pair.relation(time), &bounds))
}

/// Returns the moment of an impact at a time, given the relation of the bodies then.
fn moment<P, A, B>(
    pair: &MovingPair<P, A, B>,
    time: P,
    relation: &Relation<P>,
    bounds: &Bounds<P>,
) -> Moment<P>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P>,
    B: Body3<Scalar = P>,
{
    let rate = pair.rate(time, relation);
    let head = (-rate).above(bounds.speed * P::rounding(GRAZING, 1));
    let meeting = match (time.at_most(P::zero()), head) {
        (true, _) => Meeting::AtStart,
        (_, true) => Meeting::Head,
        _ => Meeting::Grazing,
    };
    Moment {
        time,
        rate,
        meeting,
    }
}

/// Returns a time over which the gap stays positive, or nothing if that is all the time that is left.
fn step<P: Scalar<Mask = bool>>(
    gap: impl Fn(P) -> P,
    now: P,
    rest: P,
    bounds: &Bounds<P>,
) -> Option<P> {
    // The bound at a time, less the share that is to be left.
    let left = now * P::lit(LEFT);
    let above = |after: P| bounds.least(now, gap(after), after) - left;
    let at_end = above(rest);
    if at_end.above(P::zero()) {
        return None;
    }
    // The gap cannot close sooner at the largest speed: half of the way to there is safe.
    let safe = now.over(bounds.speed + bounds.speed).least(rest);
    let (mut low, mut high) = ((safe, above(safe).most(P::zero())), (rest, at_end));
    for trial in 0..TRIALS {
        let width = high.0 - low.0;
        // The secant of the bound, and in every third trial the geometric mean, since times span many orders.
        let secant = low.0 + width * low.1.over(low.1 - high.1);
        let middle = (low.0 * high.0).root();
        let next = if trial % 3 == 2 { middle } else { secant };
        let next = next.most(low.0).least(high.0);
        let value = above(next);
        if value.below(P::zero()) {
            high = (next, value);
        } else {
            low = (next, value);
            if value.at_most(left) {
                break;
            }
        }
    }
    Some(low.0)
}

/// Returns the impact of bodies that miss each other.
pub(super) fn miss<S: Scalar>() -> Impact3<S> {
    Impact3 {
        time: S::largest(),
        point: Vec3::zero(),
        normal: Vec3::zero(),
        kind: S::zero(),
    }
}

/// Returns an impact with derivatives, given its moment as constants and the decisions about the bodies then.
pub(super) fn replay<S, A, B>(
    pair: &MovingPair<S, A, B>,
    found: Moment<S>,
    decided: &(A::Decisions, A::Hints),
) -> Impact3<S>
where
    S: Scalar,
    A: Body3<Scalar = S> + Decided<B>,
    B: Body3<Scalar = S>,
{
    let mut time = found.time;
    let mut relation = pair.replayed(time, decided);
    if found.meeting == Meeting::Head {
        // Each step with a constant rate makes derivatives of one more order right.
        for _ in 0..2 {
            time -= relation.apart.over(found.rate);
            relation = pair.replayed(time, decided);
        }
        time = time.most(S::zero()).least(S::one());
    }
    let at_start = found.meeting == Meeting::AtStart;
    Impact3 {
        time: time.canonical(),
        point: relation.on_a.canonical(),
        normal: relation.normal.canonical(),
        kind: S::lit(if at_start { 2.0 } else { 1.0 }),
    }
}

/// The share of the largest speed, in roundings, below which an approach grazes.
const GRAZING: f64 = 64.0;
