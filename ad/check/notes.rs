//! The findings of the comparisons at one input. Each comparison returns [`Notes`]; [`judge`](crate::ad::check::judge)
//! adds them up and decides which of their faults are refused.
use crate::ad::check::verdict::{
    ByWitness, Fault, PAIRS, Reason, Smoothness, Tightest, Witness, Worst,
};

/// The findings of one comparison, or of several.
#[derive(Clone, Debug)]
pub(crate) struct Notes {
    /// The faults, in order of importance.
    pub(crate) faults: Vec<Fault>,
    /// The largest difference of each pair of witnesses.
    pub(crate) worst: [Worst; PAIRS.len()],
    /// For each number of the input, `true` if some witness could judge the derivative with respect to it.
    pub(crate) judged: Vec<bool>,
    /// `true` if a declared convention was needed.
    pub(crate) convention: bool,
    /// `true` if the value jumps.
    pub(crate) jump: bool,
    /// Directions along which the function is smooth, kinked and not to be judged.
    pub(crate) directions: [u64; 3],
    /// Directions along which another branch was taken, however small the step.
    pub(crate) switched: u64,
    /// The smoothness for each output and direction at which steps could decide it.
    pub(crate) smoothness: Vec<(usize, usize, Smoothness)>,
    /// `true` if the function stays in one branch near the input along all directions, so that it has second
    /// derivatives.
    pub(crate) plain: bool,
}

impl Notes {
    /// Creates empty notes about an input of `inputs` numbers.
    pub(crate) fn new(inputs: usize) -> Self {
        Notes {
            faults: Vec::new(),
            worst: [Worst::default(); PAIRS.len()],
            judged: vec![false; inputs],
            convention: false,
            jump: false,
            directions: [0; 3],
            switched: 0,
            smoothness: Vec::new(),
            plain: false,
        }
    }

    /// Adds a fault without numbers.
    pub(crate) fn add_fault(&mut self, reason: Reason, output: usize, input: usize) {
        self.add_fault_with(reason, None, (output, input), ByWitness::default(), 0.0);
    }

    /// Adds a fault about the number of results, and the number there should be.
    pub(crate) fn add_length_fault(
        &mut self,
        witness: Witness,
        output: usize,
        lengths: [usize; 2],
    ) {
        let numbers = ByWitness {
            lengths: Some(lengths),
            ..ByWitness::default()
        };
        let reason = Reason::WrongLength(witness);
        self.add_fault_with(reason, None, (output, 0), numbers, 0.0);
    }

    /// Adds a fault about an output and an input.
    pub(crate) fn add_fault_with(
        &mut self,
        reason: Reason,
        suspect: Option<Witness>,
        (output, input): (usize, usize),
        numbers: ByWitness,
        tolerance: f64,
    ) {
        self.faults.push(Fault {
            reason,
            suspect,
            output,
            input,
            numbers,
            tolerance,
        });
    }

    /// Counts one more comparison of the pair at index `pair` of [`PAIRS`]; `size` is the largest derivative of the
    /// same unit.
    pub(crate) fn compared(&mut self, pair: usize, gap: f64, size: f64, eps: f64, at: Tightest) {
        self.worst[pair].note(gap, size, eps, at);
    }

    /// Adds the findings of another comparison after these.
    pub(crate) fn add(&mut self, other: Notes) {
        self.faults.extend(other.faults);
        for (all, one) in self.worst.iter_mut().zip(&other.worst) {
            all.merge(one, 0);
        }
        for (all, one) in self.judged.iter_mut().zip(other.judged) {
            *all |= one;
        }
        self.convention |= other.convention;
        self.jump |= other.jump;
        for (all, one) in self.directions.iter_mut().zip(other.directions) {
            *all += one;
        }
        self.switched += other.switched;
        self.smoothness.extend(other.smoothness);
        self.plain |= other.plain;
    }
}
