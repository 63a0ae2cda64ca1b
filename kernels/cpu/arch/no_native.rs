//! Builds without machine code: of other processors, or without the feature `native`.
use crate::kernels::cpu::lane::Lane;
use crate::kernels::cpu::program::instructions::CodeRun;
use crate::kernels::cpu::program::lower::Tape;
use crate::kernels::cpu::simd::Simd;
use std::cell::Cell;
use std::marker::PhantomData;
use std::ops::Range;

/// The machine code of a program, which does not exist in this build.
#[derive(Debug)]
pub(crate) enum Native {}

impl Native {
    /// Returns `None`: the interpreter executes all instructions.
    #[expect(
        clippy::extra_unused_type_parameters,
        reason = "the format, as with machine code"
    )]
    pub(crate) fn new<T>(_: &Tape, _: usize, _: Simd, _: bool) -> Option<Self> {
        None
    }
    pub(crate) fn has_input(&self, _: usize) -> bool {
        match *self {}
    }
    pub(crate) fn has_output(&self, _: usize) -> bool {
        match *self {}
    }
    pub(crate) fn bind<'a, T>(
        &'a self,
        _: &'a [Cell<Lane<T>>],
        _: usize,
    ) -> Option<BoundCode<'a, T>> {
        match *self {}
    }
}

/// Machine code with its memory, which does not exist in this build.
pub(crate) struct BoundCode<'a, T>(&'a Native, PhantomData<&'a mut [T]>);

impl<'a, T> BoundCode<'a, T> {
    pub(crate) fn runs(&self) -> &'a [CodeRun] {
        match *self.0 {}
    }
    pub(crate) fn vector(&self) -> usize {
        match *self.0 {}
    }
    pub(crate) fn lend(&mut self, _: usize, _: &'a [T]) {
        match *self.0 {}
    }
    pub(crate) fn lend_mut(&mut self, _: usize, _: &'a mut [T]) {
        match *self.0 {}
    }
    pub(crate) fn run(&self, _: &CodeRun, _: usize, _: Range<usize>) {
        match *self.0 {}
    }
}
