//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
mod call;
mod compiled;
mod computation;
mod makers;
mod prepared;

pub(crate) use call::plan;
pub use compiled::Compiled;
pub(crate) use computation::Maker;
pub(crate) use computation::name;
pub use computation::{Face, Preparation, Rare};
#[cfg(feature = "gpu")]
pub(crate) use makers::prepared;
pub(crate) use makers::{of_items, of_recorded};
pub use prepared::{List, Shapes};
