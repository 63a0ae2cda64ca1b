//! Functions of two moving bodies.
use super::clearance::{self, Clearance3};
use super::impact::{self, Impact3, Meeting, Moment};
use super::minimum::{self, Minimum, Place};
use super::motion3::Motion3;
use super::moving::{Body3, MovingPair};
use crate::distance3::decided::Decided;
use crate::scalar::{Guard, noted};
use crate::{Pack, Scalar};

/// Two bodies of space that move: `a.time_of_impact(motion_a, b, motion_b)` and alike.
///
/// ```
/// use geograd::motion::{Motion3, Moves as _};
/// use geograd::{Sphere, Vec3};
/// let (ball, other) = (Sphere::new(Vec3::new(0.0, 0.0, 0.0), 1.0), Sphere::new(Vec3::new(6.0, 0.0, 0.0), 1.0));
/// let (right, left) = (Motion3::straight(Vec3::new(4.0, 0.0, 0.0)), Motion3::straight(Vec3::new(-4.0, 0.0, 0.0)));
/// assert_eq!(ball.time_of_impact(right, other, left).time, 0.5);
/// assert_eq!(ball.clearance(right, other, right).distance, 4.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "no time of impact of `{Self}` and `{B}`",
    note = "solids with a pose have one wherever they have distances, but upright boxes"
)]
pub trait Moves<B>: Copy {
    /// Their numbers.
    type Scalar: Scalar;
    /// Returns the first time at which the bodies touch: [`time_of_impact`](super::time_of_impact).
    #[must_use]
    fn time_of_impact(
        self,
        motion: Motion3<Self::Scalar>,
        other: B,
        other_motion: Motion3<Self::Scalar>,
    ) -> Impact3<Self::Scalar>;
    /// Returns the least distance along both motions: [`clearance`](super::clearance()).
    #[must_use]
    fn clearance(
        self,
        motion: Motion3<Self::Scalar>,
        other: B,
        other_motion: Motion3<Self::Scalar>,
    ) -> Clearance3<Self::Scalar>;
}

impl<S, A, B, PlainA, PlainB> Moves<B> for A
where
    S: Scalar<Mask = bool>,
    A: Body3 + Pack<Scalar = S, With<S::Primal> = PlainA> + Decided<B>,
    B: Body3 + Pack<Scalar = S, With<S::Primal> = PlainB>,
    PlainA: Body3<Scalar = S::Primal> + Decided<PlainB>,
    PlainB: Body3<Scalar = S::Primal>,
{
    type Scalar = S;
    fn time_of_impact(self, motion: Motion3<S>, other: B, other_motion: Motion3<S>) -> Impact3<S> {
        let guard = Guard::of(&self).and(&other).and(&motion).and(&other_motion);
        let pair = MovingPair::new((self, motion), (other, other_motion));
        let (record, hints) = impact_decided(&pair);
        guard.result(impact_replayed(&pair, &record, hints))
    }
    fn clearance(self, motion: Motion3<S>, other: B, other_motion: Motion3<S>) -> Clearance3<S> {
        let guard = Guard::of(&self).and(&other).and(&motion).and(&other_motion);
        let pair = MovingPair::new((self, motion), (other, other_motion));
        let (record, hints) = clearance_decided(&pair);
        guard.result(clearance_replayed(&pair, &record, hints))
    }
}

/// The decisions about an impact: how the bodies meet, and those about their relation then; `None` for a miss.
pub(crate) type ImpactRecord<D> = Option<(Meeting, D)>;

/// Returns the decisions about an impact, and the hints: its time, the rate of the gap, and those of the relation.
pub(crate) fn impact_decided<S, A, B, PlainA, PlainB>(
    pair: &MovingPair<S, A, B>,
) -> (ImpactRecord<A::Decisions>, (S, S, A::Hints))
where
    S: Scalar<Mask = bool>,
    A: Body3 + Pack<Scalar = S, With<S::Primal> = PlainA> + Decided<B>,
    B: Body3 + Pack<Scalar = S, With<S::Primal> = PlainB>,
    PlainA: Body3<Scalar = S::Primal> + Decided<PlainB>,
    PlainB: Body3<Scalar = S::Primal>,
{
    match impact::search(&pair.plain()) {
        Some(found) => {
            let [time, rate] = [found.time, found.rate].map(S::from_primal);
            let (decisions, hints) = pair.decided(time);
            noted::<S::Primal>(2, [1 + found.meeting as u32]);
            (Some((found.meeting, decisions)), (time, rate, hints))
        }
        None => {
            noted::<S::Primal>(2, [0]);
            (None, (S::zero(), S::one(), pair.decided(S::zero()).1))
        }
    }
}

/// Returns an impact from its decisions and hints.
pub(crate) fn impact_replayed<S, A, B>(
    pair: &MovingPair<S, A, B>,
    record: &ImpactRecord<A::Decisions>,
    (time, rate, hints): (S, S, A::Hints),
) -> Impact3<S>
where
    S: Scalar,
    A: Body3<Scalar = S> + Decided<B>,
    B: Body3<Scalar = S>,
{
    record.map_or_else(impact::miss, |(meeting, decisions)| {
        let found = Moment {
            time,
            rate,
            meeting,
        };
        impact::replay(pair, found, &(decisions, hints))
    })
}

