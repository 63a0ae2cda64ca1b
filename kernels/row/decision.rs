//! The contract of a search: decisions on plain numbers, and what they make of the input.
use crate::kernels::row::declares::Declares;
use crate::{Fixed, Scalar};
use std::hash::Hash;

/// An operation with a search.
///
/// [`search`](crate::kernels::search::search) makes it a function of batches; [`check_search_with`](crate::kernels::check::check_search_with) checks its
/// derivatives.
pub trait Search: Declares {
    /// The arguments, made of any scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The decisions. Items of the same record are replayed alike: a GPU gets every replay once.
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// Returns the search.
    fn decide<S: Scalar<Mask = bool>>(input: Self::In<S>) -> Self::Record;
    /// Returns the result, given the decisions.
    fn replay<S: Scalar>(input: Self::In<S>, record: Self::Record) -> Self::Out<S>;
}
