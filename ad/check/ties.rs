//! The part of a judgement that weighs what was said when all witnesses have been covered.
use crate::ad::check::judge::Judge;
use crate::ad::check::verdict::{Fault, Place, Reason, Witness};

impl Judge<'_> {
    /// Refuses what duals say unless the input is a kink there, at which the adjoint has stood every
    /// step: then it is between the slopes of both sides, as the duals are, and a convention.
    pub(crate) fn resolve_ties(&mut self) {
        let exact_tie = self.tie_of_duals();
        let mut refused: Vec<Fault> = Vec::new();
        for fault in std::mem::take(&mut self.pending) {
            let mut told = self.compared.iter();
            let place = told.find(|told| (told.0, told.1) == (fault.output, fault.input));
            // Where steps could not tell, nobody but the duals has spoken.
            let excused = place.is_some_and(|told| exact_tie || told.2 == Place::Kink);
            let against = |other: &Fault| {
                let reasons = [
                    Reason::Disagree(Witness::Adjoint, Witness::Difference),
                    Reason::OutsideKink,
                ];
                other.output == fault.output && reasons.contains(&other.reason)
            };
            let stood = !self.found.faults.iter().any(against);
            let known =
                |other: &Fault| other.reason == fault.reason && other.output == fault.output;
            if excused && stood {
                self.found.convention = true;
            } else if !refused.iter().any(known) {
                refused.push(fault);
            }
        }
        // Duals are covered before differences.
        self.found.faults.splice(0..0, refused);
    }

    /// Where adjoint and duals differ, the one that the differences are against is outvoted.
    pub(crate) fn vote(&mut self) {
        let faults = self.found.faults.clone();
        for fault in &mut self.found.faults {
            if fault.reason != Reason::Disagree(Witness::Adjoint, Witness::Dual) {
                continue;
            }
            let against = |witness: Witness| {
                let reason = Reason::Disagree(witness, Witness::Difference);
                let found = faults.iter().find(|f| {
                    let anywhere = f.numbers.along || fault.numbers.along;
                    let here = f.output == fault.output && (anywhere || f.input == fault.input);
                    f.reason == reason && here
                });
                found.copied()
            };
            let (adjoint, dual) = (against(Witness::Adjoint), against(Witness::Dual));
            fault.suspect = match (adjoint, dual) {
                (Some(_), None) => Some(Witness::Adjoint),
                (None, Some(_)) => Some(Witness::Dual),
                _ => None,
            };
        }
    }

    /// Whether the duals may be wrong because the input is an exact tie of their source, of which they
    /// take a share although it may be no kink of the function; the adjoint is asked anyway.
    pub(crate) fn tie_of_duals(&self) -> bool {
        let tie = self.trace.is_some_and(|trace| trace.margin == 0.0);
        tie && !self.subject.conventions().shared_ties
    }
}
