//! The executor: instruction by instruction, each over a whole block of items.
//!
//! One function, compiled once per format and level of vector instructions. It is independent of programs and shapes.
//!
//! Memory is a list of slots, each some lanes of sixteen numbers, as cells. A result may overwrite an operand, since
//! every lane is read before it is written.
use crate::Real;
use crate::kernels::cpu::arch::{BoundCode, Native, Vector};
use crate::kernels::cpu::lane::{Lane, TILE, Tiles};
use crate::kernels::cpu::program::instructions::{Instruction, Opcode, instructions};
use crate::kernels::cpu::program::lower::Tape;
use std::cell::Cell;
use std::ops::Range;

/// The number of lanes that one turn of an instruction's loop computes. The number of lanes of a slot is a multiple of
/// it.
pub(crate) const STRIP: usize = 2;

/// Lanes of one turn.
pub(super) type Strip<T> = [Cell<Lane<T>>; STRIP];

/// The memory of a block: slots begin every `stride` lanes, and `width` lanes of each, a multiple of [`STRIP`], are in
/// use.
#[derive(Clone, Copy)]
pub(crate) struct Memory<'a, T> {
    pub(super) lanes: &'a [Cell<Lane<T>>],
    pub(super) width: usize,
    pub(super) stride: usize,
}

impl<'a, T> Memory<'a, T> {
    #[inline(always)]
    pub(super) fn slot(self, slot: u16) -> &'a [Strip<T>] {
        let from = slot as usize * self.stride;
        self.lanes[from..from + self.width].as_chunks().0
    }
}

/// Returns a lane of results, computed vector by vector.
#[inline(always)]
fn lane<T: Real, V: Vector<T>>(part: impl Fn(usize) -> V) -> Lane<T> {
    let mut out = Lane::default();
    let mut at = 0;
    while at < TILE {
        part(at).write(&mut out, at);
        at += V::WIDTH;
    }
    out
}

#[inline(always)]
fn one<T: Real, V: Vector<T>>(memory: Memory<'_, T>, code: Instruction, f: impl Fn(V) -> V) {
    let [a, ..] = code.from;
    for (a, to) in memory.slot(a).iter().zip(memory.slot(code.to[0])) {
        let mut k = 0;
        while k < STRIP {
            let a = a[k].get();
            to[k].set(lane(
                #[inline(always)]
                |at| f(V::read(&a, at)),
            ));
            k += 1;
        }
    }
}

#[inline(always)]
fn two<T: Real, V: Vector<T>>(memory: Memory<'_, T>, code: Instruction, f: impl Fn(V, V) -> V) {
    let [a, b, ..] = code.from;
    let from = memory.slot(a).iter().zip(memory.slot(b));
    for ((a, b), to) in from.zip(memory.slot(code.to[0])) {
        let mut k = 0;
        while k < STRIP {
            let (a, b) = (a[k].get(), b[k].get());
            to[k].set(lane(
                #[inline(always)]
                |at| f(V::read(&a, at), V::read(&b, at)),
            ));
            k += 1;
        }
    }
}

#[inline(always)]
fn three<T: Real, V: Vector<T>>(
    memory: Memory<'_, T>,
    code: Instruction,
    f: impl Fn(V, V, V) -> V,
) {
    let [a, b, c, _] = code.from;
    let from = memory.slot(a).iter().zip(memory.slot(b));
    for (((a, b), c), to) in from.zip(memory.slot(c)).zip(memory.slot(code.to[0])) {
        let mut k = 0;
        while k < STRIP {
            let (a, b, c) = (a[k].get(), b[k].get(), c[k].get());
            to[k].set(lane(
                #[inline(always)]
                |at| f(V::read(&a, at), V::read(&b, at), V::read(&c, at)),
            ));
            k += 1;
        }
    }
}

#[inline(always)]
fn four<T: Real, V: Vector<T>>(
    memory: Memory<'_, T>,
    code: Instruction,
    f: impl Fn(V, V, V, V) -> V,
) {
    let [a, b, c, d] = code.from;
    let (first, second) = (memory.slot(a).iter(), memory.slot(b));
    let (third, fourth) = (memory.slot(c), memory.slot(d));
    let from = first.zip(second).zip(third.iter().zip(fourth));
    for (((a, b), (c, d)), to) in from.zip(memory.slot(code.to[0])) {
        let mut k = 0;
        while k < STRIP {
            let (a, b, c, d) = (a[k].get(), b[k].get(), c[k].get(), d[k].get());
            to[k].set(lane(
                #[inline(always)]
                |at| {
                    let (x, y) = (V::read(&a, at), V::read(&b, at));
                    f(x, y, V::read(&c, at), V::read(&d, at))
                },
            ));
            k += 1;
        }
    }
}

