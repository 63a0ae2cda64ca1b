//! An encoder of x86-64 vector instructions, in the encodings VEX (AVX2) and EVEX (AVX-512).
//!
//! Intel's Software Developer's Manual, volume 2, sections 2.3 (VEX) and 2.7 (EVEX). Operands in memory are slots, at
//! `rdi + rax + displacement`, and constants behind the code. Others are numbers outside of slots, whose addresses are
//! in the table at `rdx`.

/// An operand of an instruction: a register, or a location in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    Register(u8),
    /// A slot, by its offset in bytes from the first one.
    Slot(i32),
    /// Numbers outside of slots, by the index of their address in the table.
    Far(usize),
    /// A constant, by its index.
    Constant(usize),
}

/// A vector instruction: its opcode, the map of opcodes, and the mandatory prefix.
#[derive(Clone, Copy)]
pub(super) struct VectorOpcode {
    opcode: u8,
    map: u8,
    prefix: u8,
    wide: bool,
}

/// The writemask of an AVX-512 instruction: none, or the register `k1`, with the other numbers kept or zeroed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Writemask {
    No,
    Merged,
    Zeroed,
}

/// The predicates of quiet comparisons.
pub(super) const EQUAL: u8 = 0x00;
pub(super) const LESS: u8 = 0x11;
pub(super) const AT_MOST: u8 = 0x12;
pub(super) const NOT_LESS: u8 = 0x15;
pub(super) const NOT_AT_MOST: u8 = 0x16;

/// The imm8 of `vpternlog` that selects by the bits of the destination.
const CHOOSE: u8 = 0xca;

/// A buffer of code, with its constants.
pub(crate) struct Encoder {
    pub(super) bytes: Vec<u8>,
    /// The constants, one vector of 64 bytes each.
    constants: Vec<u64>,
    /// Displacements of constants to fill in: their position, the constant, and the end of their instruction.
    open: Vec<(usize, usize, usize)>,
    /// `true` for AVX-512, `false` for AVX2.
    is_512: bool,
    /// `true` for `f64`.
    is_double: bool,
}

/// The size of a constant in bytes.
const CONSTANT: usize = 64;

impl Encoder {
    pub(crate) fn new(is_512: bool, is_double: bool) -> Self {
        Encoder {
            bytes: Vec::new(),
            constants: Vec::new(),
            open: Vec::new(),
            is_512,
            is_double,
        }
    }
    pub(super) const fn is_512(&self) -> bool {
        self.is_512
    }
    pub(super) const fn is_double(&self) -> bool {
        self.is_double
    }
    /// Returns the size of a vector register in bytes.
    pub(super) const fn width(&self) -> usize {
        if self.is_512 { 64 } else { 32 }
    }
    /// Returns the number of vector registers.
    pub(super) const fn registers(&self) -> u8 {
        if self.is_512 { 32 } else { 16 }
    }
    /// Returns a number broadcast to a vector; `bits` of single precision come twice.
    pub(super) fn constant(&mut self, bits: u64) -> Operand {
        let known = self.constants.iter().position(|&known| known == bits);
        Operand::Constant(known.unwrap_or_else(|| {
            self.constants.push(bits);
            self.constants.len() - 1
        }))
    }

    /// Returns an instruction of packed numbers in opcode map 0F.
    const fn packed(&self, opcode: u8) -> VectorOpcode {
        VectorOpcode {
            opcode,
            map: 1,
            prefix: self.is_double as u8,
            wide: self.is_double && self.is_512,
        }
    }

