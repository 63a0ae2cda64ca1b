//! The verdicts of the harness: typed reasons, the numbers behind them, no strings.
use crate::Unrecordable;
use crate::ad::check::symmetry::Motion;

/// A method that computes a value or a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Witness {
    /// The function itself.
    Value,
    /// The derivative by hand.
    Adjoint,
    /// Forward duals on the generic source.
    Dual,
    /// num-dual's own dual numbers on the generic source.
    NumDual,
    /// Finite differences with an error estimate.
    Difference,
    /// Duals on the generic source in double precision.
    Wide,
    /// The plane between two bodies that proves a distance from below.
    Planes,
    /// The nearest points of two bodies, which prove a distance from above.
    Points,
    /// A batch of the operation, on the CPU or a GPU.
    Batch,
    /// A further witness, by its position in the list that was given: another code path, a GPU.
    Further(usize),
}

/// Why a function was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Reason {
    /// A derivative has another length than the input.
    WrongLength(Witness),
    /// A finite input gave a NaN or an infinity.
    NotFinite(Witness),
    /// A second evaluation at one input gave other bits.
    Impure(Witness),
    /// Another path to the value gives another value.
    ValuesDisagree(Witness),
    /// Two derivatives differ by more than their errors.
    Disagree(Witness, Witness),
    /// At a kink the derivative is not between the derivatives of both sides.
    OutsideKink,
    /// The value jumps, and the function does not declare that it does.
    Jump,
    /// The adjoint of a sum is not the sum of the adjoints.
    NotLinear,
    /// The second derivative differs from differences of the first, or from duals of duals.
    CurvatureDisagrees(Witness),
    /// Second derivatives taken in the other order differ.
    CurvatureNotSymmetric,
    /// The value does not follow a declared motion.
    MotionBroken(Motion),
    /// The derivative does not follow a declared motion: forces or torques do not balance.
    MotionUnbalanced(Motion),
    /// The operation cannot be recorded as a program, so that nothing was judged.
    Unrecordable(Unrecordable),
    /// Hardly a random input was inside the domain, so that nothing was checked.
    FewInside,
    /// Hardly a sample was smooth, so that nothing was checked.
    NothingSmooth,
    /// No witness could judge this number of the input at any sample: there was no sample inside the domain, no
    /// derivative, no result, or all differences were lost in rounding.
    Unjudged,
}

/// The smoothness of a function at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Smoothness {
    /// Differentiable as far as can be seen.
    Smooth,
    /// The derivatives of both sides differ.
    Kink,
    /// A jump, an infinite derivative, or no step inside the domain.
    Undefined,
}

/// One number per witness, as far as there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByWitness {
    /// The number by the derivative by hand.
    pub adjoint: Option<f64>,
    /// The number by forward duals.
    pub dual: Option<f64>,
    /// The number by finite differences.
    pub difference: Option<f64>,
    /// The number by the further witness in question.
    pub other: Option<f64>,
    /// Derivatives of both sides, at a kink.
    pub sides: Option<[f64; 2]>,
    /// `true` for derivatives along a random direction, along which several numbers of the input move, instead of one.
    pub along: bool,
    /// The number of results, and the number there should be.
    pub lengths: Option<[usize; 2]>,
}

impl ByWitness {
    /// Returns two numbers that should be one: that of the function, and what it should be.
    pub(crate) fn pair(own: f64, other: f64) -> Self {
        ByWitness {
            adjoint: Some(own),
            other: Some(other),
            ..ByWitness::default()
        }
    }
}

/// A refusal: what, where, and the numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Why.
    pub reason: Reason,
    /// The witness that the others outvote, if that can be decided.
    pub suspect: Option<Witness>,
    /// The number of the output concerned.
    pub output: usize,
    /// The number of the input concerned.
    pub input: usize,
    /// The number of every witness.
    pub numbers: ByWitness,
    /// The largest allowed difference of the two numbers in question.
    pub tolerance: f64,
}

/// The worst difference between two witnesses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// The number of comparisons.
    pub count: u64,
    /// Largest difference.
    pub absolute: f64,
    /// Largest difference, relative to the largest derivative in the same unit.
    pub relative: f64,
    /// The largest relative difference in units of the precision.
    pub ulps: f64,
    /// The numbers of differences, in units of the precision, below 1, 10, 100 and so on.
    pub decades: [u64; 20],
    /// The one nearest to refusal.
    pub nearest: Tightest,
}

