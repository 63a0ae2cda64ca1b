//! Comparison of the derivatives along one direction with differences along it. For every combination of outputs it
//! decides how smooth the function is at the input along the direction, and if a derivative is refused. It
//! extrapolates differences at falling step sizes ([`DerivativeTest`]). Other sequences of steps must confirm a refusal,
//! and derivatives that a convention at kinks allows are accepted. [`steps`](super::steps) calls it for every direction.
use crate::ad::check::compare::assessment::Assessment;
use crate::ad::check::compare::derivative_test::DerivativeTest;
use crate::ad::check::compare::projection::worst_input;
use crate::ad::check::evidence::{Combination, Evidence, comparison};
use crate::ad::check::notes::Notes;
#[cfg(doc)]
use crate::ad::check::subject::Conventions;
use crate::ad::check::subject::Jumps;
use crate::ad::check::symmetry::Kind;
use crate::ad::check::tolerances::{
    COARSE, DECIDED, FEW_INPUTS, FIRST, INFORMATIVE, NEAR_JUMP, ROUNDINGS, SAFETY, TALL,
};
use crate::ad::check::verdict::{ByWitness, Reason, Smoothness, Witness};
use crate::ad::check::witness::{Estimate, StepSequence, dot};

/// A function that evaluates a sequence of steps along a direction, from a first step downwards.
pub(crate) type TakeSteps<'c> = &'c dyn Fn(&[f64], f64) -> StepSequence;

/// The index in [`PAIRS`](crate::ad::check::verdict::PAIRS) of derivatives by hand against differences.
const BY_HAND: usize = 1;
/// The index of derivatives by duals against differences.
const BY_DUALS: usize = 2;

/// A direction to take differences along.
pub(crate) struct AlongDirection<'d> {
    pub(crate) evidence: &'d Evidence<'d>,
    /// The index of the direction. For a short input the first directions are its axes, in order.
    pub(crate) k: usize,
    pub(crate) direction: &'d [f64],
    /// Values along it.
    pub(crate) here: &'d StepSequence,
    /// The function that evaluates further sequences.
    pub(crate) take_steps: TakeSteps<'d>,
    /// The function that evaluates steps without regard to the domain, for a function that is defined everywhere.
    pub(crate) across: Option<TakeSteps<'d>>,
    /// `true` if another comparison has judged the derivative with respect to number `k` of the input.
    pub(crate) judged: bool,
}

/// The derivatives of one combination of outputs along a direction, or with respect to one number if the direction is
/// an axis.
struct Derivatives {
    by_hand: Option<f64>,
    by_duals: Option<f64>,
    /// The divisor that turns a derivative along an axis into one with respect to its number; 1 for other directions.
    per: f64,
    /// `true` if the direction is no axis.
    along: bool,
}

impl Derivatives {
    /// Returns the derivatives and the differences that a report shows.
    fn numbers(&self, difference: Option<f64>, sides: Option<[f64; 2]>) -> ByWitness {
        ByWitness {
            adjoint: self.by_hand.map(|derivative| derivative / self.per),
            dual: self.by_duals.map(|derivative| derivative / self.per),
            difference: difference.map(|derivative| derivative / self.per),
            sides: sides.map(|sides| sides.map(|derivative| derivative / self.per)),
            along: self.along,
            ..ByWitness::default()
        }
    }
    /// Returns the derivative by duals for the adjoint, and by the adjoint for the duals.
    fn other(&self, witness: Witness) -> Option<f64> {
        match witness {
            Witness::Adjoint => self.by_duals,
            _ => self.by_hand,
        }
    }
}

