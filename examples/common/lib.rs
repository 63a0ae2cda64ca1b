//! Shared code of the examples.
pub mod cli;
pub mod compute;
pub mod csv;
mod failure;
pub mod file;
pub mod known;
pub mod output;
pub mod progress;
pub mod random;
pub mod svg;
