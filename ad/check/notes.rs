//! The notes of a comparison of witnesses at one input. Only [`judge`](crate::ad::check::judge) refuses.
use crate::ad::check::verdict::{
    ByWitness, Fault, PAIRS, Reason, Smoothness, Tightest, Witness, Worst,
};

/// The findings of one comparison, or of several.
#[derive(Clone, Debug)]
pub(crate) struct Notes {
    /// The complaints, in order of importance.
    pub(crate) complaints: Vec<Fault>,
    /// How far apart each pair of witnesses was.
    pub(crate) worst: [Worst; PAIRS.len()],
    /// For each number of the input, `true` if some witness could judge the derivative with respect to it.
    pub(crate) covered: Vec<bool>,
    /// `true` if a declared convention was needed.
    pub(crate) convention: bool,
    /// `true` if the value jumps.
    pub(crate) jump: bool,
    /// Directions along which the function is smooth, kinked and not to be judged.
    pub(crate) directions: [u64; 3],
    /// Directions along which another branch was taken, however small the step.
    pub(crate) switched: u64,
    /// Outputs and directions at which steps could tell, and what kind of place it is along them.
    pub(crate) told: Vec<(usize, usize, Smoothness)>,
    /// `true` if the function stays in one branch for a while along all directions, so that second
    /// derivatives make sense.
    pub(crate) plain: bool,
}

impl Notes {
    /// Creates empty notes about an input of `inputs` numbers.
    pub(crate) fn new(inputs: usize) -> Self {
        Notes {
            complaints: Vec::new(),
            worst: [Worst::default(); PAIRS.len()],
            covered: vec![false; inputs],
            convention: false,
            jump: false,
            directions: [0; 3],
            switched: 0,
            told: Vec::new(),
            plain: false,
        }
    }

    /// Adds a fault without numbers.
    pub(crate) fn complain(&mut self, reason: Reason, output: usize, input: usize) {
        self.complain_of(reason, None, (output, input), ByWitness::default(), 0.0);
    }

    /// Adds a fault about the number of results, and the number there should be.
    pub(crate) fn complain_of_length(
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
        self.complain_of(reason, None, (output, 0), numbers, 0.0);
    }

    /// Adds a fault about an output and an input.
    pub(crate) fn complain_of(
        &mut self,
        reason: Reason,
        suspect: Option<Witness>,
        (output, input): (usize, usize),
        numbers: ByWitness,
        tolerance: f64,
    ) {
        self.complaints.push(Fault {
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
        self.complaints.extend(other.complaints);
        for (all, one) in self.worst.iter_mut().zip(&other.worst) {
            all.merge(one, 0);
        }
        for (all, one) in self.covered.iter_mut().zip(other.covered) {
            *all |= one;
        }
        self.convention |= other.convention;
        self.jump |= other.jump;
        for (all, one) in self.directions.iter_mut().zip(other.directions) {
            *all += one;
        }
        self.switched += other.switched;
        self.told.extend(other.told);
        self.plain |= other.plain;
    }
}
