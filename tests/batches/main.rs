//! Batches on the CPU.
mod bits;
mod calls;
mod declared;
mod dynamic;
mod fold;
#[cfg(feature = "fuzzers")]
mod fuzz;
mod jacobian;
mod memory;
mod names;
mod polygon;
mod program;
mod reduce;
mod search;
mod shapes;
mod spellings;
mod straight;
mod verbs;
mod widths;
