//! Every row of geograd's list in both formats: a crate of its own, so that a change of the binding compiles none of them.
#![forbid(unsafe_code)]
use geograd::kernels::dynamic::Operation;

/// Every operation of the list.
#[must_use]
// Inlined, it would compile every row in the crate that calls it.
#[inline(never)]
pub fn operations() -> &'static [Operation] {
    geograd::kernels::dynamic::operations()
}
