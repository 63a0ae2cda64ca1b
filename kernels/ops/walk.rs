//! The list of rows: the entries of the tables, and the walk over them.
use crate::ad::sample::Sample;
use crate::kernels::call::search::HintedSearch;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::Item;
use crate::kernels::row::op::Op;

/// The verb, the shapes and the name of a row, as its table has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// The name of its function.
    pub name: &'static str,
    /// The type of its verb.
    pub verb: &'static str,
    /// The shapes of its arguments; `ring` or `polyline` for a path.
    pub shapes: &'static [&'static str],
}

/// A walk over all rows with their types. Its methods are compiled for every row, so they should convert a row to a
/// value and leave the rest to untyped code.
#[doc(hidden)]
pub trait Walk {
    /// Visits a straight line.
    fn straight<O: Op>(&mut self, row: Written)
    where
        O::In<f32>: Item<Scalar = f32>,
        O::Out<f32>: Item<Scalar = f32>,
        O::In<f64>: Item<Scalar = f64> + Sample,
        O::Out<f64>: Item<Scalar = f64> + Sample;
    /// Visits a search.
    fn search<D: HintedSearch>(&mut self, row: Written)
    where
        D::In<f32>: Item<Scalar = f32>,
        D::Out<f32>: Item<Scalar = f32>,
        D::In<f64>: Item<Scalar = f64> + Sample,
        D::Out<f64>: Item<Scalar = f64> + Sample;
    /// Visits a fold over paths.
    fn fold<F: Fold>(&mut self, row: Written)
    where
        F::Context<f32>: Item<Scalar = f32>,
        F::Out<f32>: Item<Scalar = f32>,
        F::Context<f64>: Item<Scalar = f64> + Sample,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
        F::Out<f64>: Item<Scalar = f64> + Sample;
}
