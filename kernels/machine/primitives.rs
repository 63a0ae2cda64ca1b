//! The interface of machines: calls over numbers, without the types of shapes.
//!
//! An engine implements these primitives; [`Machine`](super::Machine) builds every named call from them.
use super::column::Column;
use super::found::{Least, LeastPairs};
use super::groups::GroupSpans;
use super::machine_column::Numbers;
use super::paths::{Input, VertexBars};
use super::results::{Bests, GroupedReduction, Matrix, Reduced, Reduction};
use super::stored::Stored;
use crate::error::Argument;
use crate::kernels::call::folding::Folding;
use crate::kernels::call::recording::Call;
use crate::kernels::row::item::{Leaf, Target};
use crate::suppression::Rules;
use crate::{Error, Real};
use std::fmt::Debug;

/// Prevents implementations of [`Engine`] outside of the library.
pub(crate) mod sealed {
    #[doc(hidden)]
    pub trait Sealed {}
}

/// The memory for one result per item.
pub enum Items<'a, T: Real> {
    /// Targets of the right length, `None` for unwanted ones. The flag is `true` for new memory, which may be written
    /// even on an error.
    Targets(Vec<Option<Target<'a, T>>>, bool),
    /// On the machine, in place of earlier results; these are empty if there are none.
    Held(&'a mut Stored<T>),
}

/// The memory for results of all pairs.
#[derive(Debug)]
pub enum Room<'a, T: Real> {
    /// One row-major matrix for every number of a result, one after another.
    Planes(&'a mut [T]),
    /// A matrix on the machine, of the right size.
    Held(&'a mut Matrix<T>),
}

/// The cotangents of all results.
#[derive(Clone, Copy, Debug)]
pub enum Seed<'a, T: Real> {
    /// A number for every pair, in row-major order.
    Numbers(&'a [T]),
    /// A number for every pair, in a matrix on the machine.
    Matrix(&'a Matrix<T>),
    /// One number for all pairs.
    Factor(T),
}

/// An engine that computes in a number type: the [CPU's](crate::kernels::cpu::Processor) in `f32` and `f64`, a
/// [GPU's](crate::kernels::gpu::Device) in `f32`.
///
/// Columns come with their names for errors; engines check shapes before they compute.
pub trait Engine<T: Real>: sealed::Sealed + Debug + Send + Sync {
    /// Checks shapes, one after another.
    #[doc(hidden)]
    fn check(&self, argument: Argument, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error>;

    /// Stores columns of `count` items with checked numbers.
    #[doc(hidden)]
    fn keep(&self, count: usize, columns: Vec<Numbers<T>>) -> Result<Stored<T>, Error>;

    /// Allocates a matrix.
    #[doc(hidden)]
    fn room(&self, rows: usize, columns: usize) -> Result<Matrix<T>, Error>;

    /// Computes item i of every column. Returns `false` if results in new memory are incomplete; the caller must then
    /// run the call with checks.
    #[doc(hidden)]
    fn map(
        &self,
        call: &Call<T>,
        columns: &[Column<'_, T>],
        results: Items<'_, T>,
    ) -> Result<bool, Error>;

    /// Computes all pairs. On a machine results must have one number.
    #[doc(hidden)]
    fn pairs(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        results: Room<'_, T>,
    ) -> Result<(), Error>;

    /// Reduces all pairs without storing the matrix; the reduction was checked.
    #[doc(hidden)]
    fn reduce(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        reduction: Reduction<T>,
    ) -> Result<Reduced<T>, Error>;

    /// Reduces the pairs within groups; offsets and reduction were checked.
    #[doc(hidden)]
    fn reduce_grouped(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        groups: GroupSpans<'_>,
        reduction: GroupedReduction<T>,
    ) -> Result<Reduced<T>, Error>;

    /// Searches for the least results of the pairs within groups; offsets and search were checked. `ties` is `true` if
    /// every pair with a least result is wanted.
    #[doc(hidden)]
    fn least(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        groups: GroupSpans<'_>,
        wanted: Least<T>,
        ties: bool,
    ) -> Result<LeastPairs<T>, Error>;

    /// Writes the cotangents of both lists from the cotangents of all results. Returns the sum of all results if one
    /// factor is the seed of all pairs, otherwise 0.
    #[doc(hidden)]
    fn pull_back(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        seed: &Seed<'_, T>,
        bars: [&mut [T]; 2],
    ) -> Result<f64, Error>;

    /// Checks paths, and writes the numbers of every result.
    #[doc(hidden)]
    fn fold(&self, folding: &Folding<T>, input: &Input<'_, T>, out: &mut [T]) -> Result<(), Error>;

    /// Writes the cotangents of every context and every vertex from the results' cotangents.
    #[doc(hidden)]
    fn fold_back(
        &self,
        folding: &Folding<T>,
        input: &Input<'_, T>,
        upstream: &[T],
        by_context: &mut [T],
        by_vertex: VertexBars<'_, T>,
    ) -> Result<(), Error>;

    /// Returns the shapes that no better kept shape overlaps by more than the threshold; within groups if there are
    /// offsets. Scores, rules and offsets were checked.
    #[doc(hidden)]
    fn suppress(
        &self,
        call: &Call<T>,
        shapes: &Column<'_, T>,
        groups: Option<&[usize]>,
        scores: &[T],
        rules: Rules<'_, T>,
    ) -> Result<Vec<usize>, Error>;

    /// Returns the shapes with the indices in `bests`, in their order.
    #[doc(hidden)]
    fn pick(&self, list: &Stored<T>, bests: &Bests<T>) -> Result<Stored<T>, Error>;
}

/// Runs a call into new memory. The first attempt skips the checks, which is faster for valid items. If it returns
/// `false`, the second attempt checks everything, and its error names the first invalid item.
pub(crate) fn try_then_check(
    mut attempt: impl FnMut(bool) -> Result<bool, Error>,
) -> Result<(), Error> {
    match attempt(true)? {
        true => Ok(()),
        false => attempt(false).map(drop),
    }
}

/// A number type that an engine computes in: `f32` and `f64` on the CPU, `f32` on a GPU.
#[diagnostic::on_unimplemented(
    message = "`{E}` does not compute in `{Self}`",
    label = "`{Self}` is no number of this machine",
    note = "GPUs compute in `f32`: convert shapes with `cast`, or use `Cpu`"
)]
pub trait On<E: ?Sized>: Real {
    /// Returns the engine for this number type.
    #[doc(hidden)]
    fn engine(engine: &E) -> &dyn Engine<Self>;
}

impl<T: Real> On<dyn Engine<T>> for T {
    fn engine(engine: &dyn Engine<T>) -> &dyn Engine<T> {
        engine
    }
}
