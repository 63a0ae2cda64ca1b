//! The verdict about one input: [`judge()`] gathers evidence once, runs the independent comparisons, and decides which
//! of their faults are refused. [`examine`](fn@crate::ad::check::examine) calls it for every input.
//!
//! Tolerances come from the witnesses themselves. Two derivatives that are both exact up to rounding may differ by a
//! few units in the last place of the largest derivative in that unit. They may also differ by the change of either of
//! them when the input moves by its last digit (a function amplifies that like its rounding errors) or its own
//! roundings fall differently. A finite difference may be off by its own error estimate. A refusal by differences must
//! be repeated by other sequences of steps that agree among themselves. `tolerances` has the numbers of these
//! measurements.
use crate::ad::check::compare::curvature::curvature;
use crate::ad::check::compare::exact::exact;
use crate::ad::check::compare::invariance::invariances;
use crate::ad::check::compare::linear::linear;
use crate::ad::check::compare::projection::projections;
use crate::ad::check::compare::proof::proof;
use crate::ad::check::compare::steps::steps;
use crate::ad::check::compare::values::values;
use crate::ad::check::compare::wide::wide;
use crate::ad::check::evidence::{Combination, Evidence, same_bits};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::symmetry::Motion;
use crate::ad::check::tolerances::FEW_INPUTS;
use crate::ad::check::verdict::{Fault, Findings, Reason, Smoothness, Witness};
use crate::ad::sample::Draw;

/// Checks everything at one input. `seed` chooses random directions.
#[must_use]
pub fn judge(subject: &dyn Subject, x: &[f64], seed: u64) -> Findings {
    let mut draw = Draw::new(seed);
    let mut notes = Notes::new(x.len());
    let Some(mut evidence) = Evidence::of_values(subject, x, &mut notes) else {
        let mut findings = decided(None, notes);
        findings.place = Smoothness::Undefined;
        return findings;
    };
    notes.add(values(&evidence));
    notes.add(proof(&evidence));
    if evidence.gather_derivatives(&mut draw, &mut notes) {
        compare(&evidence, &mut draw, &mut notes);
    }
    decided(Some(&evidence), notes)
}

/// Compares all derivatives, one comparison after the other.
fn compare(e: &Evidence<'_>, draw: &mut Draw, notes: &mut Notes) {
    notes.add(exact(e));
    notes.add(wide(e));
    // A tie that explains a difference along an axis need not explain one along other directions.
    if !notes.convention && !notes.faults.iter().any(|fault| e.excusable(fault)) {
        notes.add(projections(e, draw));
    }
    notes.add(linear(e, draw));
    let refused = notes.faults.iter().any(|fault| !e.excusable(fault));
    let by_steps = steps(e, draw, notes, refused);
    notes.add(by_steps);
    if !notes.jump {
        notes.add(invariances(e));
    }
    if notes.plain {
        notes.add(curvature(e, draw));
    }
    // A function without derivatives was judged by other paths and invariances.
    let derivatives = |row: &Combination| row.adjoint.is_some() || row.dual.is_some();
    if !e.rows.iter().any(derivatives)
        && (!e.subject.other_values(e.x).is_empty() || !e.subject.invariances().is_empty())
    {
        notes.judged.fill(true);
    }
    notes.add(unchanged(e));
}

/// Checks that the value has not changed after everything else: a function with state answers differently now.
fn unchanged(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    if !same_bits(&e.y, &e.subject.value(e.x)) {
        notes.add_fault(Reason::Impure(Witness::Value), 0, 0);
    }
    for row in &e.rows {
        let again = e.subject.adjoint(e.x, &row.weights);
        if let (Some(first), Some(again)) = (&row.adjoint, again)
            && !same_bits(first, &again)
        {
            notes.add_fault(Reason::Impure(Witness::Adjoint), row.output, 0);
        }
    }
    notes
}

impl Evidence<'_> {
    /// Returns `true` if differences may explain a fault that duals show: at a tie duals and adjoint may each take an
    /// element of their own.
    pub(crate) fn excusable(&self, fault: &Fault) -> bool {
        let by_duals = [Witness::Dual, Witness::NumDual, Witness::Wide]
            .iter()
            .any(|&witness| fault.reason == Reason::Disagree(Witness::Adjoint, witness));
        by_duals && !fault.numbers.along && !self.subject.conventions().shared_ties
    }
}

