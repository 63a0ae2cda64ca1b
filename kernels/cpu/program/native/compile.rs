//! The compiler from instructions of the interpreter to machine code: one run at a time, with values in registers.
//!
//! Every value has a slot in memory, as in the interpreter. Within a run it stays in a register while there are enough.
//! It is stored when its register is needed, or if a later run reads it. For rows, inputs and results may be read and
//! written in place; [`Far`] has the conditions.
use super::encode::{
    AT_MOST, BinaryOpcode, EQUAL, Encoder, LESS, NOT_AT_MOST, NOT_LESS, Operand, Writemask,
};
use super::events::{Events, events, sizes};
use super::far::Far;
use crate::kernels::cpu::program::instructions::AHEAD;
use crate::kernels::cpu::program::instructions::CodeRun;
use crate::kernels::cpu::program::instructions::{Instruction, Opcode};
use crate::kernels::cpu::program::lower::Tape;
use crate::kernels::row::item::STRETCH;

/// The least length of a run; the interpreter executes shorter ones.
const SHORTEST: usize = 3;

/// Returns `true` for function calls and jumps, which the interpreter executes.
fn is_left(op: Opcode) -> bool {
    matches!(
        op,
        Opcode::Parts
            | Opcode::SinCos
            | Opcode::Exp
            | Opcode::Ln
            | Opcode::Atan2
            | Opcode::SkipIfAll
            | Opcode::SkipIfNone
    )
}

/// Returns the runs of a list of instructions. No jump ends inside one.
fn runs(code: &[Instruction]) -> Vec<[usize; 2]> {
    let mut targets = Vec::new();
    for (i, own) in code.iter().enumerate() {
        if matches!(own.op, Opcode::SkipIfAll | Opcode::SkipIfNone) {
            targets.push(i + 1 + own.to[0] as usize);
        }
    }
    let (mut all, mut from) = (Vec::new(), 0);
    for i in 0..=code.len() {
        let ends = code.get(i).is_none_or(|own| is_left(own.op));
        if ends || targets.contains(&i) {
            if i - from >= SHORTEST {
                all.push([from, i]);
            }
            from = if ends { i + 1 } else { i };
        }
    }
    all
}

/// The next read of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NextRead {
    /// By an instruction of the run.
    Read(usize),
    /// After the run.
    Later,
    Never,
}

/// The compiler of one run: registers and code.
struct Compiler<'a> {
    out: &'a mut Encoder,
    events: &'a Events,
    /// The slots that are read after all instructions.
    outputs: &'a [u16],
    far: &'a Far,
    /// The end of the run.
    end: usize,
    /// The distance in bytes from a slot to the next.
    stride: usize,
    /// For each register the slot whose value it holds; `true` if the slot is out of date.
    held: Vec<Option<(u16, bool)>>,
    /// For each register: `true` if the current instruction uses it.
    pinned: Vec<bool>,
    /// The current instruction.
    at: usize,
}

