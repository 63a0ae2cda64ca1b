//! Check of declared invariances: it moves the whole input and decides if the value follows as declared, and if the
//! derivatives balance. Both follow from [`symmetry`](crate::ad::check::symmetry). [`judge`](crate::ad::check::judge)
//! calls it away from jumps.
use crate::ad::check::evidence::{Combination, Evidence};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::symmetry::{
    Effect, Invariance, Kind, Motion, answer, exchanged, moved_by, velocity,
};
use crate::ad::check::tolerances::{
    DRAWS, GROWTH, ROTATION, ROUNDINGS, SAFETY, SCALING, TRANSLATION,
};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{dot, perturbed};
use crate::ad::declared::Jumps;

/// Checks declared motions, of values and of derivatives.
pub(crate) fn invariances(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let kinds = e.subject.kinds();
    if kinds.len() != e.x.len() || e.x.is_empty() {
        return notes;
    }
    // The deviation does not depend on the motion.
    let deviation = match e.subject.invariances() {
        [] => Vec::new(),
        _ => e.deviation(&e.y, None, |x| Some(e.subject.value(x))),
    };
    let jumps = jumps_by_rounding(e, &deviation);
    for &invariance in e.subject.invariances() {
        let amount = amount_of(invariance.motion, &e.scales);
        notes.add(value_moves(e, invariance, amount, &kinds, &deviation));
        if jumps {
            continue;
        }
        for row in &e.rows {
            let Some(derivatives) = &row.adjoint else {
                continue;
            };
            notes.add(match invariance.motion {
                Motion::Exchange => derivatives_exchange(e, row, derivatives),
                _ => derivatives_balance(e, invariance, row, derivatives, &kinds),
            });
        }
    }
    notes
}

/// Returns `true` if a value that may jump does so within roundings of the input: these take half of its digits, more
/// than any derivative that is worth a comparison.
fn jumps_by_rounding(e: &Evidence<'_>, deviation: &[f64]) -> bool {
    let size = e.x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let half = e.eps.sqrt() * size;
    let may_jump = e.subject.conventions().jumps != Jumps::Never;
    may_jump && deviation.iter().any(|&deviation| deviation > half)
}

/// Returns the amount of a motion of an input, from the scales of its numbers.
fn amount_of(motion: Motion, scales: &[f64]) -> f64 {
    match motion {
        Motion::TranslationX | Motion::TranslationY | Motion::TranslationZ => {
            TRANSLATION * scales.iter().fold(f64::INFINITY, |m, s| m.min(*s))
        }
        Motion::RotationX | Motion::RotationY | Motion::Rotation => ROTATION,
        Motion::Scaling => SCALING,
        Motion::Exchange => 0.0,
    }
}

/// Moves an input as a whole by an amount.
fn there(
    subject: &dyn Subject,
    motion: Motion,
    amount: f64,
    kinds: &[Kind],
    x: &[f64],
) -> Vec<f64> {
    let there = moved_by(motion, amount, kinds, x);
    let precision = subject.precision();
    there.iter().map(|x| precision.round(*x)).collect()
}

/// Returns the moved input, whose value breaks an invariance.
pub(crate) fn moved(subject: &dyn Subject, motion: Motion, x: &[f64]) -> Vec<f64> {
    let amount = amount_of(motion, &subject.scales(x));
    there(subject, motion, amount, &subject.kinds(), x)
}

/// Returns the kind of each number of the result.
fn outputs(e: &Evidence<'_>) -> Vec<Kind> {
    let kinds = e.subject.output_kinds();
    if kinds.len() == e.y.len() {
        kinds
    } else {
        vec![Kind::Number; e.y.len()]
    }
}

