//! An interpreter of recorded programs: makers of blocks.
//!
//! A program's graph becomes a tape of instructions (`lower`), each of which computes one number of every item of a
//! block from others. Choosing an instruction costs about as much as a hundred items of it, so blocks are as long as
//! the innermost cache allows. The compiled interpreter depends on the format and the level of vector instructions
//! only; all levels give equal bits.
//!
//! After a thousand items the instructions between two calls of elementary functions become machine code (`native`),
//! where the system allows it.
pub(crate) mod execute;
mod fuse;
pub(crate) mod instructions;
pub(crate) mod lower;
pub mod measured;
#[cfg(all(target_arch = "x86_64", feature = "native", not(geograd_portable)))]
pub(crate) mod native;
pub(crate) mod rowwise;
mod skip;
mod slots;
pub(crate) mod split;

use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::arch::Native;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, PLANE, ResultTiles, TILE, Tiles, with_room};
use crate::kernels::cpu::maker::{Maker, OverRows};
use crate::kernels::cpu::simd::Simd;
use crate::{Real, Unrecordable};
use execute::Pass;
use execute::STRIP;
pub use lower::Skipping;
pub(crate) use lower::Tape;
use rowwise::{ArgumentRows, ResultRows, RowRange};
use std::cell::Cell;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// The size of a slot in bytes. Smaller slots make the dispatch of instructions dominate; larger ones overflow the
/// innermost cache.
const SLOT: usize = 1 << 10;

/// A program that computes blocks of items.
#[derive(Debug)]
pub(crate) struct Interpreter {
    tape: Tape,
    /// The number of scalars of each argument.
    fields: Vec<usize>,
    /// The number of this program, unique in the process.
    number: u64,
    /// The number of lanes of a slot, if a test sets it.
    width: Option<usize>,
    /// The machine code of each level above the baseline, for tiles and for rows, compiled when it pays.
    native: [OnceLock<Option<Native>>; 4],
    /// The number of tiles computed by interpretation.
    done: AtomicUsize,
}

/// The number of tiles after which a program is compiled: compiling costs about as much as sixteen times as many.
static WORTH: AtomicUsize = AtomicUsize::new(64);

/// Sets the number of tiles after which programs become machine code, for tests.
pub(crate) fn compile_after(tiles: usize) {
    WORTH.store(tiles, Ordering::Relaxed);
}

