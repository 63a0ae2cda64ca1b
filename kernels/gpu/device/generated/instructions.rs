//! Replays of operations with a search, as instructions for a GPU, which cannot search.
//!
//! The CPU makes the decisions. For given decisions, and codes of the input, the result is a straight line. It is
//! recorded once for every record that occurs, and becomes a list of instructions, by which a GPU replays all items of
//! that record.
use crate::Error;
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::instructions::{LISTED, Opcode};
use crate::kernels::cpu::program::{Skipping, Tape};

/// A replay as instructions of four words each: operation and slot of the result; two operands; two more. Further
/// results take the places of operands.
#[derive(Debug)]
pub struct Replay {
    /// The instructions in order.
    pub(crate) code: Vec<[u32; 4]>,
    /// The number of slots.
    pub(crate) slots: usize,
}

/// The operation that loads a constant into a slot: its bits are the second word.
pub(crate) const CONSTANT: u32 = 0x100;
/// The operation that loads a number of the input into a slot: its index is the second word.
pub(crate) const TAKE: u32 = 0x101;
/// The operation that stores the slot in the second word as the result in the third.
pub(crate) const GIVE: u32 = 0x102;

/// Translates a graph to instructions.
pub(crate) fn instructions(graph: &Graph, inputs: usize, outputs: &[Id]) -> Result<Replay, Error> {
    // Zeros lose their signs in results.
    let plain = |&x: &Id| match graph.at(x) {
        Node::Canonical(x) => x,
        _ => x,
    };
    let outputs: Vec<Id> = outputs.iter().map(plain).collect();
    let tape = Tape::new(graph, inputs, &outputs, Skipping::Never).map_err(Error::Program)?;
    let to = |op: u32, slot: u16| op | u32::from(slot) << 16;
    let two = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
    let mut code = Vec::new();
    for &(slot, number) in &tape.constants {
        code.push([to(CONSTANT, slot), (number as f32).to_bits(), 0, 0]);
    }
    for (k, slot) in tape.inputs.iter().enumerate() {
        if let Some(slot) = *slot {
            code.push([to(TAKE, slot), k as u32, 0, 0]);
        }
    }
    for own in &tape.code {
        let ([x, y, z, w], [first, rest @ ..]) = (own.from, own.to);
        code.push(match own.op {
            Opcode::Parts | Opcode::SinCos => {
                let head = to(own.op as u32, first);
                [head, two(x, rest[0]), two(rest[1], rest[2]), 0]
            }
            // Most instructions have one result.
            op => [
                to(op as u32, first),
                two(x, y),
                two(z, w),
                u32::from(rest[0]),
            ],
        });
    }
    for (k, &slot) in tape.outputs.iter().enumerate() {
        code.push([GIVE, u32::from(slot), k as u32, 0]);
    }
    Ok(Replay {
        code,
        slots: tape.slots.max(1),
    })
}

/// Returns the number of every instruction of the interpreter, by name.
pub(crate) fn numbers() -> Vec<(&'static str, u32)> {
    let listed = LISTED.iter().zip(0..);
    let mut all: Vec<_> = listed.map(|(&(name, _), number)| (name, number)).collect();
    all.extend([
        ("Parts", Opcode::Parts as u32),
        ("SinCos", Opcode::SinCos as u32),
        ("Turn", Opcode::Turn as u32),
        ("SumSub", Opcode::SumSub as u32),
        ("Constant", CONSTANT),
        ("Take", TAKE),
        ("Give", GIVE),
    ]);
    all
}