/// Executes an instruction with several results.
#[inline(always)]
fn several<T: Real, V: Vector<T>, const A: usize, const N: usize>(
    memory: Memory<'_, T>,
    code: Instruction,
    f: impl Fn([V; A]) -> [V; N],
) {
    let lanes = |slot: u16| memory.slot(slot).as_flattened();
    let (mut from, mut to) = ([lanes(code.from[0]); A], [lanes(code.to[0]); N]);
    let mut k = 1;
    while k < A {
        from[k] = lanes(code.from[k]);
        k += 1;
    }
    k = 1;
    while k < N {
        to[k] = lanes(code.to[k]);
        k += 1;
    }
    for t in 0..memory.width {
        let mut operands = [Lane::default(); A];
        let mut k = 0;
        while k < A {
            operands[k] = from[k][t].get();
            k += 1;
        }
        let mut out = [Lane::default(); N];
        let mut at = 0;
        while at < TILE {
            let mut x = [V::zero(); A];
            let mut k = 0;
            while k < A {
                x[k] = V::read(&operands[k], at);
                k += 1;
            }
            let results = f(x);
            let mut k = 0;
            while k < N {
                results[k].write(&mut out[k], at);
                k += 1;
            }
            at += V::WIDTH;
        }
        let mut k = 0;
        while k < N {
            to[k][t].set(out[k]);
            k += 1;
        }
    }
}

/// The vectors of a block that need some instructions, a bit each, and where these end.
#[derive(Clone, Copy)]
struct Needed {
    vectors: u64,
    end: usize,
}

impl Needed {
    /// Returns the vectors of a block with an item that a truth does not excuse. It excuses where it holds (`all`), or
    /// where it does not. Of more than 64 vectors all are needed if one is.
    #[inline(always)]
    fn of<T: Real, V: Vector<T>>(memory: Memory<'_, T>, slot: u16, all: bool) -> u64 {
        let excused = if all { (1 << V::WIDTH) - 1 } else { 0 };
        let (mut vectors, mut place) = (0, 0);
        for lane in memory.slot(slot).as_flattened() {
            let lane = lane.get();
            let mut at = 0;
            while at < TILE {
                let is_needed = V::bits(V::read(&lane, at).truth()) != excused;
                vectors |= u64::from(is_needed) << (place % 64);
                place += 1;
                at += V::WIDTH;
            }
        }
        if place > 64 && vectors != 0 {
            return u64::MAX;
        }
        vectors
    }
    /// Passes the ranges of items whose vectors are needed at an instruction, of `width` items each; everything if machine
    /// code has vectors of another length. No item is passed twice, since code overwrites what it has read.
    #[inline(always)]
    fn ranges(self, at: usize, [width, own]: [usize; 2], mut pass: impl FnMut(Range<usize>)) {
        let all = at >= self.end || self.vectors == u64::MAX || width != own;
        let mut vectors = if all { 1 } else { self.vectors };
        while vectors != 0 {
            let first = vectors.trailing_zeros();
            let end = first + (vectors >> first).trailing_ones();
            vectors &= u64::MAX.checked_shl(end).unwrap_or(0);
            let end = if all {
                usize::MAX
            } else {
                end as usize * width
            };
            pass(first as usize * width..end);
        }
    }
}

/// Calls the loop for an instruction's number of operands.
macro_rules! by_arity {
    ($f:tt; $x:ident) => { one $f };
    ($f:tt; $x:ident, $y:ident) => { two $f };
    ($f:tt; $x:ident, $y:ident, $z:ident) => { three $f };
    ($f:tt; $x:ident, $y:ident, $z:ident, $w:ident) => { four $f };
}

/// A pass over a part of a block, with the source and destination of its numbers.
#[derive(Clone, Copy)]
pub(crate) struct Pass<'a, T> {
    /// The lanes of all slots.
    pub(crate) lanes: &'a [Cell<Lane<T>>],
    /// The number of lanes of a slot.
    pub(crate) stride: usize,
    /// The arguments.
    pub(crate) inputs: &'a [Tiles<'a, T>],
    /// The number of scalars of each argument.
    pub(crate) fields: &'a [usize],
    /// The first tile, of inputs and of results.
    pub(crate) first: usize,
    /// The number of tiles.
    pub(crate) tiles: usize,
    /// The distance from one tile of results to the next, and from one number to the next.
    pub(crate) steps: [usize; 2],
    /// `true` if zeros in results lose their signs.
    pub(crate) canonical: bool,
    /// The program's runs as machine code, if there are some.
    pub(crate) native: Option<&'a Native>,
    /// The executor of instructions: a kernel of its own, compiled once for every source of numbers.
    pub(crate) carry_out: CarryOut<T>,
}

