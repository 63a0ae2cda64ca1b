//! Shared code of the examples.
pub mod cli;
mod failure;
pub mod file;
pub mod known;
pub mod random;