/// Compares the value at the moved input with the moved value.
fn value_moves(
    e: &Evidence<'_>,
    invariance: Invariance,
    amount: f64,
    kinds: &[Kind],
    deviation: &[f64],
) -> Notes {
    let (mut notes, subject) = (Notes::new(e.x.len()), e.subject);
    let motion = invariance.motion;
    let there = there(subject, motion, amount, kinds, e.x);
    if !subject.inside(&there) {
        return notes;
    }
    let y = subject.value(&there);
    let wanted = match invariance.answer {
        Effect::Stays => e.y.clone(),
        Effect::Power(p) => e.y.iter().map(|y| y * amount.powi(p)).collect(),
        Effect::Follows => moved_by(motion, amount, &outputs(e), &e.y),
    };
    // Moving rounds every number; derivatives bound the effect.
    let rows = e.rows.iter();
    let derivatives = rows.filter_map(|row| row.adjoint.as_ref().or(row.dual.as_ref()));
    let moved = |derivatives: &Vec<f64>| -> f64 {
        let each = derivatives.iter().zip(e.x).zip(&there);
        each.map(|((s, x), t)| s.abs() * (x.abs() + t.abs() / amount.max(1.0)))
            .sum()
    };
    let rounding: f64 = derivatives.map(moved).sum();
    for j in (0..y.len()).filter(|&j| !e.both_saturated(y[j], wanted[j])) {
        let size = y[j].abs().max(wanted[j].abs());
        let growth = (size / e.y[j].abs().max(f64::MIN_POSITIVE)).clamp(1.0, GROWTH);
        let off = 2.0 * deviation[j].max(e.resolution[j]) + e.eps * rounding;
        let mut tolerance = ROUNDINGS * e.eps * size + growth * SAFETY * off;
        if (y[j] - wanted[j]).abs() > tolerance {
            // The moved input has a conditioning of its own, and few draws may miss the conditioning of the original
            // one.
            tolerance += SAFETY * deviation_at(e, &there, &y)[j];
            tolerance += growth * SAFETY * deviation_at(e, e.x, &e.y)[j];
        }
        if (y[j] - wanted[j]).abs() > tolerance {
            let numbers = ByWitness::pair(y[j], wanted[j]);
            let reason = Reason::MotionBroken(motion);
            notes.add_fault_with(reason, None, (j, 0), numbers, tolerance);
        }
    }
    notes
}

/// Compares the derivatives with the arguments exchanged with the exchanged derivatives.
fn derivatives_exchange(e: &Evidence<'_>, row: &Combination, derivatives: &[f64]) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let Some(other) = e.subject.adjoint(&exchanged(e.x), &row.weights) else {
        return notes;
    };
    let other = exchanged(&other);
    for i in 0..other.len() {
        if (other[i] - derivatives[i]).abs() > row.allowed(i) {
            e.perturb(row);
            e.perturb_exchanged(row);
        }
        let sides = [derivatives[i], other[i]];
        unbalanced(
            &mut notes,
            Motion::Exchange,
            (row.output, i),
            sides,
            row.allowed(i),
        );
    }
    notes
}

/// Compares the derivative along the motion of the input with the velocity of the value.
fn derivatives_balance(
    e: &Evidence<'_>,
    invariance: Invariance,
    row: &Combination,
    derivatives: &[f64],
    kinds: &[Kind],
) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let speed = velocity(invariance.motion, kinds, e.x);
    let wanted = dot(&row.weights, &answer(invariance, &outputs(e), &e.y));
    let balance = dot(derivatives, &speed);
    // The velocity of the value has the value's error.
    let off = SAFETY
        * row.noise
        * match invariance.answer {
            Effect::Stays => 0.0,
            Effect::Power(p) => f64::from(p).abs(),
            Effect::Follows => 1.0,
        };
    let tolerance = || -> f64 {
        let own = |i: usize| {
            let own = ROUNDINGS * e.eps * derivatives[i].abs() + row.allowed(i);
            own * speed[i].abs()
        };
        (0..e.x.len()).map(own).sum::<f64>() + ROUNDINGS * e.eps * wanted.abs() + off
    };
    if (balance - wanted).abs() > tolerance() {
        e.perturb(row);
    }
    let at = (row.output, 0);
    unbalanced(
        &mut notes,
        invariance.motion,
        at,
        [balance, wanted],
        tolerance(),
    );
    notes
}

/// Returns the change of the value at another input when rounding errors are perturbed.
fn deviation_at(e: &Evidence<'_>, x: &[f64], y: &[f64]) -> Vec<f64> {
    let (subject, precision) = (e.subject, e.subject.precision());
    let rounding = subject.rounding(x);
    let mut deviation = vec![0.0_f64; y.len()];
    for round in 0..DRAWS {
        let there = perturbed(precision, x, &rounding, round);
        if subject.inside(&there) {
            for (deviation, (a, b)) in deviation
                .iter_mut()
                .zip(subject.value(&there).iter().zip(y))
            {
                *deviation = deviation.max((a - b).abs());
            }
        }
    }
    deviation
}

/// Adds a fault if derivatives do not follow a motion.
fn unbalanced(
    notes: &mut Notes,
    motion: Motion,
    at: (usize, usize),
    [a, b]: [f64; 2],
    tolerance: f64,
) {
    if (a - b).abs() > tolerance || (a - b).is_nan() {
        let reason = Reason::MotionUnbalanced(motion);
        let suspect = Some(Witness::Adjoint);
        notes.add_fault_with(reason, suspect, at, ByWitness::pair(a, b), tolerance);
    }
}
