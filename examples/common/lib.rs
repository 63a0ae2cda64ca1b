//! What the examples share.
pub mod cli;
mod failure;
pub mod file;
pub mod known;
pub mod random;
