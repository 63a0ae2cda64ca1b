//! The list of rows: what the tables hand over, and who takes it.
use crate::ad::sample::Sample;
use crate::kernels::call::search::Search;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::Item;
use crate::kernels::row::op::Op;

/// A row as its table writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// The name of its function.
    pub name: &'static str,
    /// The type of its verb.
    pub verb: &'static str,
    /// The shapes that it takes; of a path `ring` or `polyline`.
    pub shapes: &'static [&'static str],
}

/// A walk over all rows with their types. Whoever implements it compiles its methods for every row; a walk that makes
/// values leaves the rest to code without types.
pub trait Walk {
    /// Takes a straight line.
    fn straight<O: Op>(&mut self, row: Written)
    where
        O::In<f32>: Item<Scalar = f32>,
        O::Out<f32>: Item<Scalar = f32>,
        O::In<f64>: Item<Scalar = f64> + Sample,
        O::Out<f64>: Item<Scalar = f64> + Sample;
    /// Takes a search.
    fn search<D: Search>(&mut self, row: Written)
    where
        D::In<f32>: Item<Scalar = f32>,
        D::Out<f32>: Item<Scalar = f32>,
        D::In<f64>: Item<Scalar = f64> + Sample,
        D::Out<f64>: Item<Scalar = f64> + Sample;
    /// Takes a fold over paths.
    fn fold<F: Fold>(&mut self, row: Written)
    where
        F::Context<f32>: Item<Scalar = f32>,
        F::Out<f32>: Item<Scalar = f32>,
        F::Context<f64>: Item<Scalar = f64> + Sample,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
        F::Out<f64>: Item<Scalar = f64> + Sample;
}
