//! Derivatives along one direction against differences along it.
use crate::ad::check::compare::derivative_test::DerivativeTest;
use crate::ad::check::compare::opinion::Opinion;
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
use crate::ad::check::witness::{Estimate, Ladder, dot};

/// Makes a ladder: values along a direction, from a first step downwards.
pub(crate) type Climb<'c> = &'c dyn Fn(&[f64], f64) -> Ladder;

/// Places in [`PAIRS`](crate::ad::check::verdict::PAIRS): derivatives by hand, and by duals, against differences.
const BY_HAND: usize = 1;
const BY_DUALS: usize = 2;

/// A direction to take differences along.
pub(crate) struct Along<'d> {
    pub(crate) e: &'d Evidence<'d>,
    /// The number of the direction. Of a short input the first directions are its axes, in order.
    pub(crate) k: usize,
    pub(crate) direction: &'d [f64],
    /// Values along it.
    pub(crate) here: &'d Ladder,
    pub(crate) climb: Climb<'d>,
    /// The same without regard to the domain, for a function that is defined everywhere.
    pub(crate) across: Option<Climb<'d>>,
    /// `true` if others have judged the derivative with respect to the number of the direction.
    pub(crate) covered: bool,
}

/// The derivatives of one combination along a direction, and per number if the direction is an axis.
struct Derivatives {
    by_hand: Option<f64>,
    by_duals: Option<f64>,
    /// The divisor that makes a derivative along the direction one with respect to one number.
    per: f64,
    along: bool,
}

impl Derivatives {
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
    /// Returns the derivative by the other of the two exact witnesses.
    fn other(&self, witness: Witness) -> Option<f64> {
        match witness {
            Witness::Adjoint => self.by_duals,
            _ => self.by_hand,
        }
    }
}

