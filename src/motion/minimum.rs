//! The kinds of a least distance over time, and its derivatives.
use super::moving::{Body3, Bounds, MovingPair};
use crate::Scalar;
use crate::distance3::decided::Decided;

/// How a distance has its minimum over time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Minimum {
    /// At an end of the time, or where the distance stays the same: the time is held.
    Held,
    /// Where the distance has the rate zero.
    Smooth,
    /// Where a distance that falls crosses one that rises, such as the depths out of two faces.
    Crossing,
}

/// A minimum as plain numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<S> {
    /// The kind.
    pub kind: Minimum,
    /// The time.
    pub time: S,
    /// The distance then.
    pub least: S,
    /// The time from it to those at which both sides are taken.
    pub width: S,
    /// The second derivative of the distance by time.
    pub curvature: S,
}

/// The share of the largest speed by which the rates of two sides differ, if these cross.
const CROSSING: f64 = 1.0 / 1024.0;
/// The share of the change over the width by which sides may miss the least distance, if these cross.
const BENT: f64 = 1.0 / 32.0;
/// The widths, in roots of a rounding: the next one where the search tells sides that are so near from each other by
/// no more than chance.
const WIDTHS: [f64; 3] = [1.0, 16.0, 256.0];

/// Returns the kind of the minimum at a time.
pub(super) fn judged<P, A, B>(pair: &MovingPair<P, A, B>, bounds: &Bounds<P>, time: P) -> Place<P>
where
    P: Scalar<Mask = bool>,
    A: Body3<Scalar = P> + Decided<B>,
    B: Body3<Scalar = P>,
{
    let now = pair.relation(time);
    let place = |kind, width, curvature| Place {
        kind,
        time,
        least: now.apart,
        width,
        curvature,
    };
    let side = |t: P| {
        let relation = pair.relation(t);
        (relation.apart, pair.rate(t, &relation))
    };
    for width in WIDTHS {
        let width = P::rounding(1.0, 1).root() * P::lit(width);
        let times = [time - width, time + width];
        if times[0].below(P::zero()) || times[1].above(P::one()) {
            break;
        }
        let sides = times.map(side);
        let [falls, rises] = sides.map(|(_, rate)| rate);
        if !(falls.below(P::zero()) && rises.above(P::zero())) {
            continue;
        }
        let change = rises - falls;
        // Sides that bend over the width meet elsewhere than their tangents do. Distances of bodies that are apart have
        // rates without a jump.
        let (_, least) = tangents(sides, width);
        let bent = (least - now.apart)
            .unsigned()
            .above(change * width * P::lit(BENT));
        if change.above(bounds.speed * P::lit(CROSSING)) {
            if !bent && now.apart.below(P::zero()) {
                return place(Minimum::Crossing, width, P::one());
            }
            // The minimum is sharp, and its time right to a rounding.
            break;
        }
        // A step of Newton's method that leaves the sides has no minimum to go to.
        if pair.rate(time, &now).unsigned().at_most(change) {
            return place(Minimum::Smooth, width, change.over(width + width));
        }
    }
    place(Minimum::Held, P::one(), P::one())
}

/// Returns the time from the first side to the crossing of both tangents, and the distance there, given the distances
/// and rates of both sides.
fn tangents<S: Scalar>([before, after]: [(S, S); 2], width: S) -> (S, S) {
    let way = before.0 - after.0 + after.1 * (width + width);
    let time = way.over(after.1 - before.1);
    (time, before.0 + before.1 * time)
}

/// Returns the least distance, given the decisions about both sides of its time.
pub(super) fn replay<S, A, B>(
    pair: &MovingPair<S, A, B>,
    place: Place<S>,
    decided: [&(A::Decisions, A::Hints); 2],
) -> S
where
    S: Scalar,
    A: Body3<Scalar = S> + Decided<B>,
    B: Body3<Scalar = S>,
{
    let Place {
        kind,
        time,
        least,
        width,
        curvature,
    } = place;
    match kind {
        Minimum::Held => pair.replayed(time, decided[0]).apart,
        // A step of Newton's method leaves an error of the time's derivative as large as that of the curvature, which is a
        // difference of rates; two leave its square.
        Minimum::Smooth => {
            let step = |time: S| {
                let rate = pair.rate(time, &pair.replayed(time, decided[0]));
                time - rate.over(curvature)
            };
            with_number(least, pair.replayed(step(step(time)), decided[0]).apart)
        }
        Minimum::Crossing => {
            let side = |t: S, decided| {
                let relation = pair.replayed(t, decided);
                (relation.apart, pair.rate(t, &relation))
            };
            let sides = |shift: S| {
                [
                    side(time - width + shift, decided[0]),
                    side(time + width + shift, decided[1]),
                ]
            };
            // The sides follow the crossing, so that it stays as far from them. Where distances bend, one step leaves the width in
            // the derivative of its time, and two its square.
            let (mut shift, mut way_now) = (S::zero(), S::zero());
            for _ in 0..2 {
                let (way, _) = tangents(sides(shift), width);
                way_now = S::from_primal(way.primal());
                shift += way - way_now;
            }
            let [before, after] = sides(shift);
            let [falls, rises] = [before.1, after.1].map(|rate| S::from_primal(rate.primal()));
            let share = rises.over(rises - falls);
            let found = (before.0 + before.1 * way_now) * share
                + (after.0 + after.1 * (way_now - (width + width))) * (S::one() - share);
            with_number(least, found)
        }
    }
}

/// Returns a number with the derivatives of another one, which is the same but for the error of a step.
fn with_number<S: Scalar>(number: S, found: S) -> S {
    number + (found - S::from_primal(found.primal()))
}
