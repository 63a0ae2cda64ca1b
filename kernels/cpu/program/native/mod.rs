//! Recorded programs as machine code of x86-64.
mod compile;
mod encode;
mod events;
mod far;

pub(crate) use compile::compile;
pub(crate) use encode::Encoder;
pub(crate) use far::MOST;
