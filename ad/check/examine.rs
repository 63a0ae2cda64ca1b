//! Judgement of a function at many inputs. [`examine`] calls [`judge`](mod@crate::ad::check::judge) for each input,
//! makes refused ones simple, and sums everything up in a [`Report`]. It also refuses a function if too few inputs were
//! smooth or inside the domain.
use crate::ad::check::candidate::{Candidate, Typed};
use crate::ad::check::compare::invariance;
use crate::ad::check::judge::judge;
use crate::ad::check::report::{Failure, Report};
use crate::ad::check::sampling::Sampling;
use crate::ad::check::shrink::{Effort, is_like, shrunk};
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{ENOUGH, INSIDE_ONE_IN, KEPT, SMOOTH_ONE_IN, TIRED};
use crate::ad::check::verdict::{Findings, Reason, Smoothness};
use crate::ad::check::with_sampling::{SubjectRef, WithSampling};
use crate::ad::check::witness::Precision;
use crate::{Pack, Real};
use std::fmt::Debug;

/// Judges a function at many inputs. `meet` passes the function near an input to the closure that it gets.
/// `random_from` is the index of the first input that was drawn at random.
pub fn examine<S: Real, X: Pack<Scalar = S> + Debug>(
    name: &str,
    sampling: &Sampling<'_>,
    inputs: &[X],
    random_from: usize,
    meet: impl Fn(&X, &mut dyn FnMut(&dyn Subject)),
) -> Report {
    let meet = &meet;
    let typed = |x: &X| Typed { x: x.clone(), meet };
    let inputs: Vec<_> = inputs.iter().map(typed).collect();
    let inputs: Vec<&dyn Candidate<'_>> = inputs.iter().map(|x| x as _).collect();
    examined(name, sampling, &inputs, random_from)
}

/// Judges a function at inputs without types.
pub(crate) fn examined<'a>(
    name: &str,
    sampling: &Sampling<'_>,
    inputs: &[&dyn Candidate<'a>],
    random_from: usize,
) -> Report {
    let mut precision = Precision::F64;
    // Returns `None` outside the domain.
    let mut findings_at = |x: &dyn Candidate<'a>, sample: usize| -> Option<Findings> {
        let list = x.numbers();
        let mut findings = None;
        x.met(&mut |subject| {
            precision = subject.precision();
            // Shrinking makes up numbers that single precision may not have.
            let list: Vec<f64> = list.iter().map(|&x| precision.round(x)).collect();
            let subject = SubjectRef::Borrowed(subject);
            let subject = WithSampling { subject, sampling };
            if subject.inside(&list) {
                findings = Some(judge(&subject, &list, sampling.seed ^ sample as u64));
            }
        });
        findings
    };
    let mut report = Report::empty(name, sampling.seed);
    // Counts of the random inputs inside the domain, and of the smooth ones among them.
    let (mut smooth, mut drawn) = (0, 0);
    let mut judged: Vec<bool> = Vec::new();
    let mut effort = Effort::new();
    // Refused inputs since the last new reason.
    let mut without_news = 0;
    let mut simple: Vec<Box<dyn Candidate<'a> + 'a>> = Vec::new();
    for (sample, &x) in inputs.iter().enumerate() {
        let Some(findings) = findings_at(x, sample) else {
            report.outside += 1;
            continue;
        };
        report.samples += 1;
        drawn += usize::from(sample >= random_from);
        report.places[match findings.place {
            Smoothness::Smooth => 0,
            Smoothness::Kink => 1,
            Smoothness::Undefined => 2,
        }] += 1;
        smooth += usize::from(findings.place == Smoothness::Smooth && sample >= random_from);
        judged.resize(judged.len().max(findings.judged.len()), false);
        for (all, here) in judged.iter_mut().zip(&findings.judged) {
            *all |= here;
        }
        report.conventions += u64::from(findings.convention);
        report.jumps += u64::from(findings.jump);
        for (all, here) in report.directions.iter_mut().zip(findings.directions) {
            *all += here;
        }
        report.switched += findings.switched;
        if findings.margin > 0.0 {
            report.margin = report.margin.min(findings.margin);
        }
        for (all, here) in report.worst.iter_mut().zip(&findings.worst) {
            all.merge(here, sample);
        }
        report.refused += u64::from(!findings.faults.is_empty());
        without_news += usize::from(!findings.faults.is_empty());
        for fault in findings.faults {
            // A report shows each reason once.
            let is_known = |failure: &Failure| failure.fault.reason == fault.reason;
            if report.failures.iter().any(is_known) || report.failures.len() >= KEPT {
                continue;
            }
            let judged_again = &mut |x: &dyn Candidate<'a>| findings_at(x, sample);
            // One mistake has several reasons, and a simple input that shows one of them shows most.
            let shown = simple.iter().find_map(|x| {
                let findings = judged_again(&**x)?;
                let same = findings
                    .faults
                    .into_iter()
                    .find(|own| is_like(own, &fault))?;
                Some((x.refilled(&x.numbers()), same))
            });
            let (simplest, fault) = match shown {
                Some(shown) => shown,
                None => {
                    let (simplest, fault) =
                        shrunk(x, fault, findings.place, &mut effort, judged_again);
                    simple.push(simplest.refilled(&simplest.numbers()));
                    effort.quarter();
                    (simplest, fault)
                }
            };
            without_news = 0;
            let mut moved = String::new();
            if let Reason::MotionBroken(motion) = fault.reason {
                simplest.met(&mut |subject| {
                    let there = invariance::moved(subject, motion, &simplest.numbers());
                    moved = simplest.refilled(&there).code();
                });
            }
            report.failures.push(Failure {
                sample,
                fault,
                input: simplest.numbers(),
                code: simplest.code(),
                moved,
            });
        }
        if let Some(tick) = sampling.tick {
            tick();
        }
        if sampling.ends.is_some_and(|ends| ends()) {
            report.stopped = true;
            break;
        }
        // A refused input costs some twenty times a good one: differences are repeated before they refuse.
        if without_news >= TIRED && sample + 1 < inputs.len() {
            report.stopped = true;
            break;
        }
    }
    report.precision = precision;
    report.nearest = report.worst.each_ref().map(|worst| {
        let nearest = inputs.get(worst.nearest.sample);
        let shown = nearest.filter(|_| worst.nearest.share > 0.0);
        shown.map_or_else(String::new, |x| x.code())
    });
    let random = inputs.len().saturating_sub(random_from);
    let unjudged = judged.iter().position(|judged| !judged);
    if report.stopped {
        return report;
    }
    if random >= ENOUGH && drawn * INSIDE_ONE_IN < random {
        report.refused += 1;
        let failure = Failure::of_all(Reason::FewInside, random_from, 0);
        report.failures.push(failure);
    } else if drawn >= ENOUGH && too_few(smooth, drawn) {
        report.refused += 1;
        let failure = Failure::of_all(Reason::NothingSmooth, random_from, 0);
        report.failures.push(failure);
    } else if report.failures.is_empty() && (unjudged.is_some() || judged.is_empty()) {
        report.refused += 1;
        let input = unjudged.unwrap_or(0);
        let failure = Failure::of_all(Reason::Unjudged, random_from, input);
        report.failures.push(failure);
    }
    report
}

/// Returns `true` if fewer than one in `SMOOTH_ONE_IN` inputs are smooth, and by more than two standard deviations of
/// such a count.
fn too_few(smooth: usize, drawn: usize) -> bool {
    let expected = drawn as f64 / SMOOTH_ONE_IN as f64;
    smooth == 0 || (smooth as f64) < expected - 2.0 * expected.sqrt()
}
