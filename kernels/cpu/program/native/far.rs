//! Inputs and results that machine code reads and writes in place, without slots.
use super::events::Events;
use crate::kernels::cpu::program::Tape;
use crate::kernels::cpu::program::instructions::Opcode;
use std::collections::HashMap;

/// The largest number of addresses in a table.
pub(crate) const MOST: usize = 64;

/// The inputs and results with an address in the table: inputs by their index, results after them.
#[derive(Debug, Default)]
pub(crate) struct Far {
    /// The input of a slot, and the instruction that first overwrites it.
    inputs: HashMap<u16, (usize, usize)>,
    /// The results of a slot, and the instruction that computes them.
    outputs: HashMap<u16, (Vec<usize>, usize)>,
}

impl Far {
    /// Returns the inputs that only runs read, and the results that runs compute without a skip.
    pub(super) fn of(tape: &Tape, events: &Events, runs: &[[usize; 2]]) -> Self {
        let (mut inputs, mut outputs) = (HashMap::new(), HashMap::new());
        let first = tape.inputs.len();
        let in_run = |at: usize| runs.iter().any(|run| (run[0]..run[1]).contains(&at));
        let of = |slot: u16| events.get(&slot).map_or(&[][..], Vec::as_slice);
        if first + tape.outputs.len() > MOST {
            return Far { inputs, outputs };
        }
        for (k, slot) in tape.inputs.iter().enumerate() {
            let &Some(slot) = slot else { continue };
            let write = of(slot).iter().find(|event| !event.1);
            let end = write.map_or(usize::MAX, |event| event.0);
            let mut reads = of(slot).iter().filter(|event| event.1 && event.0 <= end);
            let is_result = write.is_none() && tape.outputs.contains(&slot);
            if !is_result && reads.all(|event| in_run(event.0)) {
                inputs.insert(slot, (k, end));
            }
        }
        let skips = |op| matches!(op, Opcode::SkipIfAll | Opcode::SkipIfNone);
        if tape.code.iter().any(|own| skips(own.op)) {
            return Far { inputs, outputs };
        }
        for (k, &slot) in tape.outputs.iter().enumerate() {
            let write = of(slot).iter().rfind(|event| !event.1);
            if let Some(&(at, _)) = write
                && in_run(at)
            {
                let (places, _) = outputs.entry(slot).or_insert((Vec::new(), at));
                places.push(first + k);
            }
        }
        Far { inputs, outputs }
    }
    /// Returns the index in the table of the input that a slot holds when instruction `at` reads it.
    pub(super) fn input(&self, slot: u16, at: usize) -> Option<usize> {
        let &(k, end) = self.inputs.get(&slot)?;
        (at <= end).then_some(k)
    }
    /// Returns the indices in the table of the results that instruction `at` computes in a slot.
    pub(super) fn outputs(&self, slot: u16, at: usize) -> &[usize] {
        match self.outputs.get(&slot) {
            Some((places, made)) if *made == at => places,
            _ => &[],
        }
    }
    /// Returns the slots of all other results.
    pub(super) fn near_outputs(&self, outputs: &[u16]) -> Vec<u16> {
        let near = |slot: &&u16| !self.outputs.contains_key(slot);
        outputs.iter().filter(near).copied().collect()
    }
    /// Returns, for each address of a table, inputs first, the slot that it stands for, or `None` if the code does not
    /// use it.
    pub(crate) fn table(&self, tape: &Tape) -> Vec<Option<u16>> {
        let inputs = tape
            .inputs
            .iter()
            .map(|slot| slot.filter(|slot| self.inputs.contains_key(slot)));
        let outputs = tape
            .outputs
            .iter()
            .map(|slot| self.outputs.contains_key(slot).then_some(*slot));
        inputs.chain(outputs).take(MOST).collect()
    }
}