impl AlongDirection<'_> {
    /// Returns `true` if no source is known and the convention [`flat`](Conventions::flat) holds, as for shapes.
    fn is_of_shapes(&self) -> bool {
        !self.here.traced && self.evidence.subject.conventions().flat
    }

    /// Returns `true` if the direction moves one number only.
    fn is_axis(&self) -> bool {
        self.evidence.x.len() <= FEW_INPUTS && self.k < self.evidence.x.len()
    }
    /// Returns the input that a fault names: the axis, or 0 along another direction.
    fn input(&self) -> usize {
        if self.is_axis() { self.k } else { 0 }
    }

    /// Returns the change of the value that rounding of the steps along the direction explains. Along an axis steps are
    /// exact. A function whose branches are unknown may round its input, so there every number counts.
    fn reach(&self) -> f64 {
        let e = self.evidence;
        let counted =
            || (0..e.x.len()).filter(|&i| self.is_of_shapes() || self.direction[i] != 0.0);
        if !self.is_of_shapes() && counted().count() < 2 {
            return 0.0;
        }
        let derivative = |i: usize| e.rows.iter().fold(0.0_f64, |m, row| m.max(row.size[i]));
        counted()
            .map(|i| derivative(i) * e.eps * e.x[i].abs())
            .sum()
    }

    /// Notes a jump of an output along the direction, larger than the rounding of steps, and a fault if the output must
    /// not jump.
    pub(crate) fn jumps(&self) -> Notes {
        let (e, here) = (self.evidence, self.here);
        let mut notes = Notes::new(e.x.len());
        let reach = self.reach();
        let mut deviation = Vec::new();
        for j in 0..e.y.len() {
            // Single precision may be zero where double is not.
            let size = here.center[j].abs().max(e.y[j].abs());
            if here.traced && here.jump(j, e.eps * size).is_some() {
                // Rounding within a branch is no jump.
                let none = vec![0.0; e.y.len()];
                deviation = e.deviation(&e.y, Some(&none), |x| Some(e.subject.value(x)));
                deviation[j] = deviation[j].max(e.explained(j));
            }
            let noise = e.eps * size + deviation.get(j).unwrap_or(&0.0) + reach;
            let noise = noise.max(e.resolution[j]);
            // A kink may be nearer than the smallest step. Only a jump shows at much smaller steps, too.
            let jump_nearer = || (self.take_steps)(self.direction, NEAR_JUMP).jump(j, noise);
            if here.jump(j, noise).is_some() && jump_nearer().is_some() {
                notes.jump = true;
                let allowed = match e.subject.conventions().jumps {
                    Jumps::Never => false,
                    Jumps::FromZero => e.y[j] == 0.0,
                    Jumps::Anywhere => true,
                };
                if !allowed {
                    notes.add_fault(Reason::Jump, j, self.k);
                }
                break;
            }
        }
        notes
    }

    /// Judges one combination of outputs: the smoothness along the direction, changes of branch, and derivatives
    /// against differences.
    pub(crate) fn one_row(&self, row: &Combination, noise: f64) -> Notes {
        let (e, direction) = (self.evidence, self.direction);
        let mut notes = Notes::new(e.x.len());
        let mut noise = noise;
        // Along random directions the steps are rounded in every coordinate.
        if direction.iter().filter(|d| **d != 0.0).count() > 1
            && let Some(derivatives) = row.adjoint.as_ref().or(row.dual.as_ref())
        {
            let each = derivatives.iter().zip(e.x);
            noise += each
                .map(|(derivative, x)| derivative.abs() * x.abs() * f64::EPSILON)
                .sum::<f64>();
        }
        let derivatives = Derivatives {
            by_hand: row.adjoint.as_ref().map(|list| dot(list, direction)),
            by_duals: match &row.dual {
                Some(list) => Some(dot(list, direction)),
                None => e.by_duals(row, direction),
            },
            per: if self.is_axis() {
                direction[self.k]
            } else {
                1.0
            },
            along: !self.is_axis(),
        };
        let sequence = |first| (self.take_steps)(direction, first);
        let own = match (self.is_axis(), e.x.get(self.k)) {
            (true, Some(x)) => x.abs() / direction[self.k].abs(),
            _ => 1.0,
        };
        let test = DerivativeTest {
            weights: &row.weights,
            here: self.here,
            steps_from: &sequence,
            derivative: 0.0,
            exact: f64::INFINITY,
            noise,
            rough: 0.0,
            hidden: 0.0,
            size: row.largest,
            guessed: false,
            own,
        };
        let mut place = None;
        let both = [
            (Witness::Adjoint, derivatives.by_hand),
            (Witness::Dual, derivatives.by_duals),
        ];
        for (witness, derivative) in both {
            let Some(derivative) = derivative else {
                continue;
            };
            let test = DerivativeTest {
                derivative,
                exact: row.allowed_along(direction),
                hidden: e.eps * e.x.iter().fold(0.0_f64, |m, x| m.max(x.abs())),
                guessed: e.subject.guessed_scales(),
                ..test
            };
            let (seen, assessment) =
                self.one_derivative(row, witness, test, &derivatives, &mut notes);
            place = match assessment {
                Assessment::Agrees { .. } => place.or(Some(seen)),
                _ => Some(seen),
            };
            // The judgement of an adjoint that equals the duals holds for both.
            let equal = ROUNDINGS * e.eps * row.largest;
            if let (Witness::Adjoint, Some(dual)) = (witness, derivatives.by_duals)
                && (dual - derivative).abs() <= equal
            {
                let estimate = match assessment {
                    Assessment::Agrees { estimate, .. } if !assessment.undefined() => estimate,
                    _ => None,
                };
                if let Some(found) = estimate {
                    let tolerance = SAFETY * found.error + row.allowed_along(direction) + equal;
                    let gap = (dual - found.value).abs();
                    self.note(
                        row,
                        BY_DUALS,
                        gap,
                        (&found, tolerance),
                        &derivatives,
                        &mut notes,
                    );
                }
                break;
            }
        }
        let (place, switched) = place.unwrap_or_else(|| {
            // Steps show the smoothness even of a function without derivatives.
            match test.first() {
                Assessment::Agrees {
                    place, switched, ..
                } => (place, switched),
                _ => (Smoothness::Undefined, self.here.traced),
            }
        });
        let derived = row.adjoint.is_some() || row.dual.is_some();
        if place != Smoothness::Undefined && derived {
            notes.smoothness.push((row.output, self.k, place));
            match notes.judged.get_mut(self.k) {
                Some(judged) if e.x.len() <= FEW_INPUTS => *judged = true,
                _ => notes.judged.fill(true),
            }
        }
        notes.directions[match place {
            Smoothness::Smooth => 0,
            Smoothness::Kink => 1,
            Smoothness::Undefined => 2,
        }] += 1;
        notes.switched += u64::from(switched);
        notes
    }

    /// Compares a derivative with an estimate by differences.
    fn note(
        &self,
        row: &Combination,
        pair: usize,
        gap: f64,
        (found, tolerance): (&Estimate, f64),
        derivatives: &Derivatives,
        notes: &mut Notes,
    ) {
        let numbers = derivatives.numbers(Some(found.value), None);
        let at = comparison(row, self.input(), numbers, tolerance / derivatives.per);
        let size = row.largest / derivatives.per;
        notes.compared(pair, gap / derivatives.per, size, self.evidence.eps, at);
    }

    /// Judges the derivative of one witness along the direction. Returns the smoothness, `true` if branches switch, and
    /// the assessment by the last sequence of steps.
    fn one_derivative(
        &self,
        row: &Combination,
        witness: Witness,
        mut test: DerivativeTest<'_>,
        derivatives: &Derivatives,
        notes: &mut Notes,
    ) -> ((Smoothness, bool), Assessment) {
        let (e, direction) = (self.evidence, self.direction);
        let mut assessment = test.first();
        if assessment.refuses() {
            e.perturb(row);
            e.perturb_in_double(row);
            test.exact = row.allowed_along(direction);
            test.rough = e.rough_value(e.on(), &row.weights);
            assessment = test.first();
        }
        let coarse = assessment;
        assessment = test.finer(assessment);
        let judged = self.judged || notes.judged.get(self.k).is_some_and(|judged| *judged);
        if self.is_axis() && assessment.undefined() && !judged {
            notes.judged[self.k] |= self.is_coarsely_judged(row, coarse, test.exact);
        }
        let place = match assessment {
            Assessment::Agrees {
                place,
                switched,
                estimate,
            } => {
                if let Some(found) = estimate.filter(|_| place != Smoothness::Undefined) {
                    let tolerance = SAFETY * found.error + test.exact;
                    let gap = (found.value - test.derivative).abs();
                    let pair = match witness {
                        Witness::Adjoint => BY_HAND,
                        _ => BY_DUALS,
                    };
                    self.note(row, pair, gap, (&found, tolerance), derivatives, notes);
                }
                (place, switched)
            }
            Assessment::Differs { estimate } => {
                self.decide_different(row, witness, &test, estimate, derivatives, notes)
            }
            Assessment::Outside { sides, tolerance } => {
                self.decide_outside(row, witness, &test, (sides, tolerance), derivatives, notes)
            }
        };
        (place, assessment)
    }

    /// Decides about a derivative that differs from the differences. Returns the smoothness, and `true` if branches
    /// switch.
    fn decide_different(
        &self,
        row: &Combination,
        witness: Witness,
        test: &DerivativeTest<'_>,
        estimate: Estimate,
        derivatives: &Derivatives,
        notes: &mut Notes,
    ) -> (Smoothness, bool) {
        let (e, direction) = (self.evidence, self.direction);
        let agree = derivatives.by_hand.zip(derivatives.by_duals);
        let agree = agree.is_some_and(|(a, b)| (a - b).abs() <= test.exact);
        let review = test.again(Assessment::Differs { estimate }, agree);
        if !review.stands {
            return match review.supported {
                true => (Smoothness::Smooth, false),
                false => (Smoothness::Undefined, true),
            };
        }
        if agree && self.is_undecidable(test) {
            return (Smoothness::Undefined, true);
        }
        let found = review.against.unwrap_or(estimate);
        let tolerance = SAFETY * found.error + test.exact;
        let tied = agree && e.exactly_tied();
        // Without the function's source and another witness, steps alone show if branches meet.
        let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
        // Derivatives vary smoothly between neighbouring points. Only a larger difference means another branch.
        let apart = if tied { 0.0 } else { DECIDED * row.largest };
        let is_among = || {
            let own = (test.derivative, tolerance);
            e.is_among_derivatives_nearby(&row.weights, direction, own, apart)
        };
        let by_convention = if witness == Witness::Dual && e.tie_of_duals() {
            Some((Smoothness::Smooth, false))
        } else if tied && (chosen(e) || self.bent(row))
            || agree && e.branches_nearby(row, direction, (test.derivative, tolerance))
        {
            Some((Smoothness::Undefined, true))
        } else if (tied || unknown) && is_among() {
            // At a tie any derivative between those of the branches is right.
            Some((Smoothness::Kink, true))
        } else {
            (unknown && self.chosen_here(row)).then_some((Smoothness::Undefined, true))
        };
        if let Some(place) = by_convention {
            notes.convention = true;
            return place;
        }
        let other = derivatives.other(witness);
        let agrees = other.is_some_and(|derivative| (derivative - found.value).abs() <= tolerance);
        let input = if e.x.len() <= FEW_INPUTS {
            self.input()
        } else {
            let sequence = |there: &[f64]| (self.take_steps)(there, FIRST[0]);
            worst_input(e, row, witness, direction, &sequence)
        };
        notes.add_fault_with(
            Reason::Disagree(witness, Witness::Difference),
            agrees.then_some(witness),
            (row.output, input),
            derivatives.numbers(Some(found.value), None),
            tolerance / derivatives.per,
        );
        (Smoothness::Smooth, false)
    }

    /// Decides about a derivative that is not between those of both sides. Returns the smoothness, and `true`, since
    /// branches switch.
    fn decide_outside(
        &self,
        row: &Combination,
        witness: Witness,
        test: &DerivativeTest<'_>,
        (sides, tolerance): ([f64; 2], f64),
        derivatives: &Derivatives,
        notes: &mut Notes,
    ) -> (Smoothness, bool) {
        let e = self.evidence;
        let border = self.here.is_at_border();
        let is_tie = chosen(e) && e.exactly_tied();
        let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
        let own = (test.derivative, tolerance);
        if self.flat(row, sides, own)
            || is_tie
            || self.beyond(test)
            // Nothing is known beyond the border, and a kink may lie on it.
            || (unknown && border)
            || (unknown && self.chosen_here(row))
            || e.branches_nearby(row, self.direction, own)
        {
            notes.convention = true;
        } else if test
            .again(Assessment::Outside { sides, tolerance }, false)
            .stands
            && !e.is_among_derivatives_nearby(&row.weights, self.direction, own, 0.0)
        {
            let at = (row.output, self.input());
            let numbers = derivatives.numbers(None, Some(sides));
            let tolerance = tolerance / derivatives.per;
            notes.add_fault_with(Reason::OutsideKink, None, at, numbers, tolerance);
        }
        let place = match border {
            true => Smoothness::Smooth,
            false => Smoothness::Kink,
        };
        (place, true)
    }

    /// Returns `true` if the declared convention [`flat`](Conventions::flat) allows the derivative. At the border of the
    /// domain it may lie between zero and that of the only side. Elsewhere it may be zero if the value is zero.
    fn flat(
        &self,
        row: &Combination,
        sides: [f64; 2],
        (derivative, tolerance): (f64, f64),
    ) -> bool {
        let border = self.here.is_at_border();
        self.evidence.subject.conventions().flat
            && if border {
                let (low, high) = (sides[0].min(0.0), sides[0].max(0.0));
                derivative >= low - tolerance && derivative <= high + tolerance
            } else {
                dot(&row.weights, &self.evidence.y) == 0.0 && derivative.abs() <= tolerance
            }
    }

    /// Returns `true` for a function that may jump anywhere and whose derivatives are right near the input. At the input
    /// it then chooses among several results. Callers ask it of functions without a source.
    fn chosen_here(&self, row: &Combination) -> bool {
        self.evidence.subject.conventions().jumps == Jumps::Anywhere
            && self.evidence.is_right_nearby(row, self.direction)
    }

    /// Returns `true` if a kink lies exactly on the border of the domain, and the derivative is between those of both
    /// sides. Steps beyond the border give the derivative of the other side.
    fn beyond(&self, test: &DerivativeTest<'_>) -> bool {
        let border = self.here.is_at_border();
        let Some(across) = self
            .across
            .filter(|_| border && self.evidence.exactly_tied())
        else {
            return false;
        };
        let here = across(self.direction, FIRST[0]);
        let steps_from = |first| across(self.direction, first);
        let there = DerivativeTest {
            here: &here,
            steps_from: &steps_from,
            ..*test
        };
        let assessment = there.first();
        !assessment.undefined() && !assessment.refuses()
    }

    /// Returns `true` if steps cannot decide about a derivative on which both witnesses agree. Either cancellation
    /// leaves no digits, or the feature is smaller than the smallest step: lines with an angle of 1e-11, a ball of 1e-13.
    fn is_undecidable(&self, test: &DerivativeTest<'_>) -> bool {
        self.here.still() || self.is_confirmed_nearer(test) || self.leaves_branch_at_once()
    }

    /// Returns `true` if the function may jump anywhere and takes other branches at every step than at the input.
    fn leaves_branch_at_once(&self) -> bool {
        let mut steps = self.here.ahead.iter().chain(&self.here.behind);
        let jumps = self.evidence.subject.conventions().jumps == Jumps::Anywhere;
        jumps && self.here.traced && steps.all(|step| !step.same)
    }

    /// Returns `true` if far smaller steps confirm the derivative.
    fn is_confirmed_nearer(&self, test: &DerivativeTest<'_>) -> bool {
        let here = (self.take_steps)(self.direction, NEAR_JUMP);
        let assessment = DerivativeTest {
            here: &here,
            ..*test
        }
        .first();
        matches!(assessment, Assessment::Agrees { .. }) && !assessment.undefined()
    }

    /// Returns `true` if there is no gradient at the input. Derivatives then exist along two directions, from both sides
    /// or one, but the derivative along their sum is not the sum of both. This holds at zero for a function that
    /// grows in proportion to its input and is not linear. An example is the circle through three points that coincide.
    fn bent(&self, row: &Combination) -> bool {
        let (e, weights, noise) = (self.evidence, &row.weights, row.noise);
        let derivatives = |direction: &[f64]| {
            let sequence = (self.take_steps)(direction, FIRST[0]);
            [
                sequence.central(weights, noise, false),
                sequence.one_sided(true, weights, noise),
                sequence.one_sided(false, weights, noise),
            ]
        };
        let here = derivatives(self.direction);
        (0..e.x.len()).any(|i| {
            let mut other = vec![0.0; e.x.len()];
            other[i] = e.scales[i];
            let sum = other.iter().zip(self.direction).map(|(a, b)| a + b);
            let both = derivatives(&sum.collect::<Vec<f64>>());
            let other = derivatives(&other);
            (0..3).any(|side| {
                let (Some(one), Some(other), Some(both)) = (here[side], other[side], both[side])
                else {
                    return false;
                };
                let gap = (both.value - one.value - other.value).abs();
                let errors = both.error + one.error + other.error;
                gap > INFORMATIVE * row.largest && gap > SAFETY * errors
            })
        })
    }

    /// Returns `true` if a difference is precise enough for the usual size of this derivative, though not for the size
    /// of the largest one.
    fn is_coarsely_judged(&self, row: &Combination, coarse: Assessment, exact: f64) -> bool {
        let Assessment::Agrees {
            estimate: Some(found),
            ..
        } = coarse
        else {
            return false;
        };
        let e = self.evidence;
        let derivatives = |x: &[f64]| e.subject.adjoint(x, &row.weights);
        let typical = (row.adjoint.as_ref()).map_or(0.0, |list| {
            let typical = e.typical(&row.weights, list, &derivatives, TALL);
            typical[self.k] * self.direction[self.k].abs()
        });
        found.error == 0.0 || SAFETY * found.error + exact <= COARSE * typical
    }
}

/// Returns `true` if the result is one choice of several, not a least or greatest number. Results of searches are, and
/// points that may jump.
///
/// If several choices tie to the bit, derivatives are those of one of them, or their mean. They need not be between the
/// derivatives of the two choices on either side. Jumping numbers that are no points do not count: scores and areas are
/// not chosen from among others.
fn chosen(e: &Evidence<'_>) -> bool {
    let conventions = e.subject.conventions();
    let points = || e.subject.output_kinds().contains(&Kind::X);
    conventions.searches || (conventions.jumps == Jumps::Anywhere && points())
}