impl Compiler<'_> {
    /// Returns when a slot's present value is read after instruction `after`.
    fn next(&self, slot: u16, after: usize) -> NextRead {
        let events = self.events.get(&slot).map_or(&[][..], Vec::as_slice);
        let from = events.partition_point(|event| event.0 <= after);
        match events.get(from) {
            Some(&(at, true)) if at < self.end => NextRead::Read(at),
            Some((_, true)) => NextRead::Later,
            Some((_, false)) => NextRead::Never,
            None if self.outputs.contains(&slot) => NextRead::Later,
            None => NextRead::Never,
        }
    }
    fn place(&self, slot: u16) -> i32 {
        (slot as usize * self.stride) as i32
    }
    /// Returns the location of a slot's present value in memory.
    fn home(&self, slot: u16) -> Operand {
        match self.far.input(slot, self.at) {
            Some(k) => Operand::Far(k),
            None => Operand::Slot(self.place(slot)),
        }
    }
    fn find(&self, slot: u16) -> Option<u8> {
        let found = self
            .held
            .iter()
            .position(|held| held.is_some_and(|held| held.0 == slot));
        found.map(|register| register as u8)
    }
    /// Takes a register for a new value, pinned during the instruction.
    fn fresh(&mut self) -> u8 {
        let free = |k: &usize| self.held[*k].is_none() && !self.pinned[*k];
        let found = (0..self.held.len()).find(free);
        let register = found.unwrap_or_else(|| self.evict());
        self.pinned[register] = true;
        register as u8
    }
    /// Frees the register whose value is read latest.
    fn evict(&mut self) -> usize {
        let distance = |k: usize| match self.held[k].map(|held| self.next(held.0, self.at)) {
            Some(NextRead::Read(at)) => at,
            Some(NextRead::Later) => self.end,
            Some(NextRead::Never) | None => usize::MAX,
        };
        // One register is never pinned: no instruction uses all of them.
        let last = (0..self.held.len())
            .filter(|&k| !self.pinned[k])
            .max_by_key(|&k| distance(k))
            .unwrap_or_default();
        if let Some((slot, true)) = self.held[last].take()
            && self.next(slot, self.at) != NextRead::Never
        {
            let place = self.place(slot);
            self.out.store(last as u8, place);
        }
        last
    }
    /// Returns the register of an operand, loaded if necessary.
    fn register(&mut self, slot: u16) -> u8 {
        let register = match self.find(slot) {
            Some(register) => register,
            None => {
                let register = self.fresh();
                let home = self.home(slot);
                self.out.load(register, home);
                self.prefetch(home);
                self.held[register as usize] = Some((slot, false));
                register
            }
        };
        self.pinned[register as usize] = true;
        register
    }
    /// Prefetches the next stretch of an input, at the current offset. The current stretch is in the cache, since it
    /// was checked just before.
    fn prefetch(&mut self, home: Operand) {
        if let Operand::Far(_) = home {
            let size = if self.out.is_double() { 8 } else { 4 };
            self.out.prefetch(STRETCH * size, false);
        }
    }
    /// Returns an operand where it is; loads one that the run reads again.
    fn operand(&mut self, slot: u16) -> Operand {
        match (self.find(slot), self.next(slot, self.at)) {
            (None, NextRead::Later | NextRead::Never) => {
                let home = self.home(slot);
                self.prefetch(home);
                home
            }
            _ => Operand::Register(self.register(slot)),
        }
    }
    /// Ends an instruction: frees registers of values without further reads, and assigns registers to results.
    fn finish(&mut self, results: &[(u16, u8)]) {
        for &(slot, register) in results {
            self.store_results(slot, register);
        }
        self.pinned.fill(false);
        for k in 0..self.held.len() {
            let Some((slot, _)) = self.held[k] else {
                continue;
            };
            let is_over = results.iter().any(|result| result.0 == slot);
            if is_over || self.next(slot, self.at) == NextRead::Never {
                self.held[k] = None;
            }
        }
        for &(slot, register) in results {
            if self.next(slot, self.at) != NextRead::Never {
                self.held[register as usize] = Some((slot, true));
            }
        }
    }
    /// Stores a value to every result that it is. Adding zero removes the sign from zeros.
    fn store_results(&mut self, slot: u16, register: u8) {
        let far = self.far;
        let places = far.outputs(slot, self.at);
        if places.is_empty() {
            return;
        }
        let zero = self.number(0.0);
        let to = match self.next(slot, self.at) {
            NextRead::Never => register,
            NextRead::Read(_) | NextRead::Later => self.fresh(),
        };
        self.out.two(BinaryOpcode::Add, to, register, zero);
        for &k in places {
            self.out.store_far(to, k);
            self.out.prefetch(AHEAD, true);
        }
    }
    /// Stores all values that are read later.
    fn flush(&mut self) {
        for k in 0..self.held.len() {
            if let Some((slot, true)) = self.held[k].take()
                && self.next(slot, self.at) != NextRead::Never
            {
                let place = self.place(slot);
                self.out.store(k as u8, place);
            }
        }
    }

    /// Returns a constant from its bits in both formats.
    fn bits(&mut self, single: u32, double: u64) -> Operand {
        let twice = u64::from(single) << 32 | u64::from(single);
        let bits = if self.out.is_double() { double } else { twice };
        self.out.constant(bits)
    }
    fn number(&mut self, x: f64) -> Operand {
        self.bits((x as f32).to_bits(), x.to_bits())
    }
    fn sign(&mut self) -> Operand {
        self.number(-0.0)
    }
    fn zero(&mut self) -> u8 {
        let zero = self.fresh();
        self.out
            .two(BinaryOpcode::Xor, zero, zero, Operand::Register(zero));
        zero
    }
    fn two(&mut self, op: BinaryOpcode, a: u8, b: Operand) -> u8 {
        let to = self.fresh();
        self.out.two(op, to, a, b);
        to
    }
    fn negated(&mut self, x: u16) -> u8 {
        let (x, sign) = (self.register(x), self.sign());
        self.two(BinaryOpcode::Xor, x, sign)
    }
    fn magnitude(&mut self, x: u16) -> u8 {
        let x = self.register(x);
        let all = self.bits(!(1 << 31), !(1 << 63));
        self.two(BinaryOpcode::And, x, all)
    }
    /// Returns a comparison as a vector of truths.
    fn truths(&mut self, predicate: u8, a: u8, b: Operand) -> u8 {
        let to = self.fresh();
        self.out.compare(predicate, to, a, b);
        if self.out.is_512() {
            self.out.truths(to);
        }
        to
    }
    /// Emits a selection: `yes` where truths hold, else `no`.
    fn choose(&mut self, truths: u8, yes: u8, no: u8) -> u8 {
        let to = self.fresh();
        if self.out.is_512() {
            self.out.load(to, Operand::Register(truths));
        }
        self.out.choose(to, truths, yes, no);
        to
    }
    /// Emits a selection: `yes` where a comparison holds, else `no`.
    fn choose_by(&mut self, predicate: u8, [a, b]: [u16; 2], yes: u8, no: u8) -> u8 {
        let (a, b) = (self.register(a), self.operand(b));
        if self.out.is_512() {
            let to = self.fresh();
            self.out.compare(predicate, to, a, b);
            self.out.blend(to, no, Operand::Register(yes));
            return to;
        }
        let truths = self.truths(predicate, a, b);
        self.choose(truths, yes, no)
    }
    /// Returns a comparison, combined with a vector of truths by `op`.
    fn joined(&mut self, predicate: u8, [a, b, m]: [u16; 3], op: BinaryOpcode) -> u8 {
        let (a, b) = (self.register(a), self.operand(b));
        let truths = self.truths(predicate, a, b);
        let m = self.operand(m);
        self.two(op, truths, m)
    }
    /// Emits `(x . y) . z`, or `z . (x . y)`.
    fn three(
        &mut self,
        inner: BinaryOpcode,
        outer: BinaryOpcode,
        [x, y, z]: [u16; 3],
        is_first: bool,
    ) -> u8 {
        let (x, y) = (self.register(x), self.operand(y));
        let inner = self.two(inner, x, y);
        if is_first {
            let z = self.operand(z);
            self.two(outer, inner, z)
        } else {
            let z = self.register(z);
            self.two(outer, z, Operand::Register(inner))
        }
    }
    /// Emits `(x . y) . (z . w)`.
    fn four(
        &mut self,
        first: BinaryOpcode,
        second: BinaryOpcode,
        outer: BinaryOpcode,
        [x, y, z, w]: [u16; 4],
    ) -> u8 {
        let (x, y) = (self.register(x), self.operand(y));
        let left = self.two(first, x, y);
        let (z, w) = (self.register(z), self.operand(w));
        let right = self.two(second, z, w);
        self.two(outer, left, Operand::Register(right))
    }

    /// Compiles one instruction.
    fn instruction(&mut self, own: &Instruction) {
        // Operands in registers stay there until they are read.
        let [operands, _] = sizes(own.op);
        for &slot in &own.from[..operands] {
            if let Some(register) = self.find(slot) {
                self.pinned[register as usize] = true;
            }
        }
        let [x, y, z, w] = own.from;
        let (pair, triple, all) = ([x, y], [x, y, z], own.from);
        use BinaryOpcode::{Add, And, AndNot, Div, Max, Min, Mul, Or, Sub, Xor};
        let result = match own.op {
            Opcode::Copy => {
                let from = self.operand(x);
                let to = self.fresh();
                self.out.load(to, from);
                to
            }
            Opcode::Canonical => {
                let (zero, x) = (self.zero(), self.operand(x));
                self.two(Add, zero, x)
            }
            Opcode::Neg => self.negated(x),
            Opcode::Magnitude => self.magnitude(x),
            Opcode::Root => self.root(x),
            Opcode::Binade => self.binade(x),
            Opcode::High => {
                let x = self.register(x);
                // The bits that [`Scalar::parts`](crate::Scalar::parts) leaves to the low half.
                let high = self.bits(!((1 << 12) - 1), !((1 << 27) - 1));
                self.two(And, x, high)
            }
            Opcode::Not => {
                let (x, all) = (self.register(x), self.bits(!0, !0));
                self.two(Xor, x, all)
            }
            Opcode::Always => {
                let (to, all) = (self.fresh(), self.bits(!0, !0));
                self.out.load(to, all);
                to
            }
            Opcode::Never => self.zero(),
            Opcode::Add => self.pair(Add, pair),
            Opcode::Sub => self.pair(Sub, pair),
            Opcode::Mul => self.pair(Mul, pair),
            Opcode::Div => self.pair(Div, pair),
            Opcode::Min => self.pair(Min, pair),
            Opcode::Max => self.pair(Max, pair),
            Opcode::And => self.pair(And, pair),
            Opcode::Or => self.pair(Or, pair),
            Opcode::Lt => self.compared(LESS, pair),
            Opcode::Le => self.compared(AT_MOST, pair),
            Opcode::Eq => self.compared(EQUAL, pair),
            Opcode::Select => {
                let [m, x, y] = triple.map(|slot| self.register(slot));
                self.choose(m, x, y)
            }
            Opcode::Split => self.split(triple),
            Opcode::Rest => self.rest(triple),
            Opcode::AddAdd => self.three(Add, Add, triple, true),
            Opcode::SubAdd => self.three(Sub, Add, triple, true),
            Opcode::MulAdd => self.three(Mul, Add, triple, true),
            Opcode::AddSub => self.three(Add, Sub, triple, true),
            Opcode::SubSub => self.three(Sub, Sub, triple, true),
            Opcode::MulSub => self.three(Mul, Sub, triple, true),
            Opcode::FromAdd => self.three(Add, Sub, triple, false),
            Opcode::FromSub => self.three(Sub, Sub, triple, false),
            Opcode::FromMul => self.three(Mul, Sub, triple, false),
            Opcode::AddMul => self.three(Add, Mul, triple, true),
            Opcode::SubMul => self.three(Sub, Mul, triple, true),
            Opcode::MulMul => self.three(Mul, Mul, triple, true),
            Opcode::MaxMin => self.three(Max, Min, triple, true),
            Opcode::MinMax => self.three(Min, Max, triple, true),
            Opcode::MinFrom => self.three(Max, Min, triple, false),
            Opcode::MaxFrom => self.three(Min, Max, triple, false),
            Opcode::MaxFromMul => {
                let inner = self.three(Mul, Min, triple, false);
                let w = self.register(w);
                self.two(Max, w, Operand::Register(inner))
            }
            Opcode::MaxFromNeg => {
                let (inner, y) = (self.negated(x), self.register(y));
                let inner = self.two(Min, y, Operand::Register(inner));
                let z = self.register(z);
                self.two(Max, z, Operand::Register(inner))
            }
            Opcode::MaxMulAdd => {
                let inner = self.three(Mul, Add, triple, true);
                let w = self.register(w);
                self.two(Max, w, Operand::Register(inner))
            }
            Opcode::SubByAdd => self.four(Sub, Add, Mul, all),
            Opcode::SubAndSub => self.four(Sub, Sub, Add, all),
            Opcode::Dot => self.four(Mul, Mul, Add, all),
            Opcode::Cross => self.four(Mul, Mul, Sub, all),
            Opcode::SelectNeg => {
                let (m, yes, no) = (self.register(x), self.negated(y), self.register(z));
                self.choose(m, yes, no)
            }
            Opcode::SelectMul => {
                let (m, yes, no) = (self.register(x), self.pair(Mul, [y, z]), self.register(w));
                self.choose(m, yes, no)
            }
            Opcode::ElseMul => {
                let (m, yes, no) = (self.register(x), self.register(y), self.pair(Mul, [z, w]));
                self.choose(m, yes, no)
            }
            Opcode::SelectAdd => {
                let [m, yes, no] = triple.map(|slot| self.register(slot));
                let chosen = self.choose(m, yes, no);
                let w = self.operand(w);
                self.two(Add, chosen, w)
            }
            Opcode::MagnitudeMax => {
                let (x, y) = (self.magnitude(x), self.operand(y));
                self.two(Max, x, y)
            }
            Opcode::MaxMagnitude => {
                let (x, y) = (self.register(x), self.magnitude(y));
                self.two(Max, x, Operand::Register(y))
            }
            Opcode::AndNot => {
                let (n, m) = (self.register(y), self.operand(x));
                self.two(AndNot, n, m)
            }
            Opcode::SelectLt => self.choose_slots(LESS, all),
            Opcode::SelectLe => self.choose_slots(AT_MOST, all),
            Opcode::SelectEq => self.choose_slots(EQUAL, all),
            Opcode::SelectNegLt => {
                let (yes, no) = (self.negated(z), self.register(w));
                self.choose_by(LESS, pair, yes, no)
            }
            Opcode::LtAnd => self.joined(LESS, triple, And),
            Opcode::LeAnd => self.joined(AT_MOST, triple, And),
            Opcode::EqAnd => self.joined(EQUAL, triple, And),
            Opcode::LtOr => self.joined(LESS, triple, Or),
            Opcode::LeOr => self.joined(AT_MOST, triple, Or),
            Opcode::EqOr => self.joined(EQUAL, triple, Or),
            Opcode::Turn => {
                let first = self.four(Mul, Mul, Add, [x, z, y, w]);
                let second = self.four(Mul, Mul, Sub, [y, z, x, w]);
                return self.finish(&[(own.to[0], first), (own.to[1], second)]);
            }
            Opcode::SumSub => {
                let (sum, difference) = (self.pair(Add, pair), self.pair(Sub, pair));
                return self.finish(&[(own.to[0], sum), (own.to[1], difference)]);
            }
            // Runs do not contain these.
            Opcode::Exp
            | Opcode::Ln
            | Opcode::Atan2
            | Opcode::Parts
            | Opcode::SinCos
            | Opcode::SkipIfAll
            | Opcode::SkipIfNone => return,
        };
        self.finish(&[(own.to[0], result)]);
    }
    fn pair(&mut self, op: BinaryOpcode, [x, y]: [u16; 2]) -> u8 {
        let (x, y) = (self.register(x), self.operand(y));
        self.two(op, x, y)
    }
    fn compared(&mut self, predicate: u8, [x, y]: [u16; 2]) -> u8 {
        let (x, y) = (self.register(x), self.operand(y));
        self.truths(predicate, x, y)
    }
    fn choose_slots(&mut self, predicate: u8, [x, y, z, w]: [u16; 4]) -> u8 {
        let (yes, no) = (self.register(z), self.register(w));
        self.choose_by(predicate, [x, y], yes, no)
    }
    /// Emits the square root of positive numbers, zero for all others.
    fn root(&mut self, x: u16) -> u8 {
        let (zero, x) = (Operand::Register(self.zero()), self.register(x));
        let from = Operand::Register(x);
        // Likewise for NaN, whose root is NaN.
        if self.out.is_512() {
            let to = self.fresh();
            self.out.compare(NOT_AT_MOST, to, x, zero);
            self.out.root(to, from, Writemask::Zeroed);
            return to;
        }
        let above = self.truths(NOT_AT_MOST, x, zero);
        let root = self.fresh();
        self.out.root(root, from, Writemask::No);
        self.two(BinaryOpcode::And, root, Operand::Register(above))
    }
    /// Emits [`Scalar::binade`](crate::Scalar::binade): exponent field e becomes 2·bias + 1 − e.
    fn binade(&mut self, x: u16) -> u8 {
        let least = self.bits(f32::MIN_POSITIVE.to_bits(), f64::MIN_POSITIVE.to_bits());
        let field = self.bits(f32::INFINITY.to_bits(), f64::INFINITY.to_bits());
        let twice_bias_and_one = self.bits(255 << 23, 2047 << 52);
        let (start, x) = (self.fresh(), self.operand(x));
        self.out.load(start, least);
        let normal = self.two(BinaryOpcode::Max, start, x);
        let exponent = self.two(BinaryOpcode::And, normal, field);
        let to = self.fresh();
        self.out.load(to, twice_bias_and_one);
        self.out.subtract_whole(to, to, Operand::Register(exponent));
        to
    }
    /// Emits `z` where x is less than y, half of it where both are equal, else zero.
    fn split(&mut self, [x, y, z]: [u16; 3]) -> u8 {
        let (z, half) = (self.register(z), self.number(0.5));
        let half = self.two(BinaryOpcode::Mul, z, half);
        let (a, b) = (self.register(x), self.register(y));
        let b = Operand::Register(b);
        if self.out.is_512() {
            let tie = self.fresh();
            self.out.compare(EQUAL, tie, a, b);
            self.out.load_zeroed(tie, Operand::Register(half));
            self.out.compare(LESS, tie, a, b);
            let to = self.fresh();
            self.out.blend(to, tie, Operand::Register(z));
            return to;
        }
        let equal = self.truths(EQUAL, a, b);
        let tie = self.two(BinaryOpcode::And, half, Operand::Register(equal));
        let less = self.truths(LESS, a, b);
        self.choose(less, z, tie)
    }
    /// Emits zero where x is less than y, half of `z` where both are equal, else `z`.
    fn rest(&mut self, [x, y, z]: [u16; 3]) -> u8 {
        let (z, half) = (self.register(z), self.number(0.5));
        let half = self.two(BinaryOpcode::Mul, z, half);
        let (a, b) = (self.register(x), self.register(y));
        let b = Operand::Register(b);
        if self.out.is_512() {
            let tie = self.fresh();
            self.out.compare(EQUAL, tie, a, b);
            self.out.blend(tie, z, Operand::Register(half));
            self.out.compare(NOT_LESS, tie, a, b);
            let to = self.fresh();
            self.out.load_zeroed(to, Operand::Register(tie));
            return to;
        }
        let equal = self.truths(EQUAL, a, b);
        let tie = self.choose(equal, half, z);
        let less = self.truths(LESS, a, b);
        self.two(BinaryOpcode::AndNot, less, Operand::Register(tie))
    }
}

