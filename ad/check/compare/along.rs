//! One direction: the derivatives along it against what steps along it say.
use crate::ad::check::compare::derivative_test::DerivativeTest;
use crate::ad::check::compare::opinion::Opinion;
use crate::ad::check::compare::projection::worst_input;
use crate::ad::check::evidence::{Evidence, Item, comparison};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Jumps;
use crate::ad::check::symmetry::Kind;
use crate::ad::check::tolerances::{
    COARSE, DECIDED, FEW_INPUTS, FIRST, INFORMATIVE, NEAR_JUMP, ROUNDINGS, SAFETY, TALL,
};
use crate::ad::check::verdict::{Numbers, Place, Reason, Witness};
use crate::ad::check::witness::{Estimate, Ladder, dot};

/// Values along any direction from a first step.
pub(crate) type Climb<'c> = &'c dyn Fn(&[f64], f64) -> Ladder;

/// A direction to take differences along.
pub(crate) struct Along<'d> {
    pub(crate) e: &'d Evidence<'d>,
    /// The number of the direction: that of the input for the first ones of a short input.
    pub(crate) k: usize,
    pub(crate) direction: &'d [f64],
    /// Values along it.
    pub(crate) here: &'d Ladder,
    pub(crate) climb: Climb<'d>,
    /// The same across the border of the domain, where the function may be asked there.
    pub(crate) across: Option<Climb<'d>>,
    /// `true` if others have judged the derivative with respect to the number of the direction.
    pub(crate) covered: bool,
}

/// The derivatives of one row along a direction, and per number if the direction is an axis.
struct Derivatives {
    by_hand: Option<f64>,
    by_duals: Option<f64>,
    /// The divisor that makes a derivative along the direction one with respect to one number.
    per: f64,
    along: bool,
}

impl Derivatives {
    fn numbers(&self, difference: Option<f64>, sides: Option<[f64; 2]>) -> Numbers {
        Numbers {
            adjoint: self.by_hand.map(|derivative| derivative / self.per),
            dual: self.by_duals.map(|derivative| derivative / self.per),
            difference: difference.map(|derivative| derivative / self.per),
            sides: sides.map(|sides| sides.map(|derivative| derivative / self.per)),
            along: self.along,
            ..Numbers::default()
        }
    }
    /// The derivative by the other of the two exact witnesses.
    fn other(&self, witness: Witness) -> Option<f64> {
        match witness {
            Witness::Adjoint => self.by_duals,
            _ => self.by_hand,
        }
    }
}