/// A function that executes instructions on slots, or their runs as machine code.
pub(crate) type CarryOut<T> = fn(&[Instruction], Memory<'_, T>, Option<&BoundCode<'_, T>>);

#[inline(always)]
fn copied<T: Real, V: Vector<T>>(from: &Lane<T>) -> Lane<T> {
    let mut to = Lane::default();
    let mut at = 0;
    while at < TILE {
        V::read(from, at).write(&mut to, at);
        at += V::WIDTH;
    }
    to
}

/// Executes a program on a part of a block.
#[inline(always)]
pub(crate) fn interpret<T: Real, V: Vector<T>>(
    tape: &Tape,
    pass: Pass<'_, T>,
    out: &mut [Lane<T>],
) {
    let memory = Memory {
        lanes: pass.lanes,
        width: pass.tiles.next_multiple_of(STRIP),
        stride: pass.stride,
    };
    let mut places = tape.inputs.iter();
    for (argument, &fields) in pass.inputs.iter().zip(pass.fields) {
        for (k, slot) in places.by_ref().take(fields).enumerate() {
            let &Some(slot) = slot else { continue };
            for (t, lane) in memory.slot(slot).as_flattened().iter().enumerate() {
                // The padding of the last strip must be harmless: it repeats the last tile.
                let t = pass.first + t.min(pass.tiles - 1);
                if let Some(from) = argument.lanes.get(t * argument.step + k) {
                    lane.set(copied::<T, V>(from));
                }
            }
        }
    }
    let native = pass
        .native
        .and_then(|native| native.bind(pass.lanes, pass.tiles * TILE));
    (pass.carry_out)(&tape.code, memory, native.as_ref());
    let [by_tile, by_number] = pass.steps;
    for (k, &slot) in tape.outputs.iter().enumerate() {
        for (t, lane) in memory
            .slot(slot)
            .as_flattened()
            .iter()
            .enumerate()
            .take(pass.tiles)
        {
            let Some(to) = out.get_mut((pass.first + t) * by_tile + k * by_number) else {
                return;
            };
            let from = lane.get();
            let mut at = 0;
            while at < TILE {
                let x = V::read(&from, at);
                let x = if pass.canonical { x.canonical() } else { x };
                x.write(to, at);
                at += V::WIDTH;
            }
        }
    }
}

/// Executes instructions.
#[inline(always)]
pub(crate) fn carry_out<T: Real, V: Vector<T>>(
    code: &[Instruction],
    memory: Memory<'_, T>,
    native: Option<&BoundCode<'_, T>>,
) {
    let mut runs = native.map_or(&[][..], BoundCode::runs);
    let (mut next, mut needed) = (0, Needed { vectors: 0, end: 0 });
    loop {
        if let (Some(native), Some((run, others))) = (native, runs.split_first())
            && run.from <= next
        {
            // A jump may have skipped the run.
            if run.from == next {
                needed.ranges(next, [V::WIDTH, native.vector()], |items| {
                    native.run(run, memory.width, items)
                });
                next = run.to;
            }
            runs = others;
            continue;
        }
        let Some(&code) = code.get(next) else {
            return;
        };
        next += 1;
        /// One arm per instruction.
        macro_rules! arms {
            ($($name:ident($x:ident $(, $more:ident)*) = $value:expr;)*) => {
                match code.op {
                    $(Opcode::$name => by_arity!((memory, code,
                        #[inline(always)]
                        |$x: V $(, $more: V)*| $value); $x $(, $more)*),)*
                    Opcode::Parts => several(memory, code,
                        #[inline(always)]
                        |[x]: [V; 1]| {
                            let [(a, b), (c, d)] = x.sin_cos_parts();
                            [a, b, c, d]
                        }),
                    Opcode::SinCos => several(memory, code,
                        #[inline(always)]
                        |[x]: [V; 1]| {
                            let (sin, cos) = x.sin_cos();
                            [sin, cos]
                        }),
                    Opcode::Turn => several(memory, code,
                        #[inline(always)]
                        |[x, y, z, w]: [V; 4]| [x * z + y * w, y * z - x * w]),
                    Opcode::SumSub => several(memory, code,
                        #[inline(always)]
                        |[x, y]: [V; 2]| [x + y, x - y]),
                    Opcode::SkipIfAll | Opcode::SkipIfNone => {
                        let end = next + code.to[0] as usize;
                        let all = code.op == Opcode::SkipIfAll;
                        let vectors = Needed::of::<T, V>(memory, code.from[0], all);
                        needed = Needed { vectors, end };
                        if vectors == 0 {
                            next = end;
                        }
                    }
                }
            };
        }
        instructions! { arms!() }
    }
}