/// Compiles all runs of a program, whose slots begin every `stride` bytes. Returns the code, its runs, and its accesses
/// outside of slots. With `of_rows` items are rows of numbers, else tiles.
pub(crate) fn compile(
    mut out: Encoder,
    tape: &Tape,
    stride: usize,
    of_rows: bool,
) -> (Vec<u8>, Vec<CodeRun>, Far) {
    let code = &tape.code[..];
    let (events, runs) = (events(code), runs(code));
    let far = match of_rows {
        true => Far::of(tape, &events, &runs),
        false => Far::default(),
    };
    let near: Vec<u16> = far.near_outputs(&tape.outputs);
    let mut all = Vec::new();
    for [from, to] in runs {
        // Runs begin on a cache line; the padding is `int3`.
        let entry = out.bytes.len().next_multiple_of(64);
        out.bytes.resize(entry, 0xcc);
        let start = out.begin();
        let registers = out.registers() as usize;
        let mut compiler = Compiler {
            out: &mut out,
            events: &events,
            outputs: &near,
            far: &far,
            end: to,
            stride,
            held: vec![None; registers],
            pinned: vec![false; registers],
            at: from,
        };
        for (at, own) in code.iter().enumerate().take(to).skip(from) {
            compiler.at = at;
            compiler.instruction(own);
        }
        compiler.flush();
        out.end(start);
        all.push(CodeRun { from, to, entry });
    }
    (out.finish(), all, far)
}
