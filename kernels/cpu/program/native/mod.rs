//! Recorded programs as machine code of x86-64.
mod compile;
mod encode;

pub(crate) use compile::compile;
pub(crate) use encode::Encoder;
