//! The contract of an operation: written once per face, served everywhere.
use crate::error::Flaw;
use crate::kernels::cpu::drivers::Compiled;
use crate::kernels::cpu::rings::Measure;
use crate::{Fixed, Pack, Scalar, Vec2};

/// An operation: its name, its generic source and its adjoint by hand.
///
/// The harness, the parity tests, the benches and the documentation see an operation through this
/// trait and the list [`for_each_op!`](crate::for_each_op).
pub trait Op: Copy + Send + Sync + 'static {
    /// The name of the forward function, letter for letter.
    const NAME: &'static str;
    /// What it takes, made of any scalar.
    type In<S: Scalar>: Pack<Scalar = S>;
    /// What it gives, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The generic source.
    fn eval<S: Scalar>(input: &Self::In<S>) -> Self::Out<S>;
    /// The adjoint: the slopes of `out_bar · output` with respect to the input.
    fn vjp<S: Scalar>(input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S>;
    /// The input with every scalar replaced.
    fn map<S: Scalar, T: Scalar>(input: &Self::In<S>, f: &mut impl FnMut(S) -> T) -> Self::In<T>;
}

/// An operation of two shapes of fixed size with one number as result: what aligned and all-pairs
/// batches serve.
///
/// Whatever depends on one shape alone goes into its frame, which a batch makes once per shape.
pub trait PairOp: Op {
    /// The first shape.
    type A<S: Scalar>: Fixed<Scalar = S>;
    /// The second shape.
    type B<S: Scalar>: Fixed<Scalar = S>;
    /// The first shape, prepared.
    type FrameA<S: Scalar>: Fixed<Scalar = S>;
    /// The second shape, prepared.
    type FrameB<S: Scalar>: Fixed<Scalar = S>;
    /// Kernels that the library has compiled for it.
    #[doc(hidden)]
    fn compiled() -> Option<Compiled> {
        None
    }
    /// Prepares a first shape.
    fn frame_a<S: Scalar>(a: Self::A<S>) -> Self::FrameA<S>;
    /// Prepares a second shape.
    fn frame_b<S: Scalar>(b: Self::B<S>) -> Self::FrameB<S>;
    /// The result. `EXTREME` is false when every shape of the batch is ordinary; results are the
    /// same bits either way.
    fn value<S: Scalar, const EXTREME: bool>(a: Self::FrameA<S>, b: Self::FrameB<S>) -> S;
    /// The result and its slopes, fused.
    fn grad<S: Scalar, const EXTREME: bool>(
        a: Self::FrameA<S>,
        b: Self::FrameB<S>,
    ) -> (S, (Self::A<S>, Self::B<S>));
    /// Whether a first shape is valid and ordinary, told without branches.
    fn is_ordinary_a<S: Scalar<Mask = bool>>(a: Self::A<S>) -> bool;
    /// Whether a second shape is valid and ordinary, told without branches.
    fn is_ordinary_b<S: Scalar<Mask = bool>>(b: Self::B<S>) -> bool;
    /// Checks a first shape; `Ok(true)` when it is ordinary: products of its numbers stay far
    /// from over- and underflow.
    ///
    /// # Errors
    ///
    /// When the shape is not valid.
    fn check_a<S: Scalar<Mask = bool>>(a: &Self::A<S>) -> Result<bool, Flaw>;
    /// Checks a second shape likewise.
    ///
    /// # Errors
    ///
    /// When the shape is not valid.
    fn check_b<S: Scalar<Mask = bool>>(b: &Self::B<S>) -> Result<bool, Flaw>;
}

/// An operation of a ring of run-time size: what ragged batches serve.
pub trait RingOp: Op {
    /// Kernels that the library has compiled for it.
    #[doc(hidden)]
    fn compiled() -> Option<Measure> {
        None
    }
    /// The result.
    fn value<S: Scalar>(ring: &[Vec2<S>]) -> Self::Out<S>;
    /// The adjoint, one cotangent per vertex, written into the caller's slice of the same length.
    fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: Self::Out<S>, ring_bar: &mut [Vec2<S>]);
}