    /// Emits `to = a ∘ b`, masked by `k1` in AVX-512.
    fn emit(
        &mut self,
        own: VectorOpcode,
        to: u8,
        a: u8,
        b: Operand,
        masked: Writemask,
        more: Option<u8>,
    ) {
        let (low, high) = match b {
            Operand::Register(b) => (b >> 3 & 1, b >> 4 & 1),
            // The base is r10, loaded just before.
            Operand::Far(k) => {
                self.bytes.extend([0x4c, 0x8b, 0x92]);
                self.bytes.extend((8 * k as u32).to_le_bytes());
                (1, 0)
            }
            Operand::Slot(_) | Operand::Constant(_) => (0, 0),
        };
        let flipped = |bit: u8, at: u8| (!bit & 1) << at;
        let wide = u8::from(own.wide) << 7;
        if self.is_512 {
            self.bytes.extend([
                0x62,
                flipped(to >> 3, 7)
                    | flipped(high, 6)
                    | flipped(low, 5)
                    | flipped(to >> 4, 4)
                    | own.map,
                wide | (!a & 15) << 3 | 4 | own.prefix,
                u8::from(masked == Writemask::Zeroed) << 7
                    | 0x40
                    | flipped(a >> 4, 3)
                    | u8::from(masked != Writemask::No),
            ]);
        } else {
            self.bytes.extend([
                0xc4,
                flipped(to >> 3, 7) | 0x40 | flipped(low, 5) | own.map,
                wide | (!a & 15) << 3 | 4 | own.prefix,
            ]);
        }
        self.bytes.push(own.opcode);
        let to = (to & 7) << 3;
        match b {
            Operand::Register(b) => self.bytes.push(0xc0 | to | b & 7),
            Operand::Slot(bytes) => {
                self.bytes.extend([0x84 | to, 0x07]);
                self.bytes.extend(bytes.to_le_bytes());
            }
            Operand::Far(_) => self.bytes.extend([0x04 | to, 0x02]),
            Operand::Constant(k) => {
                self.bytes.push(0x05 | to);
                let at = self.bytes.len();
                self.bytes.extend([0; 4]);
                self.open.push((at, at + 4 + more.iter().len(), k));
            }
        }
        self.bytes.extend(more);
    }
    fn plain(&mut self, opcode: u8, to: u8, a: u8, b: Operand) {
        self.emit(self.packed(opcode), to, a, b, Writemask::No, None);
    }

    /// Emits an operation of two vectors.
    pub(super) fn two(&mut self, op: BinaryOpcode, to: u8, a: u8, b: Operand) {
        self.plain(op as u8, to, a, b);
    }
    /// Emits a load of a vector to a register.
    pub(super) fn load(&mut self, to: u8, from: Operand) {
        // Numbers outside of slots need not be aligned.
        let opcode = if matches!(from, Operand::Far(_)) {
            0x10
        } else {
            0x28
        };
        self.plain(opcode, to, 0, from);
    }
    /// Emits a load of a vector where `k1` holds, zero elsewhere.
    pub(super) fn load_zeroed(&mut self, to: u8, from: Operand) {
        self.emit(self.packed(0x28), to, 0, from, Writemask::Zeroed, None);
    }
    /// Emits a store of a register to a slot.
    pub(super) fn store(&mut self, from: u8, slot: i32) {
        self.plain(0x29, from, 0, Operand::Slot(slot));
    }
    /// Emits a prefetch of numbers outside of slots, to be read or to be written, `ahead` bytes beyond the last access.
    /// Any address is allowed.
    pub(super) fn prefetch(&mut self, ahead: usize, to_write: bool) {
        // prefetcht1, prefetchw [r10 + rax + ahead]
        let [opcode, operand] = if to_write { [0x0d, 0x8c] } else { [0x18, 0x94] };
        self.bytes.extend([0x41, 0x0f, opcode, operand, 0x02]);
        self.bytes.extend((ahead as u32).to_le_bytes());
    }
    /// Emits a store of a register to numbers outside of slots.
    pub(super) fn store_far(&mut self, from: u8, k: usize) {
        self.plain(0x11, from, 0, Operand::Far(k));
    }
    /// Emits a square root.
    pub(super) fn root(&mut self, to: u8, from: Operand, masked: Writemask) {
        self.emit(self.packed(0x51), to, 0, from, masked, None);
    }
    /// Emits a comparison, into a vector of truths (AVX2) or into `k1`.
    pub(super) fn compare(&mut self, predicate: u8, to: u8, a: u8, b: Operand) {
        let to = if self.is_512 { 1 } else { to };
        self.emit(self.packed(0xc2), to, a, b, Writemask::No, Some(predicate));
    }
    /// Emits `k1` as a vector of truths, in AVX-512.
    pub(super) fn truths(&mut self, to: u8) {
        let own = VectorOpcode {
            opcode: 0x38,
            map: 2,
            prefix: 2,
            wide: self.is_double,
        };
        self.emit(own, to, 0, Operand::Register(1), Writemask::No, None);
    }
    /// Emits a selection in AVX-512: `yes` where `k1` holds, else `no`.
    pub(super) fn blend(&mut self, to: u8, no: u8, yes: Operand) {
        let own = VectorOpcode {
            opcode: 0x65,
            map: 2,
            prefix: 1,
            wide: self.is_double,
        };
        self.emit(own, to, no, yes, Writemask::Merged, None);
    }
    /// Emits a selection: `yes` where a vector of truths holds, else `no`. In AVX-512 the truths must be in `to`.
    pub(super) fn choose(&mut self, to: u8, truths: u8, yes: u8, no: u8) {
        if self.is_512 {
            let own = VectorOpcode {
                opcode: 0x25,
                map: 3,
                prefix: 1,
                wide: self.is_double,
            };
            let no = Operand::Register(no);
            self.emit(own, to, yes, no, Writemask::No, Some(CHOOSE));
        } else {
            let own = VectorOpcode {
                opcode: 0x4a + u8::from(self.is_double),
                map: 3,
                prefix: 1,
                wide: false,
            };
            let yes = Operand::Register(yes);
            self.emit(own, to, no, yes, Writemask::No, Some(truths << 4));
        }
    }
    /// Emits the difference as integers of the format's width.
    pub(super) fn subtract_whole(&mut self, to: u8, a: u8, b: Operand) {
        let own = VectorOpcode {
            opcode: 0xfa + u8::from(self.is_double),
            map: 1,
            prefix: 1,
            wide: self.is_double && self.is_512,
        };
        self.emit(own, to, a, b, Writemask::No, None);
    }

