//! Programs: generic functions, recorded once.
mod cost;
mod derivative;
pub(crate) mod evaluate;
mod forward;
pub(crate) mod graph;
mod print;
#[allow(clippy::module_inception)]
mod program;
pub(crate) mod record;
pub(crate) mod recorded;
mod recording;
mod reverse;
mod shapes;
mod simplify;
mod symbol;
mod wgsl;

pub use cost::Cost;
pub use graph::Format;
pub use program::Program;
pub use symbol::{Plain, Sym, SymMask};
pub use wgsl::WGSL;
