//! Shared code of the examples.
pub mod blend;
pub mod cli;
pub mod compute;
pub mod csv;
mod failure;
pub mod file;
pub mod known;
pub mod output;
pub mod painter;
pub mod positive;
pub mod progress;
pub mod random;
pub mod svg;
