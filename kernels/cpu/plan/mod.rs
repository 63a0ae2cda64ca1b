//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
mod call;
mod compiled;
mod face;
mod list;
mod recorded;

pub(crate) use call::plan;
pub use compiled::Compiled;
pub(crate) use face::name;
pub use face::{Face, Maker, Preparation, Rare};
pub use list::List;
#[cfg(feature = "gpu")]
pub(crate) use recorded::prepared;
pub(crate) use recorded::{of_items, of_recorded};
