//! Programs: generic functions, recorded once.
mod derivative;
pub(crate) mod evaluate;
mod forward;
pub(crate) mod graph;
pub(crate) mod record;
pub(crate) mod recorded;
mod recording;
mod reverse;
mod shapes;
mod simplify;
mod symbol;

pub use graph::Format;
pub use symbol::{Plain, Sym, SymMask};
