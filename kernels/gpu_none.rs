//! What stands for the GPU in a build without the feature `gpu`: a type without values, so that
//! [`Backend`](crate::kernels::Backend) is the same in both.
use crate::Vec2;
use crate::kernels::GpuError;
use crate::kernels::cpu::{A, AlignedGrads, B, PairGrads};
use crate::kernels::op::{Op, PairOp, RingOp};
use crate::kernels::reduce::{Best, Found};

/// A GPU. There is none in a build without the feature `gpu`.
#[derive(Clone, Copy, Debug)]
pub enum Gpu {}

/// An operation of two shapes that a GPU serves.
pub trait GpuPair: PairOp {}
impl<O: PairOp> GpuPair for O {}

/// An operation of a ring that a GPU serves.
pub trait GpuRing: RingOp {}
impl<O: RingOp> GpuRing for O {}

/// Slopes with respect to both lists.
type Both<O> = (Vec<A<O, f32>>, Vec<B<O, f32>>);
/// A result of an operation of rings.
type OutOf<O> = <O as Op>::Out<f32>;

impl std::fmt::Display for Gpu {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {}
    }
}

impl Gpu {
    /// A context, which a build without the feature `gpu` cannot have.
    ///
    /// # Errors
    ///
    /// Always [`GpuError::NotBuilt`].
    pub fn new() -> Result<Self, GpuError> {
        Err(GpuError::NotBuilt)
    }
    pub(crate) fn is_worth_it(&self) -> bool {
        match *self {}
    }
    pub(crate) fn aligned_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<Vec<f32>, GpuError> {
        match *self {}
    }
    pub(crate) fn aligned_grad_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<AlignedGrads<O, f32>, GpuError> {
        match *self {}
    }
    pub(crate) fn aligned_vjp_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
        _upstream: &[f32],
    ) -> Result<Both<O>, GpuError> {
        match *self {}
    }
    pub(crate) fn all_pairs_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<Vec<f32>, GpuError> {
        match *self {}
    }
    pub(crate) fn all_pairs_grad_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<PairGrads<O, f32>, GpuError> {
        match *self {}
    }
    pub(crate) fn all_pairs_vjp_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
        _upstream: &[f32],
    ) -> Result<Both<O>, GpuError> {
        match *self {}
    }
    pub(crate) fn row_max_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<Vec<Best>, GpuError> {
        match *self {}
    }
    pub(crate) fn column_max_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<Vec<Best>, GpuError> {
        match *self {}
    }
    pub(crate) fn above_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
        _threshold: f32,
    ) -> Result<Vec<Found>, GpuError> {
        match *self {}
    }
    pub(crate) fn count_above_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
        _threshold: f32,
    ) -> Result<u64, GpuError> {
        match *self {}
    }
    pub(crate) fn sum_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<f64, GpuError> {
        match *self {}
    }
    pub(crate) fn mean_slices<O: GpuPair>(
        &self,
        _a: &[A<O, f32>],
        _b: &[B<O, f32>],
    ) -> Result<f64, GpuError> {
        match *self {}
    }
    pub(crate) fn ragged_slices<O: GpuRing>(
        &self,
        _vertices: &[Vec2<f32>],
        _offsets: &[usize],
    ) -> Result<Vec<OutOf<O>>, GpuError> {
        match *self {}
    }
    pub(crate) fn ragged_vjp_slices<O: GpuRing>(
        &self,
        _vertices: &[Vec2<f32>],
        _offsets: &[usize],
        _upstream: &[OutOf<O>],
    ) -> Result<Vec<Vec2<f32>>, GpuError> {
        match *self {}
    }
}