impl Along<'_> {
    /// `true` for a function of shapes of which no source is known: shapes have borders and ties.
    fn is_of_shapes(&self) -> bool {
        !self.here.traced && self.e.subject.conventions().flat
    }

    /// `true` if the direction is that of one number.
    fn is_axis(&self) -> bool {
        self.e.x.len() <= FEW_INPUTS && self.k < self.e.x.len()
    }
    /// The number of the input that is named.
    fn input(&self) -> usize {
        if self.is_axis() { self.k } else { 0 }
    }

    /// By how much the value may change within the rounding of the steps along a direction. Along
    /// an axis steps are exact; of a function whose branches are not known, which may round its input, every number
    /// counts.
    fn reach(&self) -> f64 {
        let e = self.e;
        let moved = || (0..e.x.len()).filter(|&i| self.is_of_shapes() || self.direction[i] != 0.0);
        if !self.is_of_shapes() && moved().count() < 2 {
            return 0.0;
        }
        let derivative = |i: usize| e.rows.iter().fold(0.0_f64, |m, row| m.max(row.size[i]));
        moved().map(|i| derivative(i) * e.eps * e.x[i].abs()).sum()
    }

    /// `true` if any output jumps along the direction by more than steps are rounded; a complaint if it must
    /// not.
    pub(crate) fn jumps(&self) -> Notes {
        let (e, here) = (self.e, self.here);
        let mut said = Notes::new(e.x.len());
        let reach = self.reach();
        let mut unrest = Vec::new();
        for j in 0..e.y.len() {
            // Single precision may say zero where double does not.
            let size = here.center[j].abs().max(e.y[j].abs());
            if here.traced && here.jump(j, e.eps * size).is_some() {
                // Rounding within a branch is no jump.
                let none = vec![0.0; e.y.len()];
                unrest = e.spread(&e.y, Some(&none), |x| Some(e.subject.value(x)));
                unrest[j] = unrest[j].max(e.explained(j));
            }
            let noise = e.eps * size + unrest.get(j).unwrap_or(&0.0) + reach;
            let noise = noise.max(e.resolution[j]);
            // A kink may be nearer than the smallest step; a jump still jumps nearer by.
            let near = || (self.climb)(self.direction, NEAR_JUMP).jump(j, noise);
            if here.jump(j, noise).is_some() && near().is_some() {
                said.jump = true;
                let allowed = match e.subject.conventions().jumps {
                    Jumps::Never => false,
                    Jumps::FromZero => e.y[j] == 0.0,
                    Jumps::Anywhere => true,
                };
                if !allowed {
                    said.complain(Reason::Jump, j, self.k);
                }
                break;
            }
        }
        said
    }

    /// One row: what kind of place it is along the direction, whether branches switch, and what steps say
    /// about its derivatives.
    pub(crate) fn one_row(&self, row: &Item, noise: f64) -> Notes {
        let (e, direction) = (self.e, self.direction);
        let mut said = Notes::new(e.x.len());
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
        let ladder = |first| (self.climb)(direction, first);
        let own = match (self.is_axis(), e.x.get(self.k)) {
            (true, Some(x)) => x.abs() / direction[self.k].abs(),
            _ => 1.0,
        };
        let test = DerivativeTest {
            weights: &row.weights,
            here: self.here,
            climb: &ladder,
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
            let (seen, opinion) = self.one_derivative(row, witness, test, &derivatives, &mut said);
            place = match opinion {
                Opinion::Fine { .. } => place.or(Some(seen)),
                _ => Some(seen),
            };
            // Duals that say what the adjoint says need no check of their own.
            let equal = ROUNDINGS * e.eps * row.largest;
            let gap = derivatives.by_duals.map(|dual| (dual - derivative).abs());
            if gap.is_some_and(|gap| gap <= equal) {
                if let (false, Opinion::Fine { estimate, .. }) = (opinion.undefined(), opinion)
                    && let Some(found) = estimate
                {
                    let tolerance = SAFETY * found.error + row.allowed_along(direction) + equal;
                    let gap = derivatives
                        .by_duals
                        .map_or(0.0, |dual| (dual - found.value).abs());
                    self.note(row, 2, gap, (&found, tolerance), &derivatives, &mut said);
                }
                break;
            }
        }
        let (place, switched) = place.unwrap_or_else(|| {
            // No derivative at all: still say what kind of place it is.
            match test.first() {
                Opinion::Fine {
                    place, switched, ..
                } => (place, switched),
                _ => (Place::Undefined, self.here.traced),
            }
        });
        let derived = row.adjoint.is_some() || row.dual.is_some();
        if place != Place::Undefined && derived {
            said.told.push((row.output, self.k, place));
            match said.covered.get_mut(self.k) {
                Some(covered) if e.x.len() <= FEW_INPUTS => *covered = true,
                _ => said.covered.fill(true),
            }
        }
        said.directions[match place {
            Place::Smooth => 0,
            Place::Kink => 1,
            Place::Undefined => 2,
        }] += 1;
        said.switched += u64::from(switched);
        said
    }

    /// A comparison with an estimate.
    fn note(
        &self,
        row: &Item,
        pair: usize,
        gap: f64,
        (found, tolerance): (&Estimate, f64),
        derivatives: &Derivatives,
        said: &mut Notes,
    ) {
        let numbers = derivatives.numbers(Some(found.value), None);
        let at = comparison(row, self.input(), numbers, tolerance / derivatives.per);
        let size = row.largest / derivatives.per;
        said.compared(pair, gap / derivatives.per, size, self.e.eps, at);
    }

    /// One witness: what kind of place it is, and what the last ladder said.
    fn one_derivative(
        &self,
        row: &Item,
        witness: Witness,
        mut test: DerivativeTest<'_>,
        derivatives: &Derivatives,
        said: &mut Notes,
    ) -> ((Place, bool), Opinion) {
        let (e, direction) = (self.e, self.direction);
        let at = (row.output, self.input());
        let mut opinion = test.first();
        if opinion.complains() {
            e.provoke(row);
            e.provoke_widely(row);
            test.exact = row.allowed_along(direction);
            test.rough = e.rough_value(e.on(), &row.weights);
            opinion = test.first();
        }
        let coarse = opinion;
        opinion = test.finer(opinion);
        let covered = self.covered || said.covered.get(self.k).is_some_and(|covered| *covered);
        if self.is_axis() && opinion.undefined() && !covered {
            said.covered[self.k] |= self.coarsely_covered(row, coarse, test.exact);
        }
        let place = match opinion {
            Opinion::Fine {
                place,
                switched,
                estimate,
            } => {
                if let Some(found) = estimate.filter(|_| place != Place::Undefined) {
                    let tolerance = SAFETY * found.error + test.exact;
                    let gap = (found.value - test.derivative).abs();
                    let pair = if witness == Witness::Adjoint { 1 } else { 2 };
                    self.note(row, pair, gap, (&found, tolerance), derivatives, said);
                }
                (place, switched)
            }
            Opinion::Other {
                estimate,
                tolerance,
            } => {
                let agree = derivatives.by_hand.zip(derivatives.by_duals);
                let agree = agree.is_some_and(|(a, b)| (a - b).abs() <= test.exact);
                let review = test.again(opinion, agree);
                let found = review.against.unwrap_or(estimate);
                let tolerance = if review.stands {
                    SAFETY * found.error + test.exact
                } else {
                    tolerance
                };
                let tied = agree && e.exactly_tied();
                // Without the function's source, steps alone tell whether pieces meet.
                let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
                if !review.stands {
                    if review.supported {
                        (Place::Smooth, false)
                    } else {
                        (Place::Undefined, true)
                    }
                } else if agree && self.tell_nothing(&test) {
                    (Place::Undefined, true)
                } else if witness == Witness::Dual && e.tie_of_duals() {
                    said.convention = true;
                    (Place::Smooth, false)
                } else if tied && (chosen(e) || self.bent(row)) {
                    said.convention = true;
                    (Place::Undefined, true)
                } else if (tied || unknown)
                    && e.among_derivatives_nearby(
                        &row.weights,
                        direction,
                        (test.derivative, tolerance),
                        // A function without a kink bends: so do its derivatives between places.
                        if tied { 0.0 } else { DECIDED * row.largest },
                    )
                {
                    // Along this direction the function has a derivative, at the tie it has many.
                    said.convention = true;
                    (Place::Kink, true)
                } else if unknown && self.chosen_here(row) {
                    said.convention = true;
                    (Place::Undefined, true)
                } else {
                    let other = derivatives.other(witness);
                    let agrees = other
                        .is_some_and(|derivative| (derivative - found.value).abs() <= tolerance);
                    let input = if e.x.len() <= FEW_INPUTS {
                        at.1
                    } else {
                        worst_input(e, row, witness, direction, &|there| {
                            (self.climb)(there, FIRST[0])
                        })
                    };
                    said.complain_of(
                        Reason::Disagree(witness, Witness::Difference),
                        agrees.then_some(witness),
                        (at.0, input),
                        derivatives.numbers(Some(found.value), None),
                        tolerance / derivatives.per,
                    );
                    (Place::Smooth, false)
                }
            }
            Opinion::Outside { sides, tolerance } => {
                let border = self.here.ahead.len() < 2 || self.here.behind.len() < 2;
                let found = chosen(e) && e.exactly_tied();
                let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
                if self.flat(row, sides, (test.derivative, tolerance))
                    || found
                    || self.beyond(&test)
                    // No witness is known beyond the border, and a kink may lie on it.
                    || (unknown && border)
                    || (unknown && self.chosen_here(row))
                {
                    said.convention = true;
                } else if test.again(opinion, false).stands
                    && !e.among_derivatives_nearby(
                        &row.weights,
                        direction,
                        (test.derivative, tolerance),
                        0.0,
                    )
                {
                    let numbers = derivatives.numbers(None, Some(sides));
                    let tolerance = tolerance / derivatives.per;
                    said.complain_of(Reason::OutsideKink, None, at, numbers, tolerance);
                }
                (if border { Place::Smooth } else { Place::Kink }, true)
            }
        };
        (place, opinion)
    }

    /// `true` if the derivative is that of a declared convention: zero where the value is, or between zero and
    /// that of the only side at the border of the domain.
    fn flat(&self, row: &Item, sides: [f64; 2], (derivative, tolerance): (f64, f64)) -> bool {
        let border = self.here.ahead.len() < 2 || self.here.behind.len() < 2;
        self.e.subject.conventions().flat
            && if border {
                let (low, high) = (sides[0].min(0.0), sides[0].max(0.0));
                derivative >= low - tolerance && derivative <= high + tolerance
            } else {
                dot(&row.weights, &self.e.y) == 0.0 && derivative.abs() <= tolerance
            }
    }

    /// `true` if a function of unknown source that may jump anywhere has right derivatives at places beside the input: at
    /// the input itself it then has several results to choose from.
    fn chosen_here(&self, row: &Item) -> bool {
        self.e.subject.conventions().jumps == Jumps::Anywhere
            && self.e.is_right_beside(row, self.direction)
    }

    /// `true` if a kink exactly on the border of the domain has its other side beyond, and the derivative is
    /// between both.
    fn beyond(&self, test: &DerivativeTest<'_>) -> bool {
        let border = self.here.ahead.len() < 2 || self.here.behind.len() < 2;
        let Some(across) = self.across.filter(|_| border && self.e.exactly_tied()) else {
            return false;
        };
        let here = across(self.direction, FIRST[0]);
        let climb = |first| across(self.direction, first);
        let there = DerivativeTest {
            here: &here,
            climb: &climb,
            ..*test
        };
        let said = there.first();
        !said.undefined() && !said.complains()
    }

    /// `true` if steps say nothing of a derivative that two witnesses know: cancellation leaves values no digit, or the
    /// feature is smaller than the smallest step, as of lines that are parallel but for 1e-11 and of a ball of 1e-13.
    fn tell_nothing(&self, test: &DerivativeTest<'_>) -> bool {
        self.here.still() || self.seen_nearer(test) || self.left_at_once()
    }

    /// `true` if the function may jump anywhere, and no step takes the branches of the input.
    fn left_at_once(&self) -> bool {
        let mut rungs = self.here.ahead.iter().chain(&self.here.behind);
        let jumps = self.e.subject.conventions().jumps == Jumps::Anywhere;
        jumps && self.here.traced && rungs.all(|rung| !rung.same)
    }

    /// `true` if far smaller steps confirm the derivative.
    fn seen_nearer(&self, test: &DerivativeTest<'_>) -> bool {
        let here = (self.climb)(self.direction, NEAR_JUMP);
        let said = DerivativeTest {
            here: &here,
            ..*test
        }
        .first();
        matches!(said, Opinion::Fine { .. }) && !said.undefined()
    }

    /// `true` if there is no gradient at the input: the derivative along the sum of two directions is not the sum of
    /// the derivatives, although there is one along each, seen from both sides or from one. So it is where a
    /// function of homogeneous degree one that is not linear begins, as the circle through three points
    /// does where these coincide.
    fn bent(&self, row: &Item) -> bool {
        let (e, weights, noise) = (self.e, &row.weights, row.noise);
        let derivatives = |direction: &[f64]| {
            let ladder = (self.climb)(direction, FIRST[0]);
            [
                ladder.central(weights, noise, false),
                ladder.one_sided(true, weights, noise),
                ladder.one_sided(false, weights, noise),
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

    /// `true` if a derivative is covered although differences are too coarse for one as large as others are:
    /// not too coarse for this one as it typically is.
    fn coarsely_covered(&self, row: &Item, said: Opinion, exact: f64) -> bool {
        let Opinion::Fine {
            estimate: Some(found),
            ..
        } = said
        else {
            return false;
        };
        let e = self.e;
        let derivatives = |x: &[f64]| e.subject.adjoint(x, &row.weights);
        let typical = (row.adjoint.as_ref()).map_or(0.0, |list| {
            let typical = e.typical(&row.weights, list, &derivatives, TALL);
            typical[self.k] * self.direction[self.k].abs()
        });
        found.error == 0.0 || SAFETY * found.error + exact <= COARSE * typical
    }
}

/// `true` if the result is something that was chosen, such as the nearest points of two shapes, and not a
/// least or a greatest number: found by a search, or points that may jump. If several
/// choices are as good to the bit, derivatives are those of one of them, or their mean. They need not be
/// between the derivatives of the two choices on either side. Numbers that are no points
/// do not count: scores and areas that jump are not chosen from among others.
fn chosen(e: &Evidence<'_>) -> bool {
    let conventions = e.subject.conventions();
    let points = || e.subject.output_kinds().contains(&Kind::X);
    conventions.searches || (conventions.jumps == Jumps::Anywhere && points())
}
