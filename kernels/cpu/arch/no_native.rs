//! Builds without machine code: of other processors, or without the feature `native`.
use crate::kernels::cpu::lane::Lane;
use crate::kernels::cpu::program::{Run, Tape};
use crate::kernels::cpu::simd::Simd;
use std::cell::Cell;

/// A program as machine code, of which there is none.
#[derive(Debug)]
pub(crate) enum Native {}

impl Native {
    /// Nothing: the interpreter carries out all instructions.
    pub(crate) fn new<T>(_: &Tape, _: usize, _: Simd) -> Option<Self> {
        None
    }
    pub(crate) fn runs(&self) -> &[Run] {
        match *self {}
    }
    pub(crate) fn run<T>(&self, _: &Run, _: &[Cell<Lane<T>>], _: usize) {
        match *self {}
    }
}
