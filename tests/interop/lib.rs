//! Every feature that connects another library is executed here.
#![cfg(test)]

mod conversions;
mod serialized;
mod strategies;
mod vector_duals;
