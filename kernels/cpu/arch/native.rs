//! Machine code of recorded programs, in memory that the processor may execute.
//!
//! The interpreter carries out an instruction for a whole block, so every value goes through memory. In machine code
//! values stay in registers: users' functions of six to fourteen numbers with derivatives take half the time
//! (`BENCHMARKS.md`, Python). Systems that refuse executable memory keep the interpreter, with equal bits.
//!
//! # Why it is sound
//!
//! [`compile`] alone writes the code: packed arithmetic between vector registers, loads and stores at `slot + offset`
//! and `table[k] + offset`, one loop, no other jump. Slots are below the tape's count, the offset below the bytes in
//! use, and [`Native::bind`] refuses memory for fewer slots. Every address in the table is that of a slot or of numbers
//! borrowed by a [`BoundCode`]. [`BoundCode::run`] requires at least as many of these as a slot has in use; it moves all
//! addresses by the items before the first one, and ends where that many items end. The code
//! writes to mutably borrowed numbers only. It uses registers that its calling convention leaves to it, and the
//! instructions of a level that the processor has.
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::cpu::program::instructions::CodeRun;
use crate::kernels::cpu::program::lower::Tape;
use crate::kernels::cpu::program::native::{Encoder, MOST, compile};
use crate::kernels::cpu::simd::Simd;
use memmap2::{Mmap, MmapMut};
use std::cell::Cell;
use std::marker::PhantomData;
use std::ops::Range;

/// The machine code of a program's runs of instructions.
#[derive(Debug)]
pub(crate) struct Native {
    code: Mmap,
    runs: Vec<CodeRun>,
    /// For each address in the table the slot that it stands for, inputs first; `None` for an address that the code
    /// does not use.
    table: Vec<Option<u16>>,
    inputs: usize,
    /// The numbers of lanes of all slots, and of one.
    lanes: usize,
    stride: usize,
    /// The size of a number in bytes, and how many a vector has.
    number: usize,
    vector: usize,
}

impl Native {
    /// Compiles the runs of a program whose slots begin every `stride` lanes. Returns `None` without runs, at the
    /// baseline, or if the system refuses the memory. Code of rows reads inputs and writes results in place, and writes
    /// zeros without a sign.
    pub(crate) fn new<T>(tape: &Tape, stride: usize, level: Simd, of_rows: bool) -> Option<Self> {
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
        let (code, runs, far) = compile(out, tape, bytes, of_rows);
        if runs.is_empty() {
            return None;
        }
        let mut memory = MmapMut::map_anon(code.len()).ok()?;
        memory.copy_from_slice(&code);
        Some(Native {
            code: memory.make_exec().ok()?,
            runs,
            table: far.table(tape),
            inputs: tape.inputs.len(),
            lanes: tape.slots * stride,
            stride,
            number,
            vector: if is_512 { 64 } else { 32 } / number,
        })
    }
    /// Returns `true` if the code can read input `k` in place.
    pub(crate) fn has_input(&self, k: usize) -> bool {
        self.table.get(k).is_some_and(Option::is_some)
    }
    /// Returns `true` if the code can write result `k` in place.
    pub(crate) fn has_output(&self, k: usize) -> bool {
        self.has_input(self.inputs + k)
    }
    /// Returns the code with the memory of its slots, for so many items; `None` if the memory has another size than the
    /// code expects.
    #[inline]
    pub(crate) fn bind<'a, T>(
        &'a self,
        lanes: &'a [Cell<Lane<T>>],
        items: usize,
    ) -> Option<BoundCode<'a, T>> {
        if lanes.len() < self.lanes || self.number != size_of::<T>() {
            return None;
        }
        let mut table = [std::ptr::null_mut(); MOST];
        for (address, slot) in table.iter_mut().zip(&self.table) {
            if let &Some(slot) = slot {
                *address = lanes[slot as usize * self.stride].as_ptr().cast();
            }
        }
        Some(BoundCode {
            native: self,
            lanes,
            items,
            table,
            lent: usize::MAX,
            lender: PhantomData,
        })
    }
}

/// Machine code with the memory that it reads and writes.
pub(crate) struct BoundCode<'a, T> {
    native: &'a Native,
    lanes: &'a [Cell<Lane<T>>],
    /// The number of items. The code leaves the numbers of further ones as they were.
    items: usize,
    /// Addresses of inputs and results.
    table: [*mut T; MOST],
    /// The least length of a borrowed input or result.
    lent: usize,
    lender: PhantomData<&'a mut [T]>,
}

impl<'a, T> BoundCode<'a, T> {
    /// Returns the runs in order.
    pub(crate) fn runs(&self) -> &'a [CodeRun] {
        &self.native.runs
    }
    /// Returns the number of items of a vector.
    pub(crate) fn vector(&self) -> usize {
        self.native.vector
    }
    /// Makes the code read input `k` in place, if it [can](Native::has_input).
    #[inline]
    pub(crate) fn lend(&mut self, k: usize, numbers: &'a [T]) {
        self.table[k] = numbers.as_ptr().cast_mut();
        self.lent = self.lent.min(numbers.len());
    }
    /// Makes the code write result `k` in place, if it [can](Native::has_output).
    #[inline]
    pub(crate) fn lend_mut(&mut self, k: usize, numbers: &'a mut [T]) {
        self.lent = self.lent.min(numbers.len());
        self.table[self.native.inputs + k] = numbers.as_mut_ptr();
    }
    /// Executes a run on the vectors that hold some items, in `width` lanes of every slot.
    #[inline]
    pub(crate) fn run(&self, run: &CodeRun, width: usize, items: Range<usize>) {
        // The lanes and the borrowed numbers must have that many vectors, or the code would write beyond them.
        let fits = (1..=self.native.stride).contains(&width) && width * TILE <= self.lent;
        if !fits {
            return;
        }
        // The code computes one vector at least, and none that begins at the end or later.
        let first = items.start / self.native.vector * self.native.vector;
        let end = items.end.min(self.items).min(width * TILE);
        if first >= end {
            return;
        }
        let bytes = size_of::<T>() * (end - first);
        let mut table = self.table;
        for address in &mut table[..self.native.table.len().min(MOST)] {
            *address = address.wrapping_add(first);
        }
        let first = self.lanes.as_ptr().cast::<T>().wrapping_add(first);
        let first = first.cast::<u8>().cast_mut();
        // Sound: the module says why. Cells may be written through a shared reference.
        unsafe {
            let entry = self.native.code.as_ptr().add(run.entry);
            let function = std::mem::transmute::<
                *const u8,
                extern "sysv64" fn(*mut u8, usize, *const *mut T),
            >(entry);
            function(first, bytes, table.as_ptr());
        }
    }
}
