//! When the instructions of a program read and write their slots.
use crate::kernels::cpu::program::instructions::{Code, Op};
use std::collections::HashMap;

/// Returns the operands of an instruction, and its results.
pub(super) fn sizes(op: Op) -> [usize; 2] {
    macro_rules! listed {
        ($($name:ident($($x:ident),*) = $value:expr;)*) => {
            match op {
                $(Op::$name => [[$(stringify!($x)),*].len(), 1],)*
                Op::Parts => [1, 4],
                Op::SinCos => [1, 2],
                Op::Turn => [4, 2],
                Op::SumSub => [2, 2],
                Op::SkipIfAll | Op::SkipIfNone => [1, 0],
            }
        };
    }
    crate::kernels::cpu::program::instructions::instructions! { listed!() }
}

/// Reads (`true`) and writes of slots, instruction by instruction.
pub(super) type Events = HashMap<u16, Vec<(usize, bool)>>;

/// Returns all of them.
pub(super) fn events(code: &[Code]) -> Events {
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