/// The comparison of two witnesses that used up most of its tolerance. If any needed perturbed rounding, it is one of
/// those, since the tolerance of the others could still grow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tightest {
    /// The share of the tolerance.
    pub share: f64,
    /// `true` if rounding was perturbed.
    pub perturbed: bool,
    /// The number of the sample.
    pub sample: usize,
    /// The number of the output.
    pub output: usize,
    /// The number of the input.
    pub input: usize,
    /// The number of every witness.
    pub numbers: ByWitness,
    /// The largest allowed difference of the two numbers in question.
    pub tolerance: f64,
}

impl Tightest {
    fn rank(&self) -> f64 {
        if self.perturbed {
            1.0 + self.share
        } else {
            self.share.min(1.0)
        }
    }
}

impl Worst {
    /// Adds one more comparison.
    pub(crate) fn note(&mut self, gap: f64, size: f64, eps: f64, at: Tightest) {
        self.count += 1;
        self.absolute = self.absolute.max(gap);
        let relative = if gap == 0.0 { 0.0 } else { gap / size };
        if relative.is_finite() {
            self.relative = self.relative.max(relative);
            self.ulps = self.ulps.max(relative / eps);
            let decade = (relative / eps).log10().floor() + 1.0;
            self.decades[(decade.max(0.0) as usize).min(19)] += 1;
        }
        let share = if gap == 0.0 { 0.0 } else { gap / at.tolerance };
        let here = Tightest { share, ..at };
        if here.rank() > self.nearest.rank() {
            self.nearest = here;
        }
    }
    /// Returns the power of ten of units of the precision that 99 of 100 differences stay below. The
    /// largest ones belong to inputs that no format can decide, such as nearly parallel sides.
    #[must_use]
    pub fn usual(&self) -> f64 {
        let total: u64 = self.decades.iter().sum();
        let mut seen = 0;
        for (decade, count) in (0..).zip(self.decades) {
            seen += count;
            if seen * 100 >= total * 99 {
                return 10_f64.powi(decade);
            }
        }
        f64::INFINITY
    }
    /// Adds the comparisons of another summary.
    pub(crate) fn merge(&mut self, other: &Worst, sample: usize) {
        self.count += other.count;
        self.absolute = self.absolute.max(other.absolute);
        self.relative = self.relative.max(other.relative);
        self.ulps = self.ulps.max(other.ulps);
        for (all, here) in self.decades.iter_mut().zip(other.decades) {
            *all += here;
        }
        if other.nearest.rank() > self.nearest.rank() {
            self.nearest = Tightest {
                sample,
                ..other.nearest
            };
        }
    }
}

/// The pairs of witnesses a report has a line for.
pub const PAIRS: [(Witness, Witness); 9] = [
    (Witness::Adjoint, Witness::Dual),
    (Witness::Adjoint, Witness::Difference),
    (Witness::Dual, Witness::Difference),
    (Witness::Adjoint, Witness::Wide),
    (Witness::Adjoint, Witness::Further(0)),
    (Witness::Adjoint, Witness::Batch),
    (Witness::Adjoint, Witness::NumDual),
    (Witness::Value, Witness::Planes),
    (Witness::Value, Witness::Points),
];

/// The findings at one sample.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The smoothness at the input.
    pub place: Smoothness,
    /// The numbers of directions along which the function is smooth, kinked and undecided.
    pub directions: [u64; 3],
    /// The number of directions along which another branch was taken, however small the step.
    pub switched: u64,
    /// `true` if the value jumps there.
    pub jump: bool,
    /// `true` if a declared convention was needed.
    pub convention: bool,
    /// The smallest relative difference of two compared numbers: the distance to the nearest change of branch. Infinite
    /// without comparisons.
    pub margin: f64,
    /// For each number of the input, `true` if some witness could judge the derivative with respect to it.
    pub judged: Vec<bool>,
    /// The worst difference of each pair of [`PAIRS`].
    pub worst: [Worst; PAIRS.len()],
    /// All refused faults, the most important first.
    pub faults: Vec<Fault>,
}