impl Along<'_> {
    /// Returns `true` if no source is known and the convention [`flat`](Conventions::flat) holds, as for shapes.
    fn is_of_shapes(&self) -> bool {
        !self.here.traced && self.e.subject.conventions().flat
    }

    /// Returns `true` if the direction is that of one number.
    fn is_axis(&self) -> bool {
        self.e.x.len() <= FEW_INPUTS && self.k < self.e.x.len()
    }
    /// Returns the input that a complaint names: the axis, or 0 along another direction.
    fn input(&self) -> usize {
        if self.is_axis() { self.k } else { 0 }
    }

    /// Returns the change of the value that rounding of the steps along a direction allows. Along an axis steps are
    /// exact. A function whose branches are unknown may round its input, so every number counts.
    fn reach(&self) -> f64 {
        let e = self.e;
        let moved = || (0..e.x.len()).filter(|&i| self.is_of_shapes() || self.direction[i] != 0.0);
        if !self.is_of_shapes() && moved().count() < 2 {
            return 0.0;
        }
        let derivative = |i: usize| e.rows.iter().fold(0.0_f64, |m, row| m.max(row.size[i]));
        moved().map(|i| derivative(i) * e.eps * e.x[i].abs()).sum()
    }

    /// Notes a jump of an output along the direction, larger than the rounding of steps, and a complaint where it must
    /// not jump.
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

    /// Judges one combination of outputs: the kind of point along the direction, changes of branch, and derivatives
    /// against differences.
    pub(crate) fn one_row(&self, row: &Combination, noise: f64) -> Notes {
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
            // An adjoint that agrees with the duals is judged for both.
            let equal = ROUNDINGS * e.eps * row.largest;
            if let (Witness::Adjoint, Some(dual)) = (witness, derivatives.by_duals)
                && (dual - derivative).abs() <= equal
            {
                let estimate = match opinion {
                    Opinion::Fine { estimate, .. } if !opinion.undefined() => estimate,
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
                        &mut said,
                    );
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
                _ => (Smoothness::Undefined, self.here.traced),
            }
        });
        let derived = row.adjoint.is_some() || row.dual.is_some();
        if place != Smoothness::Undefined && derived {
            said.told.push((row.output, self.k, place));
            match said.covered.get_mut(self.k) {
                Some(covered) if e.x.len() <= FEW_INPUTS => *covered = true,
                _ => said.covered.fill(true),
            }
        }
        said.directions[match place {
            Smoothness::Smooth => 0,
            Smoothness::Kink => 1,
            Smoothness::Undefined => 2,
        }] += 1;
        said.switched += u64::from(switched);
        said
    }

    /// Compares a derivative with an estimate by differences.
    fn note(
        &self,
        row: &Combination,
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

    /// Judges the derivative of one witness along the direction.
    fn one_derivative(
        &self,
        row: &Combination,
        witness: Witness,
        mut test: DerivativeTest<'_>,
        derivatives: &Derivatives,
        said: &mut Notes,
    ) -> ((Smoothness, bool), Opinion) {
        let (e, direction) = (self.e, self.direction);
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
                if let Some(found) = estimate.filter(|_| place != Smoothness::Undefined) {
                    let tolerance = SAFETY * found.error + test.exact;
                    let gap = (found.value - test.derivative).abs();
                    let pair = match witness {
                        Witness::Adjoint => BY_HAND,
                        _ => BY_DUALS,
                    };
                    self.note(row, pair, gap, (&found, tolerance), derivatives, said);
                }
                (place, switched)
            }
            Opinion::Other { estimate } => {
                self.other(row, witness, &test, estimate, derivatives, said)
            }
            Opinion::Outside { sides, tolerance } => {
                self.outside(row, witness, &test, (sides, tolerance), derivatives, said)
            }
        };
        (place, opinion)
    }

    /// Returns the kind of place, and whether branches switch, where steps give another derivative.
    fn other(
        &self,
        row: &Combination,
        witness: Witness,
        test: &DerivativeTest<'_>,
        estimate: Estimate,
        derivatives: &Derivatives,
        said: &mut Notes,
    ) -> (Smoothness, bool) {
        let (e, direction) = (self.e, self.direction);
        let agree = derivatives.by_hand.zip(derivatives.by_duals);
        let agree = agree.is_some_and(|(a, b)| (a - b).abs() <= test.exact);
        let review = test.again(Opinion::Other { estimate }, agree);
        if !review.stands {
            return match review.supported {
                true => (Smoothness::Smooth, false),
                false => (Smoothness::Undefined, true),
            };
        }
        if agree && self.tell_nothing(test) {
            return (Smoothness::Undefined, true);
        }
        let found = review.against.unwrap_or(estimate);
        let tolerance = SAFETY * found.error + test.exact;
        let tied = agree && e.exactly_tied();
        // Without the function's source, steps alone tell whether pieces meet.
        let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
        // Away from a tie derivatives differ a little between places; only larger differences are pieces.
        let least = if tied { 0.0 } else { DECIDED * row.largest };
        let is_among = || {
            let own = (test.derivative, tolerance);
            e.among_derivatives_nearby(&row.weights, direction, own, least)
        };
        let by_convention = if witness == Witness::Dual && e.tie_of_duals() {
            Some((Smoothness::Smooth, false))
        } else if tied && (chosen(e) || self.bent(row)) {
            Some((Smoothness::Undefined, true))
        } else if (tied || unknown) && is_among() {
            // At a tie any derivative between those of the pieces is right.
            Some((Smoothness::Kink, true))
        } else {
            (unknown && self.chosen_here(row)).then_some((Smoothness::Undefined, true))
        };
        if let Some(place) = by_convention {
            said.convention = true;
            return place;
        }
        let other = derivatives.other(witness);
        let agrees = other.is_some_and(|derivative| (derivative - found.value).abs() <= tolerance);
        let input = if e.x.len() <= FEW_INPUTS {
            self.input()
        } else {
            let ladder = |there: &[f64]| (self.climb)(there, FIRST[0]);
            worst_input(e, row, witness, direction, &ladder)
        };
        said.complain_of(
            Reason::Disagree(witness, Witness::Difference),
            agrees.then_some(witness),
            (row.output, input),
            derivatives.numbers(Some(found.value), None),
            tolerance / derivatives.per,
        );
        (Smoothness::Smooth, false)
    }

    /// Returns the kind of place, and whether branches switch, where the derivative is not between those of both sides.
    fn outside(
        &self,
        row: &Combination,
        witness: Witness,
        test: &DerivativeTest<'_>,
        (sides, tolerance): ([f64; 2], f64),
        derivatives: &Derivatives,
        said: &mut Notes,
    ) -> (Smoothness, bool) {
        let e = self.e;
        let border = self.here.is_at_border();
        let is_tie = chosen(e) && e.exactly_tied();
        let unknown = self.is_of_shapes() && derivatives.other(witness).is_none();
        let own = (test.derivative, tolerance);
        if self.flat(row, sides, own)
            || is_tie
            || self.beyond(test)
            // No witness is known beyond the border, and a kink may lie on it.
            || (unknown && border)
            || (unknown && self.chosen_here(row))
        {
            said.convention = true;
        } else if test
            .again(Opinion::Outside { sides, tolerance }, false)
            .stands
            && !e.among_derivatives_nearby(&row.weights, self.direction, own, 0.0)
        {
            let at = (row.output, self.input());
            let numbers = derivatives.numbers(None, Some(sides));
            let tolerance = tolerance / derivatives.per;
            said.complain_of(Reason::OutsideKink, None, at, numbers, tolerance);
        }
        let place = match border {
            true => Smoothness::Smooth,
            false => Smoothness::Kink,
        };
        (place, true)
    }

    /// Returns `true` if a declared convention allows the derivative. Where the value is zero, it may be zero. At the
    /// border of the domain it may lie between zero and that of the only side.
    fn flat(
        &self,
        row: &Combination,
        sides: [f64; 2],
        (derivative, tolerance): (f64, f64),
    ) -> bool {
        let border = self.here.is_at_border();
        self.e.subject.conventions().flat
            && if border {
                let (low, high) = (sides[0].min(0.0), sides[0].max(0.0));
                derivative >= low - tolerance && derivative <= high + tolerance
            } else {
                dot(&row.weights, &self.e.y) == 0.0 && derivative.abs() <= tolerance
            }
    }

    /// Returns `true` for a function of unknown source that may jump anywhere and whose derivatives are right beside
    /// the input. At the input it then chooses among several results.
    fn chosen_here(&self, row: &Combination) -> bool {
        self.e.subject.conventions().jumps == Jumps::Anywhere
            && self.e.is_right_beside(row, self.direction)
    }

    /// Returns `true` if a kink exactly on the border of the domain has its other side beyond, and the derivative is
    /// between both.
    fn beyond(&self, test: &DerivativeTest<'_>) -> bool {
        let border = self.here.is_at_border();
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

    /// Returns `true` if steps cannot decide although both witnesses agree. Either cancellation leaves no digits, or
    /// the feature is smaller than the smallest step: lines parallel but for 1e-11, a ball of 1e-13.
    fn tell_nothing(&self, test: &DerivativeTest<'_>) -> bool {
        self.here.still() || self.seen_nearer(test) || self.left_at_once()
    }

    /// Returns `true` if the function may jump anywhere, and no step takes the branches of the input.
    fn left_at_once(&self) -> bool {
        let mut rungs = self.here.ahead.iter().chain(&self.here.behind);
        let jumps = self.e.subject.conventions().jumps == Jumps::Anywhere;
        jumps && self.here.traced && rungs.all(|rung| !rung.same)
    }

    /// Returns `true` if far smaller steps confirm the derivative.
    fn seen_nearer(&self, test: &DerivativeTest<'_>) -> bool {
        let here = (self.climb)(self.direction, NEAR_JUMP);
        let said = DerivativeTest {
            here: &here,
            ..*test
        }
        .first();
        matches!(said, Opinion::Fine { .. }) && !said.undefined()
    }

    /// Returns `true` if there is no gradient at the input. Derivatives exist along two directions, from both sides or
    /// one, but that along their sum is another number. This is so where a function of degree one that is not linear
    /// begins: the circle through three points where these coincide.
    fn bent(&self, row: &Combination) -> bool {
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

    /// Returns `true` if a difference is precise enough for the usual size of the derivative, though not for the
    /// largest.
    fn coarsely_covered(&self, row: &Combination, said: Opinion, exact: f64) -> bool {
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

/// Returns `true` if the result is chosen from several, not a least or greatest number: by a search, or as points that
/// may jump.
///
/// If several choices are as good to the bit, derivatives are those of one of them, or their mean. They need not be
/// between the derivatives of the two choices on either side. Numbers that are no points do not count: scores and areas
/// that jump are not chosen from among others.
fn chosen(e: &Evidence<'_>) -> bool {
    let conventions = e.subject.conventions();
    let points = || e.subject.output_kinds().contains(&Kind::X);
    conventions.searches || (conventions.jumps == Jumps::Anywhere && points())
}
