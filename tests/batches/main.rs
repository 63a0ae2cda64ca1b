//! What batches on the CPU promise.
mod bits;
mod calls;
mod fold;
mod fuzz;
mod polygon;
mod program;
mod reduce;
mod straight;
