//! The contract of a search: decisions on plain numbers, and what they make of the input.
use crate::kernels::row::op::{Extremes, Finite, Invariance, Jumps, Limits, Range};
use crate::{Fixed, Scalar};
use std::fmt::Debug;
use std::hash::Hash;

/// An operation with a search.
///
/// [`search`](crate::kernels::search::search) makes it a function of batches; [`check_search_with`](crate::kernels::check::check_search_with) checks its
/// derivatives.
pub trait Search: Copy + Debug + Default + Send + Sync + 'static {
    /// The name of the function, letter for letter.
    const NAME: &'static str;
    /// The arguments, made of any scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The decisions. Items of the same record are replayed alike: a GPU gets every replay once.
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// Its invariances under motions; `&[]` declares none.
    const INVARIANCES: &'static [Invariance];
    /// Places at which its value may jump.
    const JUMPS: Jumps;
    /// Inputs whose values and derivatives are finite.
    const FINITE: Finite = Finite::Within(Limits::ORDINARY);
    /// The range of every number of its result.
    const RANGE: Range = Range::ANY;
    /// The scores of identical shapes and of shapes apart.
    const EXTREMES: Extremes = Extremes::Undeclared;
    /// The names of its arguments, one for each; empty without names of their own.
    const ARGUMENTS: &'static [&'static str] = &[];
    /// Documentation in Markdown: the doc comment of its row, empty without one.
    const DOC: &'static str = "";
    /// The search.
    fn decide<S: Scalar<Mask = bool>>(input: Self::In<S>) -> Self::Record;
    /// The result, given the decisions.
    fn replay<S: Scalar>(input: Self::In<S>, record: Self::Record) -> Self::Out<S>;
}
