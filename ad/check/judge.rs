//! The verdict about one input: evidence is gathered once, independent comparisons have their say, and
//! here it is decided what is refused.
//!
//! Tolerances come from the witnesses themselves. Two derivatives that are both exact up to rounding may differ by a
//! few units in the last place of the largest derivative in the same unit, and by as much as either of them changes
//! when the input is moved by its last digit (whatever a function does to rounding errors, it does to that too) or
//! its own roundings fall differently. A finite difference may be off by its own error estimate. A refusal by
//! differences must be repeated by other ladders of steps that agree among themselves. How these are measured is in
//! `tolerances`.
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
    let mut said = Notes::new(x.len());
    let Some(mut evidence) = Evidence::of_values(subject, x, &mut said) else {
        let mut findings = decided(None, said);
        findings.place = Smoothness::Undefined;
        return findings;
    };
    said.add(values(&evidence));
    said.add(proof(&evidence));
    if evidence.gather_derivatives(&mut draw, &mut said) {
        compare(&evidence, &mut draw, &mut said);
    }
    decided(Some(&evidence), said)
}

/// Compares all derivatives, one comparison after the other.
fn compare(e: &Evidence<'_>, draw: &mut Draw, said: &mut Notes) {
    said.add(exact(e));
    said.add(wide(e));
    // A tie that explains a difference along an axis need not explain one along other directions.
    if !said.convention && !said.complaints.iter().any(|fault| e.excusable(fault)) {
        said.add(projections(e, draw));
    }
    said.add(linear(e, draw));
    let refused = said.complaints.iter().any(|fault| !e.excusable(fault));
    let by_steps = steps(e, draw, said, refused);
    said.add(by_steps);
    if !said.jump {
        said.add(invariances(e));
    }
    if said.plain {
        said.add(curvature(e, draw));
    }
    // A function without derivatives was judged by other paths and invariances.
    let derivatives = |row: &Combination| row.adjoint.is_some() || row.dual.is_some();
    if !e.rows.iter().any(derivatives)
        && (!e.subject.other_values(e.x).is_empty() || !e.subject.invariances().is_empty())
    {
        said.covered.fill(true);
    }
    said.add(unchanged(e));
}

/// Checks that the value has not changed after everything else: a function with state answers differently now.
fn unchanged(e: &Evidence<'_>) -> Notes {
    let mut said = Notes::new(e.x.len());
    if !same_bits(&e.y, &e.subject.value(e.x)) {
        said.complain(Reason::Impure(Witness::Value), 0, 0);
    }
    for row in &e.rows {
        let again = e.subject.adjoint(e.x, &row.weights);
        if let (Some(first), Some(again)) = (&row.adjoint, again)
            && !same_bits(first, &again)
        {
            said.complain(Reason::Impure(Witness::Adjoint), row.output, 0);
        }
    }
    said
}

impl Evidence<'_> {
    /// Returns `true` if a complaint of duals may be explained by differences: at a tie duals and adjoint may each
    /// take an element of their own.
    pub(crate) fn excusable(&self, fault: &Fault) -> bool {
        let by_duals = [Witness::Dual, Witness::NumDual, Witness::Wide]
            .iter()
            .any(|&witness| fault.reason == Reason::Disagree(Witness::Adjoint, witness));
        by_duals && !fault.numbers.along && !self.subject.conventions().shared_ties
    }
}

/// Returns the verdict: which complaints stand, what is outvoted, and what kind of place it is.
fn decided(e: Option<&Evidence<'_>>, said: Notes) -> Findings {
    let (excusable, others): (Vec<Fault>, Vec<Fault>) = said
        .complaints
        .iter()
        .copied()
        .partition(|fault| e.is_some_and(|e| e.excusable(fault)));
    let others = one_of_a_kind(others);
    let (excused, refused): (Vec<Fault>, Vec<Fault>) = excusable
        .into_iter()
        .partition(|fault| explained(e, fault, &said, &others));
    // Exchanged arguments need not give the same element where it is a choice of the adjoint.
    let exchanged = |fault: &Fault| {
        let same = |other: &Fault| other.output == fault.output;
        fault.reason == Reason::MotionUnbalanced(Motion::Exchange) && excused.iter().any(same)
    };
    // Duals are asked before differences.
    let mut faults = one_of_a_kind(refused);
    faults.extend(others.into_iter().filter(|fault| !exchanged(fault)));
    vote(&mut faults);
    let [smooth, kinked, undefined] = said.directions;
    Findings {
        place: if said.jump || (smooth + kinked == 0 && undefined > 0) {
            Smoothness::Undefined
        } else if kinked > 0 {
            Smoothness::Kink
        } else {
            Smoothness::Smooth
        },
        directions: said.directions,
        switched: said.switched,
        jump: said.jump,
        convention: said.convention || !excused.is_empty(),
        margin: e
            .and_then(|e| e.trace)
            .map_or(f64::INFINITY, |trace| trace.margin),
        covered: said.covered,
        worst: said.worst,
        faults,
    }
}

/// Removes all faults of a kind and place except the first.
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

/// Returns `true` if the complaint of the duals is explained: the input is a kink there, and the adjoint agrees with
/// every step. Then it is between the derivatives of both sides, as the duals are, and a convention. If steps could not
/// tell, it must be between the derivatives of the pieces that meet there.
fn explained(e: Option<&Evidence<'_>>, fault: &Fault, said: &Notes, others: &[Fault]) -> bool {
    let Some(e) = e else { return false };
    let row = e.rows.iter().find(|row| row.output == fault.output);
    // At a tie both kinds of duals share alike: one that differs alone is wrong.
    let dual = Reason::Disagree(Witness::Adjoint, Witness::Dual);
    let alike = |other: &Fault| {
        (other.reason, other.output, other.input) == (dual, fault.output, fault.input)
    };
    if fault.reason == Reason::Disagree(Witness::Adjoint, Witness::NumDual)
        && row.is_some_and(|row| row.dual.is_some())
        && !said.complaints.iter().any(alike)
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
    let place = said
        .told
        .iter()
        .find(|told| (told.0, told.1) == (fault.output, fault.input));
    // The tie of the duals is all the evidence for long inputs.
    let tie = e.x.len() > FEW_INPUTS && e.tie_of_duals();
    place.is_some_and(|told| tie || told.2 == Smoothness::Kink)
        || row.is_some_and(|row| e.between_pieces(row))
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
