//! The interface of a search: decisions on plain numbers, and a formula that uses them.
use crate::kernels::row::declares::Declares;
use crate::{Fixed, Scalar};
use std::hash::Hash;

/// An operation with a search.
///
/// [`search`](crate::kernels::search::search) turns it into a function of batches;
/// [`check_search_with`](crate::kernels::check::check_search_with) checks its derivatives.
pub trait Search: Declares {
    /// The arguments, generic over the scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, generic over the scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The decisions. All items with one record share one replay: a GPU is given every replay once.
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// Returns the decisions for an input.
    fn decide<S: Scalar<Mask = bool>>(input: Self::In<S>) -> Self::Record;
    /// Returns the result from the input and the decisions.
    fn replay<S: Scalar>(input: Self::In<S>, record: Self::Record) -> Self::Out<S>;
    /// Returns `false` for a number of the input, by its place among the scalars, by which the replay's derivative is
    /// zero: duals leave it out. By default no number is left out.
    fn reads(_record: &Self::Record, _place: usize) -> bool {
        true
    }
}
