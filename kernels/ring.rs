//! The measures of a ring as operations.
use crate::kernels::cpu::rings::Measure;
use crate::kernels::op::{Op, RingOp};
use crate::{Pack, Scalar, Vec2, ad, ring};

/// [`signed_area`](crate::ring::signed_area).
#[derive(Clone, Copy, Debug, Default)]
pub struct SignedArea;

impl Op for SignedArea {
    const NAME: &'static str = "signed_area";
    type In<S: Scalar> = Vec<Vec2<S>>;
    type Out<S: Scalar> = S;
    fn eval<S: Scalar>(ring: &Vec<Vec2<S>>) -> S {
        Self::value(ring)
    }
    fn vjp<S: Scalar>(ring: &Vec<Vec2<S>>, out_bar: S) -> Vec<Vec2<S>> {
        let mut ring_bar = vec![Vec2::zero(); ring.len()];
        Self::ring_vjp(ring, out_bar, &mut ring_bar);
        ring_bar
    }
    fn map<S: Scalar, T: Scalar>(x: &Vec<Vec2<S>>, f: &mut impl FnMut(S) -> T) -> Vec<Vec2<T>> {
        Pack::map(x, &mut |s| f(*s))
    }
}

impl RingOp for SignedArea {
    fn compiled() -> Option<Measure> {
        Some(Measure::SignedArea)
    }
    #[inline(always)]
    fn value<S: Scalar>(ring: &[Vec2<S>]) -> S {
        ring::signed_area(ring)
    }
    #[inline(always)]
    fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
        ad::adjoint::ring::signed_area_vjp(ring, out_bar, ring_bar);
    }
}

/// [`perimeter`](crate::ring::perimeter).
#[derive(Clone, Copy, Debug, Default)]
pub struct Perimeter;

impl Op for Perimeter {
    const NAME: &'static str = "perimeter";
    type In<S: Scalar> = Vec<Vec2<S>>;
    type Out<S: Scalar> = S;
    fn eval<S: Scalar>(ring: &Vec<Vec2<S>>) -> S {
        Self::value(ring)
    }
    fn vjp<S: Scalar>(ring: &Vec<Vec2<S>>, out_bar: S) -> Vec<Vec2<S>> {
        let mut ring_bar = vec![Vec2::zero(); ring.len()];
        Self::ring_vjp(ring, out_bar, &mut ring_bar);
        ring_bar
    }
    fn map<S: Scalar, T: Scalar>(x: &Vec<Vec2<S>>, f: &mut impl FnMut(S) -> T) -> Vec<Vec2<T>> {
        Pack::map(x, &mut |s| f(*s))
    }
}

impl RingOp for Perimeter {
    fn compiled() -> Option<Measure> {
        Some(Measure::Perimeter)
    }
    #[inline(always)]
    fn value<S: Scalar>(ring: &[Vec2<S>]) -> S {
        ring::perimeter(ring)
    }
    #[inline(always)]
    fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
        ad::adjoint::ring::perimeter_vjp(ring, out_bar, ring_bar);
    }
}

/// [`centroid`](crate::ring::centroid).
#[derive(Clone, Copy, Debug, Default)]
pub struct Centroid;

impl Op for Centroid {
    const NAME: &'static str = "centroid";
    type In<S: Scalar> = Vec<Vec2<S>>;
    type Out<S: Scalar> = Vec2<S>;
    fn eval<S: Scalar>(ring: &Vec<Vec2<S>>) -> Vec2<S> {
        Self::value(ring)
    }
    fn vjp<S: Scalar>(ring: &Vec<Vec2<S>>, out_bar: Vec2<S>) -> Vec<Vec2<S>> {
        let mut ring_bar = vec![Vec2::zero(); ring.len()];
        Self::ring_vjp(ring, out_bar, &mut ring_bar);
        ring_bar
    }
    fn map<S: Scalar, T: Scalar>(x: &Vec<Vec2<S>>, f: &mut impl FnMut(S) -> T) -> Vec<Vec2<T>> {
        Pack::map(x, &mut |s| f(*s))
    }
}

impl RingOp for Centroid {
    fn compiled() -> Option<Measure> {
        Some(Measure::Centroid)
    }
    #[inline(always)]
    fn value<S: Scalar>(ring: &[Vec2<S>]) -> Vec2<S> {
        ring::centroid(ring)
    }
    #[inline(always)]
    fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: Vec2<S>, ring_bar: &mut [Vec2<S>]) {
        ad::adjoint::ring::centroid_vjp(ring, out_bar, ring_bar);
    }
}
