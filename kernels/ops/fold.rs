//! Folds over paths as operations.
use crate::distance::ring::{EdgeFold, Fill};
use crate::kernels::fold::Fold;
use crate::kernels::op::{Answer, Jumps, Motion, Promise};
use crate::measure::moments::{SecondMoments, Sums, finish, of_edge};
use crate::reference::Reference;
use crate::{Scalar, Vec2};

/// The [second moments](crate::measure::moments::second_moments) of a ring's area about its centroid.
/// They jump where the area is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SecondMomentsOfRing;

impl Fold for SecondMomentsOfRing {
    const NAME: &'static str = "second_moments_of_ring";
    const CLOSED: bool = true;
    const PROMISES: &'static [Promise] = &[
        Promise::new(Motion::TranslationX, Answer::Stays),
        Promise::new(Motion::TranslationY, Answer::Stays),
        Promise::new(Motion::Scaling, Answer::Power(4)),
    ];
    const JUMPS: Jumps = Jumps::Anywhere;
    type Context<S: Scalar> = [S; 0];
    type Reference<S: Scalar> = Reference<S>;
    type State<S: Scalar> = Sums<S>;
    type Out<S: Scalar> = SecondMoments<S>;
    fn reference<S: Scalar>(_: [S; 0], ring: &[Vec2<S>]) -> Reference<S> {
        Reference::of_ring(ring)
    }
    fn empty<S: Scalar>() -> Sums<S> {
        [S::zero(); 6]
    }
    fn edge<S: Scalar>(_: [S; 0], seen: Reference<S>, from: Vec2<S>, to: Vec2<S>) -> Sums<S> {
        of_edge(seen.place(from), seen.place(to))
    }
    fn join<S: Scalar>(one: Sums<S>, other: Sums<S>) -> Sums<S> {
        std::array::from_fn(|k| one[k] + other[k])
    }
    fn finish<S: Scalar>(_: [S; 0], seen: Reference<S>, sums: Sums<S>) -> SecondMoments<S> {
        finish(sums, &seen)
    }
}

/// The [signed distance](crate::distance::ring::signed_distance_to_ring) of a point and a ring: negative
/// inside. Without edges it is the largest finite number. Exactly on the border its slope is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SignedDistancePointRing;

impl Fold for SignedDistancePointRing {
    const NAME: &'static str = "signed_distance_point_ring";
    const CLOSED: bool = true;
    const PROMISES: &'static [Promise] = &[
        Promise::new(Motion::TranslationX, Answer::Stays),
        Promise::new(Motion::TranslationY, Answer::Stays),
        Promise::new(Motion::Rotation, Answer::Stays),
    ];
    const JUMPS: Jumps = Jumps::Never;
    type Context<S: Scalar> = Vec2<S>;
    type Reference<S: Scalar> = [S; 0];
    type State<S: Scalar> = EdgeFold<S>;
    type Out<S: Scalar> = S;
    fn reference<S: Scalar>(_point: Vec2<S>, _ring: &[Vec2<S>]) -> [S; 0] {
        []
    }
    fn empty<S: Scalar>() -> EdgeFold<S> {
        EdgeFold::empty()
    }
    fn edge<S: Scalar>(point: Vec2<S>, _: [S; 0], from: Vec2<S>, to: Vec2<S>) -> EdgeFold<S> {
        EdgeFold::of_edge(point, from, to)
    }
    fn join<S: Scalar>(one: EdgeFold<S>, other: EdgeFold<S>) -> EdgeFold<S> {
        one.join(other)
    }
    fn finish<S: Scalar>(_: Vec2<S>, _: [S; 0], state: EdgeFold<S>) -> S {
        state.signed_distance(Fill::NonZero)
    }
}