/// Returns the verdict: which faults stand, which witness is outvoted, and the smoothness at the input.
fn decided(e: Option<&Evidence<'_>>, notes: Notes) -> Findings {
    let (excusable, others): (Vec<Fault>, Vec<Fault>) = notes
        .faults
        .iter()
        .copied()
        .partition(|fault| e.is_some_and(|e| e.excusable(fault)));
    let others = one_of_a_kind(others);
    let (excused, refused): (Vec<Fault>, Vec<Fault>) = excusable
        .into_iter()
        .partition(|fault| explained(e, fault, &notes, &others));
    // Exchanged arguments need not give the same element where it is a choice of the adjoint.
    let exchanged = |fault: &Fault| {
        let same = |other: &Fault| other.output == fault.output;
        fault.reason == Reason::MotionUnbalanced(Motion::Exchange) && excused.iter().any(same)
    };
    // Duals are compared before differences.
    let mut faults = one_of_a_kind(refused);
    faults.extend(others.into_iter().filter(|fault| !exchanged(fault)));
    vote(&mut faults);
    let [smooth, kinked, undefined] = notes.directions;
    Findings {
        place: if notes.jump || (smooth + kinked == 0 && undefined > 0) {
            Smoothness::Undefined
        } else if kinked > 0 {
            Smoothness::Kink
        } else {
            Smoothness::Smooth
        },
        directions: notes.directions,
        switched: notes.switched,
        jump: notes.jump,
        convention: notes.convention || !excused.is_empty(),
        margin: e
            .and_then(|e| e.trace)
            .map_or(f64::INFINITY, |trace| trace.margin),
        judged: notes.judged,
        worst: notes.worst,
        faults,
    }
}

/// Removes all faults of one reason and output except the first.
fn one_of_a_kind(all: Vec<Fault>) -> Vec<Fault> {
    let mut kept: Vec<Fault> = Vec::new();
    for fault in all {
        let known = |other: &Fault| (other.reason, other.output) == (fault.reason, fault.output);
        if !kept.iter().any(known) {
            kept.push(fault);
        }
    }
    kept
}

/// Returns `true` if a fault that duals show is explained: the input is a kink there, and the adjoint agrees with every
/// step. The adjoint is then between the derivatives of both sides, as the duals are, and a convention chooses it. If
/// steps could not decide, it must be between the derivatives of the branches that meet there.
fn explained(e: Option<&Evidence<'_>>, fault: &Fault, notes: &Notes, others: &[Fault]) -> bool {
    let Some(e) = e else { return false };
    let row = e.rows.iter().find(|row| row.output == fault.output);
    // At a tie both kinds of duals take equal shares: one that differs alone is wrong.
    let dual = Reason::Disagree(Witness::Adjoint, Witness::Dual);
    let alike = |other: &Fault| {
        (other.reason, other.output, other.input) == (dual, fault.output, fault.input)
    };
    if fault.reason == Reason::Disagree(Witness::Adjoint, Witness::NumDual)
        && row.is_some_and(|row| row.dual.is_some())
        && !notes.faults.iter().any(alike)
    {
        return false;
    }
    let against = |other: &Fault| {
        let reasons = [
            Reason::Disagree(Witness::Adjoint, Witness::Difference),
            Reason::OutsideKink,
        ];
        other.output == fault.output && reasons.contains(&other.reason)
    };
    if others.iter().any(against) {
        return false;
    }
    let place = notes
        .smoothness
        .iter()
        .find(|place| (place.0, place.1) == (fault.output, fault.input));
    // The tie of the duals is all the evidence for long inputs.
    let tie = e.x.len() > FEW_INPUTS && e.tie_of_duals();
    place.is_some_and(|place| tie || place.2 == Smoothness::Kink)
        || row.is_some_and(|row| e.is_between_branches(row))
}

/// Marks the adjoint or the duals as the suspect: if they differ, the one that finite differences contradict.
fn vote(faults: &mut [Fault]) {
    let all = faults.to_vec();
    for fault in faults {
        if fault.reason != Reason::Disagree(Witness::Adjoint, Witness::Dual) {
            continue;
        }
        let against = |witness: Witness| {
            let reason = Reason::Disagree(witness, Witness::Difference);
            all.iter().any(|f| {
                let anywhere = f.numbers.along || fault.numbers.along;
                let here = f.output == fault.output && (anywhere || f.input == fault.input);
                f.reason == reason && here
            })
        };
        fault.suspect = match (against(Witness::Adjoint), against(Witness::Dual)) {
            (true, false) => Some(Witness::Adjoint),
            (false, true) => Some(Witness::Dual),
            _ => None,
        };
    }
}
