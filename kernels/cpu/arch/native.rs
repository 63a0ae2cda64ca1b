//! Machine code of recorded programs, in memory that the processor may execute.
//!
//! The interpreter carries out an instruction for a whole block, so every value goes through memory. Compiled to machine
//! code values stay in registers: own functions of six to fourteen numbers with derivatives take half the time
//! (`BENCHMARKS.md`, Python). Systems that refuse executable memory keep the interpreter, with the same bits.
//!
//! # Why it is sound
//!
//! [`compile`] alone writes the code: packed arithmetic between vector registers, loads and stores
//! at `slot + offset`, one loop, no other jump. Slots are below the tape's count, the offset below the bytes in use, and
//! [`Native::run`] refuses lanes that hold fewer slots. The code uses registers that its calling convention leaves to it, and the
//! instructions of a level that the processor has.
use crate::kernels::cpu::lane::Lane;
use crate::kernels::cpu::program::native::{Encoder, compile};
use crate::kernels::cpu::program::{Run, Tape};
use crate::kernels::cpu::simd::Simd;
use memmap2::{Mmap, MmapMut};
use std::cell::Cell;

/// A program's runs of instructions as functions.
#[derive(Debug)]
pub(crate) struct Native {
    code: Mmap,
    runs: Vec<Run>,
    /// Lanes of all slots, and of one.
    lanes: usize,
    stride: usize,
    /// Bytes of a number.
    number: usize,
}

impl Native {
    /// The runs of a program whose slots begin every `stride` lanes; `None` without any, at the baseline, or if the
    /// system refuses the memory.
    pub(crate) fn new<T>(tape: &Tape, stride: usize, level: Simd) -> Option<Self> {
        let number = size_of::<T>();
        let is_512 = match level {
            Simd::Baseline => return None,
            Simd::Avx2 => false,
            Simd::V4 => true,
        };
        let bytes = stride * size_of::<Lane<T>>();
        // Slots are addressed by 31 bits.
        i32::try_from(tape.slots * bytes).ok()?;
        let out = Encoder::new(is_512, number == 8);
        let (code, runs) = compile(out, &tape.code, &tape.outputs, bytes);
        if runs.is_empty() {
            return None;
        }
        let mut memory = MmapMut::map_anon(code.len()).ok()?;
        memory.copy_from_slice(&code);
        Some(Native {
            code: memory.make_exec().ok()?,
            runs,
            lanes: tape.slots * stride,
            stride,
            number,
        })
    }
    /// The runs, the first one first.
    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }
    /// Carries out a run on some lanes of every slot.
    #[inline]
    pub(crate) fn run<T>(&self, run: &Run, lanes: &[Cell<Lane<T>>], width: usize) {
        // As many vectors as the lanes have, or the code would write beyond them.
        let fits = lanes.len() >= self.lanes && width <= self.stride && width > 0;
        if !fits || self.number != size_of::<T>() {
            return;
        }
        let bytes = width * size_of::<Lane<T>>();
        let first = lanes.as_ptr().cast::<u8>().cast_mut();
        // Sound: the module says why. Cells may be written through a shared reference.
        unsafe {
            let entry = self.code.as_ptr().add(run.entry);
            let function =
                std::mem::transmute::<*const u8, extern "sysv64" fn(*mut u8, usize)>(entry);
            function(first, bytes);
        }
    }
}