/// The decisions about a least distance: its kind, and those about the relation on both sides of its time.
pub(crate) type ClearanceRecord<D> = (Minimum, [D; 2]);

/// The hints of a least distance: its time and number, the width of the sides and the curvature, and those of both
/// relations.
pub(crate) type ClearanceHints<S, H> = ([S; 4], [H; 2]);

/// Returns the decisions about the least distance, and the hints.
pub(crate) fn clearance_decided<S, A, B, PlainA, PlainB>(
    pair: &MovingPair<S, A, B>,
) -> (ClearanceRecord<A::Decisions>, ClearanceHints<S, A::Hints>)
where
    S: Scalar<Mask = bool>,
    A: Body3 + Pack<Scalar = S, With<S::Primal> = PlainA> + Decided<B>,
    B: Body3 + Pack<Scalar = S, With<S::Primal> = PlainB>,
    PlainA: Body3<Scalar = S::Primal> + Decided<PlainB>,
    PlainB: Body3<Scalar = S::Primal>,
{
    let found = clearance::search(&pair.plain());
    let numbers = [found.time, found.least, found.width, found.curvature].map(S::from_primal);
    let [time, _, width, _] = numbers;
    let sides = match found.kind {
        Minimum::Crossing => [time - width, time + width],
        _ => [time; 2],
    };
    let [(before, first), (after, second)] = sides.map(|t| pair.decided(t));
    noted::<S::Primal>(2, [found.kind as u32]);
    ((found.kind, [before, after]), (numbers, [first, second]))
}

/// Returns the least distance and its time from decisions and hints.
pub(crate) fn clearance_replayed<S, A, B>(
    pair: &MovingPair<S, A, B>,
    (kind, decisions): &ClearanceRecord<A::Decisions>,
    (numbers, hints): ClearanceHints<S, A::Hints>,
) -> Clearance3<S>
where
    S: Scalar,
    A: Body3<Scalar = S> + Decided<B>,
    B: Body3<Scalar = S>,
{
    let [time, least, width, curvature] = numbers;
    let place = Place {
        kind: *kind,
        time,
        least,
        width,
        curvature,
    };
    let [before, after] = *decisions;
    let [first, second] = hints;
    let distance = minimum::replay(pair, place, [&(before, first), &(after, second)]);
    Clearance3 {
        distance: distance.saturated().canonical(),
        time,
    }
}

/// Returns the first time from 0 to 1 at which two moving bodies of space touch, and where.
///
/// The place of the bodies is that at time 0. The time is right to some roundings of the coordinates over the speed of
/// the approach. Method, derivatives and kinks: see the [module](super).
///
/// ```
/// use geograd::motion::{Motion3, time_of_impact};
/// use geograd::{Obb3, Pack, Rotation3, Vec3, ad};
/// let cube = |x| Obb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0), Rotation3::identity());
/// let (push, still) = (Motion3::straight(Vec3::new(4.0, 0.0, 0.0)), Motion3::still());
/// let found = time_of_impact(cube(0.0), push, cube(4.0), still);
/// assert_eq!((found.time, found.normal), (0.5, Vec3::new(1.0, 0.0, 0.0)));
/// // The time is 2/v with v the speed of the push.
/// let by_push = |push: Vec3<_>| {
///     time_of_impact(cube(0.0).lift(), Motion3::straight(push), cube(4.0).lift(), Motion3::still()).time
/// };
/// let (time, by) = ad::gradient(by_push, push.velocity);
/// assert_eq!((time, by.x), (0.5, -2.0 / 16.0));
/// ```
#[must_use]
#[inline]
pub fn time_of_impact<S: Scalar, A: Moves<B, Scalar = S>, B>(
    a: A,
    motion_a: Motion3<S>,
    b: B,
    motion_b: Motion3<S>,
) -> Impact3<S> {
    a.time_of_impact(motion_a, b, motion_b)
}

/// Returns the least signed distance of two moving bodies of space over the times from 0 to 1, and the first time found
/// that has it.
///
/// Method, derivatives and kinks: see the [module](super).
///
/// ```
/// use geograd::motion::{Motion3, clearance};
/// use geograd::{Sphere, Vec3};
/// let (ball, post) = (Sphere::new(Vec3::new(-4.0, 3.0, 0.0), 1.0), Sphere::new(Vec3::zero(), 1.0));
/// let found = clearance(ball, Motion3::straight(Vec3::new(8.0, 0.0, 0.0)), post, Motion3::still());
/// assert!((found.distance - 1.0_f64).abs() < 1e-15 && (found.time - 0.5).abs() < 1e-6);
/// ```
#[must_use]
#[inline]
pub fn clearance<S: Scalar, A: Moves<B, Scalar = S>, B>(
    a: A,
    motion_a: Motion3<S>,
    b: B,
    motion_b: Motion3<S>,
) -> Clearance3<S> {
    a.clearance(motion_a, b, motion_b)
}
