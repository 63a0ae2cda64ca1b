//! The interface of machines: calls over numbers, without the types of shapes.
//!
//! An engine implements these primitives; [`Machine`](super::Machine) has every named call, once, above them.
use super::column::Column;
use super::groups::GroupSpans;
use super::paths::{Input, VertexBars};
use super::results::{Bests, GroupedReduction, Matrix, Reduced, Reduction};
use super::stays::Numbers;
use super::stored::Stored;
use crate::error::Argument;
use crate::kernels::call::folding::Folding;
use crate::kernels::call::recording::Call;
use crate::kernels::row::item::{Leaf, Target};
use crate::suppression::Rules;
use crate::{Error, Real};
use std::fmt::Debug;

/// Keeps engines within the library.
pub(crate) mod sealed {
    pub trait Sealed {}
}

/// Memory for results of every item.
pub enum Items<'a, T: Real> {
    /// Targets of the right length, `None` for what is not wanted; `true` for those in a new vector, which may be written
    /// on an error.
    Targets(Vec<Option<Target<'a, T>>>, bool),
    /// On the machine, over others that may be written over; over nothing if there are none.
    Held(&'a mut Stored<T>),
}

/// Memory for results of all pairs.
#[derive(Debug)]
pub enum Room<'a, T: Real> {
    /// Plane after plane, each a matrix, row by row.
    Planes(&'a mut [T]),
    /// A matrix on the machine, of the same size.
    Held(&'a mut Matrix<T>),
}

/// The cotangents of all results.
#[derive(Clone, Copy, Debug)]
pub enum Seed<'a, T: Real> {
    /// A number for every pair, row by row.
    Numbers(&'a [T]),
    /// The same, on the machine.
    Matrix(&'a Matrix<T>),
    /// One number for all.
    Factor(T),
}

/// An engine that computes in a number type: the [CPU's](crate::kernels::cpu::Processor) in `f32` and `f64`, a
/// [GPU's](crate::kernels::gpu::Device) in `f32`.
///
/// Columns come with what errors call them; engines check shapes before they compute.
pub trait Engine<T: Real>: sealed::Sealed + Debug + Send + Sync {
    /// Checks shapes, one after another.
    #[doc(hidden)]
    fn check(&self, argument: Argument, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error>;

    /// Keeps columns of so many items, whose numbers were checked.
    #[doc(hidden)]
    fn keep(&self, count: usize, columns: Vec<Numbers<T>>) -> Result<Stored<T>, Error>;

    /// Makes room for a matrix.
    #[doc(hidden)]
    fn room(&self, rows: usize, columns: usize) -> Result<Matrix<T>, Error>;

    /// Computes item i of every column. `false` asks for the same again: results in a new vector came back unfinished.
    #[doc(hidden)]
    fn map(
        &self,
        call: &Call<T>,
        columns: &[Column<'_, T>],
        results: Items<'_, T>,
    ) -> Result<bool, Error>;

    /// Computes all pairs, of results of one number where they stay.
    #[doc(hidden)]
    fn pairs(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        results: Room<'_, T>,
    ) -> Result<(), Error>;

    /// Reduces all pairs, without the matrix; the reduction was checked.
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

    /// Computes the cotangents of both lists from those of all results; with one factor for all also the sum of all
    /// results, otherwise 0.
    #[doc(hidden)]
    fn pull_back(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        seed: &Seed<'_, T>,
        bars: [&mut [T]; 2],
    ) -> Result<f64, Error>;

    /// Checks paths, and writes the numbers of the result of every one.
    #[doc(hidden)]
    fn fold(&self, folding: &Folding<T>, input: &Input<'_, T>, out: &mut [T]) -> Result<(), Error>;

    /// Writes the numbers of the cotangents of every context and every vertex, for those of every result.
    #[doc(hidden)]
    fn fold_back(
        &self,
        folding: &Folding<T>,
        input: &Input<'_, T>,
        upstream: &[T],
        by_context: &mut [T],
        by_vertex: VertexBars<'_, T>,
    ) -> Result<(), Error>;

    /// Returns the shapes that no better one, kept itself, overlaps by more than the threshold; within groups if there
    /// are offsets. Scores, rules and offsets were checked.
    #[doc(hidden)]
    fn suppress(
        &self,
        call: &Call<T>,
        shapes: &Column<'_, T>,
        groups: Option<&[usize]>,
        scores: &[T],
        rules: Rules<'_, T>,
    ) -> Result<Vec<usize>, Error>;

    /// Returns the shapes that rows or columns found best, in their order.
    #[doc(hidden)]
    fn pick(&self, list: &Stored<T>, bests: &Bests<T>) -> Result<Stored<T>, Error>;
}

/// Runs a call into new memory: first without checks beforehand, which is faster where all is well; then, if that came
/// back unfinished, with all checks, so that an error names the first item that is not valid.
pub(crate) fn try_then_check(
    mut attempt: impl FnMut(bool) -> Result<bool, Error>,
) -> Result<(), Error> {
    match attempt(true)? {
        true => Ok(()),
        false => attempt(false).map(drop),
    }
}

/// A number that an engine computes in: `f32` and `f64` on the CPU, `f32` on a GPU.
#[diagnostic::on_unimplemented(
    message = "`{E}` does not compute in `{Self}`",
    label = "`{Self}` is no number of this machine",
    note = "GPUs compute in `f32`: convert shapes with `cast`, or use `Cpu`"
)]
pub trait On<E: ?Sized>: Real {
    /// Returns the engine, in this number.
    #[doc(hidden)]
    fn engine(engine: &E) -> &dyn Engine<Self>;
}

impl<T: Real> On<dyn Engine<T>> for T {
    fn engine(engine: &dyn Engine<T>) -> &dyn Engine<T> {
        engine
    }
}
