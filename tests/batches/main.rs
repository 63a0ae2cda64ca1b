//! What batches on the CPU promise.
mod bits;
mod calls;
mod dynamic;
mod fold;
#[cfg(feature = "fuzzers")]
mod fuzz;
mod memory;
mod polygon;
mod program;
mod promised;
mod reduce;
mod search;
mod spellings;
mod straight;
mod verbs;