impl Interpreter {
    /// Translates a graph without grafts. Its inputs are the numbers of all arguments, one argument after another.
    /// `skipping` says when a block may skip nodes that none of its items needs.
    ///
    /// # Errors
    ///
    /// If more numbers are live at a time than instructions can name.
    pub(crate) fn new(
        graph: &Graph,
        fields: &[usize],
        outputs: &[Id],
        skipping: Skipping,
    ) -> Result<Self, Unrecordable> {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        // Zeros lose their signs in results.
        let plain = |&x: &Id| match graph.at(x) {
            Node::Canonical(x) => x,
            _ => x,
        };
        let outputs: Vec<Id> = outputs.iter().map(plain).collect();
        Ok(Interpreter {
            tape: Tape::new(graph, fields.iter().sum(), &outputs, skipping)?,
            fields: fields.to_vec(),
            number: NEXT.fetch_add(1, Ordering::Relaxed),
            width: None,
            native: [const { OnceLock::new() }; 4],
            done: AtomicUsize::new(0),
        })
    }
    /// Returns the program with at most `width` lanes per slot, an even number.
    pub(crate) fn with_width(mut self, width: usize) -> Self {
        self.width = Some(width.next_multiple_of(STRIP));
        self
    }
    /// Returns the program as machine code from the first item on, or never as such.
    pub(crate) fn with_native(mut self, native: bool) -> Self {
        *self.done.get_mut() = if native { usize::MAX / 2 } else { 0 };
        if !native {
            self.native = [const { OnceLock::new() }; 4].map(|made| {
                made.get_or_init(|| None);
                made
            });
        }
        self
    }
    /// Returns the machine code if the program has computed enough tiles; counts `tiles` more.
    fn native<T: Real>(&self, tiles: usize, of_rows: bool) -> Option<&Native> {
        let level = Simd::in_use();
        let number = match level {
            Simd::Baseline => return None,
            Simd::Avx2 => 0,
            Simd::V4 => 1,
        };
        let made = &self.native[number + 2 * usize::from(of_rows)];
        if let Some(made) = made.get() {
            return made.as_ref();
        }
        if self.done.fetch_add(tiles, Ordering::Relaxed) < WORTH.load(Ordering::Relaxed) {
            return None;
        }
        let new = || Native::new::<T>(&self.tape, self.stride::<T>(), level, of_rows);
        made.get_or_init(new).as_ref()
    }
    /// Returns the numbers of instructions and of slots.
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.tape.code.len(), self.tape.slots)
    }
    /// Returns the instructions.
    pub(crate) fn tape(&self) -> &Tape {
        &self.tape
    }
    /// Returns the number of lanes of a slot.
    fn width<T>(&self) -> usize {
        self.width.unwrap_or(SLOT / size_of::<Lane<T>>())
    }
    /// Returns the number of lanes from a slot to the next. A power of two would put the numbers of an item into a few
    /// sets of the innermost cache, which then holds 32 slots of hundreds.
    fn stride<T>(&self) -> usize {
        self.width::<T>() + 1
    }
    /// Returns slots, with the constants in theirs.
    fn furnished<T: Real>(&self) -> Vec<Lane<T>> {
        let stride = self.stride::<T>();
        let mut lanes = vec![Lane::default(); self.tape.slots * stride];
        for &(slot, constant) in &self.tape.constants {
            let from = slot as usize * stride;
            lanes[from..from + stride].fill(Lane([T::lit(constant); _]));
        }
        lanes
    }
    /// Computes `tiles` tiles of results. Number `k` of tile `t` goes to `out[t * steps[0] + k * steps[1]]`.
    fn compute<T: Real>(
        &self,
        inputs: &[Tiles<'_, T>],
        tiles: usize,
        out: &mut [Lane<T>],
        steps: [usize; 2],
        canonical: bool,
    ) {
        let furnish = || self.furnished();
        let native = self.native::<T>(tiles, false);
        let width = self.width::<T>();
        with_room(self.number, furnish, |lanes| {
            let lanes = Cell::from_mut(lanes).as_slice_of_cells();
            for first in (0..tiles).step_by(width) {
                let pass = Pass {
                    lanes,
                    stride: self.stride::<T>(),
                    inputs,
                    fields: &self.fields,
                    steps,
                    canonical,
                    first,
                    tiles: width.min(tiles - first),
                    native,
                    carry_out: kernels_in::<T>().carry_out,
                };
                (kernels_in::<T>().interpret)(&self.tape, pass, out);
            }
        });
    }
    /// Computes the prepared form of shapes: as many tiles as `out` has room for, one after another, field by field.
    /// Zeros may keep their signs.
    pub(crate) fn prepare<T: Real>(&self, inputs: &[Tiles<'_, T>], out: &mut [Lane<T>]) {
        let numbers = self.tape.outputs.len();
        let tiles = out.len() / numbers.max(1);
        self.compute(inputs, tiles, out, [numbers, 1], false);
    }
}

impl<T: Real> OverRows<T> for Interpreter {
    fn over_rows(
        &self,
        given: &[ArgumentRows<'_, T>],
        items: usize,
        skipped: usize,
        wanted: &mut [ResultRows<'_, T>],
        far: bool,
    ) {
        let native = self.native::<T>(items.div_ceil(TILE), true);
        let width = self.width::<T>();
        let furnish = || self.furnished();
        with_room(self.number, furnish, |lanes| {
            let lanes = Cell::from_mut(lanes).as_slice_of_cells();
            for first in (0..items).step_by(width * TILE) {
                let part = RowRange {
                    lanes,
                    stride: self.stride::<T>(),
                    given,
                    first,
                    items: (width * TILE).min(items - first),
                    skipped,
                    far,
                    native,
                    carry_out: kernels_in::<T>().carry_out,
                };
                (kernels_in::<T>().over_rows)(&self.tape, part, wanted);
            }
        });
    }
}

impl<T: Real> Maker<T> for Interpreter {
    fn rows(&self) -> Option<&dyn OverRows<T>> {
        Some(self)
    }
    fn make(&self, inputs: &[Tiles<'_, T>], out: ResultTiles<'_, T>) {
        self.compute(inputs, out.tiles, out.lanes, [1, PLANE], true);
    }
}
