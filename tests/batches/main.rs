//! What batches on the CPU promise.
mod calls;
mod reduce;
