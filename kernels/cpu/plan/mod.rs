//! How batches compute an operation: what is prepared once per shape, what is computed per pair.
mod compiled;
mod face;
mod known;
mod line;
mod list;
mod recorded;

pub use compiled::Compiled;
pub(crate) use face::name;
pub(crate) use face::with_jacobian;
pub use face::{Face, Maker, Preparation, Rare, Want};
pub use known::face_of;
#[cfg(feature = "gpu")]
pub(crate) use known::generated;
#[cfg(feature = "gpu")]
pub use known::generated_of;
pub(crate) use known::{Known, faced, known, program_of, recorded_of};
pub(crate) use line::{Line, Shaped};
pub use list::List;
#[cfg(feature = "gpu")]
pub(crate) use recorded::prepared;
pub(crate) use recorded::{of_items, of_recorded};
