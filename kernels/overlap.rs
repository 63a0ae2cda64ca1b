//! The overlap scores as operations.
use crate::ad::adjoint::overlap::{score_aabb2_vjp, score_framed_vjp};
use crate::clip::{Framed, frame, is_ordinary};
use crate::error::{Flaw, Validate};
use crate::kernels::cpu::drivers::Compiled;
use crate::kernels::op::{Op, PairOp};
use crate::overlap::{Intersection, Measure, OverFirst, OverUnion, score_aabb2, score_framed};
use crate::{Aabb2, Obb2, Pack, Scalar};
use std::marker::PhantomData;

/// A score of two rotated boxes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Obb2Score<M>(PhantomData<M>);

/// A score of two axis-aligned boxes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Aabb2Score<M>(PhantomData<M>);

/// [`intersection_area_obb2`](crate::overlap::intersection_area_obb2).
pub type IntersectionAreaObb2 = Obb2Score<Intersection>;
/// [`iou_obb2`](crate::overlap::iou_obb2).
pub type IouObb2 = Obb2Score<OverUnion>;
/// [`iof_obb2`](crate::overlap::iof_obb2).
pub type IofObb2 = Obb2Score<OverFirst>;
/// [`intersection_area_aabb2`](crate::overlap::intersection_area_aabb2).
pub type IntersectionAreaAabb2 = Aabb2Score<Intersection>;
/// [`iou_aabb2`](crate::overlap::iou_aabb2).
pub type IouAabb2 = Aabb2Score<OverUnion>;
/// [`iof_aabb2`](crate::overlap::iof_aabb2).
pub type IofAabb2 = Aabb2Score<OverFirst>;

impl<M: Measure> Op for Obb2Score<M> {
    const NAME: &'static str = M::OBB2;
    type In<S: Scalar> = (Obb2<S>, Obb2<S>);
    type Out<S: Scalar> = S;
    #[inline]
    fn eval<S: Scalar>(&(a, b): &Self::In<S>) -> S {
        score_framed::<S, true>(M::DENOMINATOR, frame(a), frame(b))
    }
    #[inline]
    fn vjp<S: Scalar>(&(a, b): &Self::In<S>, out_bar: S) -> Self::In<S> {
        score_framed_vjp::<S, true>(M::DENOMINATOR, frame(a), frame(b), out_bar).1
    }
    fn map<S: Scalar, T: Scalar>(x: &Self::In<S>, f: &mut impl FnMut(S) -> T) -> Self::In<T> {
        Pack::map(x, &mut |s| f(*s))
    }
}

impl<M: Measure> PairOp for Obb2Score<M> {
    fn compiled() -> Option<Compiled> {
        Some(Compiled::Obb2(M::DENOMINATOR))
    }
    type A<S: Scalar> = Obb2<S>;
    type B<S: Scalar> = Obb2<S>;
    type FrameA<S: Scalar> = Framed<S>;
    type FrameB<S: Scalar> = Framed<S>;
    #[inline(always)]
    fn frame_a<S: Scalar>(a: Obb2<S>) -> Framed<S> {
        frame(a)
    }
    #[inline(always)]
    fn frame_b<S: Scalar>(b: Obb2<S>) -> Framed<S> {
        frame(b)
    }
    #[inline(always)]
    fn value<S: Scalar, const EXTREME: bool>(a: Framed<S>, b: Framed<S>) -> S {
        score_framed::<S, EXTREME>(M::DENOMINATOR, a, b)
    }
    #[inline(always)]
    fn grad<S: Scalar, const EXTREME: bool>(a: Framed<S>, b: Framed<S>) -> (S, (Obb2<S>, Obb2<S>)) {
        score_framed_vjp::<S, EXTREME>(M::DENOMINATOR, a, b, S::one())
    }
    #[inline(always)]
    fn is_ordinary_a<S: Scalar<Mask = bool>>(a: Obb2<S>) -> bool {
        is_ordinary(a)
    }
    #[inline(always)]
    fn is_ordinary_b<S: Scalar<Mask = bool>>(b: Obb2<S>) -> bool {
        is_ordinary(b)
    }
    #[inline]
    fn check_a<S: Scalar<Mask = bool>>(a: &Obb2<S>) -> Result<bool, Flaw> {
        a.validate().map(|()| is_ordinary(*a))
    }
    #[inline]
    fn check_b<S: Scalar<Mask = bool>>(b: &Obb2<S>) -> Result<bool, Flaw> {
        b.validate().map(|()| is_ordinary(*b))
    }
}

impl<M: Measure> Op for Aabb2Score<M> {
    const NAME: &'static str = M::AABB2;
    type In<S: Scalar> = (Aabb2<S>, Aabb2<S>);
    type Out<S: Scalar> = S;
    #[inline]
    fn eval<S: Scalar>(&(a, b): &Self::In<S>) -> S {
        score_aabb2(M::DENOMINATOR, a, b)
    }
    #[inline]
    fn vjp<S: Scalar>(&(a, b): &Self::In<S>, out_bar: S) -> Self::In<S> {
        score_aabb2_vjp(M::DENOMINATOR, a, b, out_bar).1
    }
    fn map<S: Scalar, T: Scalar>(x: &Self::In<S>, f: &mut impl FnMut(S) -> T) -> Self::In<T> {
        Pack::map(x, &mut |s| f(*s))
    }
}

impl<M: Measure> PairOp for Aabb2Score<M> {
    fn compiled() -> Option<Compiled> {
        Some(Compiled::Aabb2(M::DENOMINATOR))
    }
    type A<S: Scalar> = Aabb2<S>;
    type B<S: Scalar> = Aabb2<S>;
    type FrameA<S: Scalar> = Aabb2<S>;
    type FrameB<S: Scalar> = Aabb2<S>;
    #[inline(always)]
    fn frame_a<S: Scalar>(a: Aabb2<S>) -> Aabb2<S> {
        a
    }
    #[inline(always)]
    fn frame_b<S: Scalar>(b: Aabb2<S>) -> Aabb2<S> {
        b
    }
    #[inline(always)]
    fn value<S: Scalar, const EXTREME: bool>(a: Aabb2<S>, b: Aabb2<S>) -> S {
        score_aabb2(M::DENOMINATOR, a, b)
    }
    #[inline(always)]
    fn grad<S: Scalar, const EXTREME: bool>(a: Aabb2<S>, b: Aabb2<S>) -> (S, (Aabb2<S>, Aabb2<S>)) {
        score_aabb2_vjp(M::DENOMINATOR, a, b, S::one())
    }
    #[inline(always)]
    fn is_ordinary_a<S: Scalar<Mask = bool>>(a: Aabb2<S>) -> bool {
        a.min.x.finite()
            & a.min.y.finite()
            & a.max.x.finite()
            & a.max.y.finite()
            & a.min.x.at_most(a.max.x)
            & a.min.y.at_most(a.max.y)
    }
    #[inline(always)]
    fn is_ordinary_b<S: Scalar<Mask = bool>>(b: Aabb2<S>) -> bool {
        Self::is_ordinary_a(b)
    }
    #[inline]
    fn check_a<S: Scalar<Mask = bool>>(a: &Aabb2<S>) -> Result<bool, Flaw> {
        a.validate().map(|()| true)
    }
    #[inline]
    fn check_b<S: Scalar<Mask = bool>>(b: &Aabb2<S>) -> Result<bool, Flaw> {
        b.validate().map(|()| true)
    }
}
