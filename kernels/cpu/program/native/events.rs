//! The reads and writes of slots by the instructions of a program.
use crate::kernels::cpu::program::instructions::{Instruction, LISTED, Opcode};
use std::collections::HashMap;

/// Returns the numbers of operands and of results of an instruction.
pub(super) fn sizes(op: Opcode) -> [usize; 2] {
    match op {
        Opcode::Parts => [1, 4],
        Opcode::SinCos => [1, 2],
        Opcode::Turn => [4, 2],
        Opcode::SumSub => [2, 2],
        Opcode::SkipIfAll | Opcode::SkipIfNone => [1, 0],
        one_result => [LISTED[one_result as usize].1, 1],
    }
}

/// The reads (`true`) and writes of every slot, in the order of instructions.
pub(super) type Events = HashMap<u16, Vec<(usize, bool)>>;

/// Returns the reads and writes of every slot.
pub(super) fn events(code: &[Instruction]) -> Events {
    let mut all = Events::new();
    for (i, own) in code.iter().enumerate() {
        let [operands, results] = sizes(own.op);
        for &slot in &own.from[..operands] {
            all.entry(slot).or_default().push((i, true));
        }
        for &slot in &own.to[..results] {
            all.entry(slot).or_default().push((i, false));
        }
    }
    all
}