    /// Begins a function of the first slot (`rdi`), the bytes of a slot in use (`rsi`) and the table of addresses
    /// (`rdx`). The code that follows is repeated for every vector of the slots.
    pub(super) fn begin(&mut self) -> usize {
        // endbr64, which processors that check the targets of indirect calls want; xor eax, eax.
        self.bytes.extend([0xf3, 0x0f, 0x1e, 0xfa, 0x31, 0xc0]);
        self.bytes.len()
    }
    /// Ends the function.
    pub(super) fn end(&mut self, start: usize) {
        // add rax, width; cmp rax, rsi; jb start; vzeroupper; ret.
        self.bytes.extend([0x48, 0x05]);
        self.bytes.extend((self.width() as u32).to_le_bytes());
        self.bytes.extend([0x48, 0x39, 0xf0, 0x0f, 0x82]);
        let back = start as i64 - (self.bytes.len() as i64 + 4);
        self.bytes.extend((back as i32).to_le_bytes());
        self.bytes.extend([0xc5, 0xf8, 0x77, 0xc3]);
    }
    /// Returns the code, followed by its constants.
    pub(super) fn finish(mut self) -> Vec<u8> {
        let first = self.bytes.len().next_multiple_of(CONSTANT);
        self.bytes.resize(first, 0xcc);
        for (at, end, k) in self.open {
            let distance = (first + k * CONSTANT - end) as i32;
            self.bytes[at..at + 4].copy_from_slice(&distance.to_le_bytes());
        }
        for constant in self.constants {
            for _ in 0..CONSTANT / 8 {
                self.bytes.extend(constant.to_le_bytes());
            }
        }
        self.bytes
    }
}

/// The operations of two vectors, with their opcodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BinaryOpcode {
    And = 0x54,
    /// The complement of the first, and the second.
    AndNot = 0x55,
    Or = 0x56,
    Xor = 0x57,
    Add = 0x58,
    Mul = 0x59,
    Sub = 0x5c,
    Min = 0x5d,
    Div = 0x5e,
    Max = 0x5f,
}
