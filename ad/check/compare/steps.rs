//! Comparison of adjoint and duals with differences, at a kink with the derivatives of both sides. It chooses the
//! directions (axes, random ones, at a kink those that keep ties), evaluates sequences of steps along each, and has
//! [`along`](super::along) judge them. [`judge`](crate::ad::check::judge) calls it.
use crate::ad::check::compare::along::AlongDirection;
use crate::ad::check::evidence::{Evidence, finite};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{
    BORDER, FEW_INPUTS, FIRST, KINK_DIRECTIONS, LONG_DIRECTIONS, TIED_DIRECTIONS, WIDE_NOISE,
};
use crate::ad::check::trace::Trace;
use crate::ad::check::witness::{Probed, StepSequence, axis};
use crate::ad::sample::Draw;

/// Compares derivatives with differences along every direction. A long input that is `refused` already, in one number
/// or along a direction, is tried along no further ones: they are all alike.
pub(crate) fn steps(e: &Evidence<'_>, draw: &mut Draw, before: &Notes, refused: bool) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let on = e.on();
    let (center, trace) = match on.traced(e.x) {
        Some((values, trace)) => (values, Some(trace)),
        None => (on.value(e.x), None),
    };
    let n = e.x.len();
    if n == 0 || center.len() != e.y.len() || center.iter().any(|y| !y.is_finite()) {
        return notes;
    }
    let usable = |values: &Vec<f64>| values.len() == center.len() && finite(values);
    let anywhere = |places: &[Vec<f64>]| -> Vec<Probed> {
        let found: Vec<(Vec<f64>, Option<Trace>)> = match on.traced_all(places) {
            Some(all) => all.into_iter().map(|(y, trace)| (y, Some(trace))).collect(),
            None => places.iter().map(|x| (on.value(x), None)).collect(),
        };
        let found = found.into_iter();
        found
            .map(|it| Some(it).filter(|it| usable(&it.0)))
            .collect()
    };
    let probe = |places: &[Vec<f64>]| -> Vec<Probed> {
        let inside: Vec<bool> = places.iter().map(|x| on.inside(x)).collect();
        let asked = places.iter().zip(&inside).filter(|(_, inside)| **inside);
        let asked: Vec<Vec<f64>> = asked.map(|(x, _)| x.clone()).collect();
        let mut found = anywhere(&asked).into_iter();
        let next = |inside: bool| if inside { found.next().flatten() } else { None };
        inside.into_iter().map(next).collect()
    };
    let take_steps = |direction: &[f64], first: f64| {
        StepSequence::evaluate(
            &probe,
            on.precision(),
            e.x,
            &center,
            trace,
            direction,
            first,
        )
    };
    let across = |direction: &[f64], first: f64| {
        let precision = on.precision();
        StepSequence::evaluate(&anywhere, precision, e.x, &center, trace, direction, first)
    };
    let (mut directions, more) = directions(e, draw);
    // Differences in double precision have the rounding of its numbers.
    let wide_noise = e.wide.as_ref().map(|_| {
        // Results that the format does not hold are not judged.
        let held = center.iter().zip(&e.off_scale).filter(|(_, off)| !**off);
        let sizes: f64 = held.map(|(y, _)| y.abs()).sum();
        let own: f64 = e.resolution.iter().sum();
        (WIDE_NOISE * f64::EPSILON * sizes).max(own)
    });
    let (mut plain, mut kinks, mut k) = (true, false, 0);
    while k < directions.len() {
        let here = take_steps(&directions[k], FIRST[0]);
        let along = AlongDirection {
            evidence: e,
            k,
            direction: &directions[k],
            here: &here,
            take_steps: &take_steps,
            across: on.total().then_some(&across),
            judged: before.judged.get(k).is_some_and(|judged| *judged),
        };
        let jumps = along.jumps();
        if jumps.jump {
            notes.directions[2] += e.rows.len() as u64;
            plain = false;
            notes.add(jumps);
        } else {
            for row in &e.rows {
                let one = along.one_row(row, wide_noise.unwrap_or(row.noise));
                kinks |= one.directions[1] > 0;
                plain &= one.switched == 0;
                notes.add(one);
            }
        }
        k += 1;
        // The directions of a long input are all alike: one refusal is enough.
        if n > FEW_INPUTS && (refused || notes.faults.iter().any(|c| !e.excusable(c))) {
            break;
        }
        // At a kink the coordinate axes are not enough.
        if k == n && kinks && n <= FEW_INPUTS {
            directions.extend(more.iter().cloned());
            directions.extend(tied(e));
        }
    }
    let [smooth, kinked, undefined] = notes.directions;
    notes.plain = plain && smooth > 0 && kinked == 0 && undefined == 0 && !notes.jump;
    notes
}

/// Returns the axes, or random directions of a long input, and more for a kink.
fn directions(e: &Evidence<'_>, draw: &mut Draw) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let n = e.x.len();
    let mut random = || -> Vec<f64> {
        let within = |scale: &f64| scale * draw.within(-1.0, 1.0);
        e.scales.iter().map(within).collect()
    };
    if n > FEW_INPUTS {
        let all = (0..LONG_DIRECTIONS).map(|_| random()).collect();
        // Unused draws, so that the later ones stay the same.
        (0..KINK_DIRECTIONS).for_each(|_| drop(random()));
        return (all, Vec::new());
    }
    let axes = (0..n).map(|i| axis(n, i).iter().map(|d| d * e.scales[i]).collect());
    let mut more: Vec<Vec<f64>> = (0..KINK_DIRECTIONS).map(|_| random()).collect();
    // A number at the border of its domain can move to one side only, and one side of a kink gives no information on
    // the other. Such a number stays, so that both sides are seen.
    for i in (0..n).filter(|&i| bordered(e, i)) {
        more.iter_mut().for_each(|direction| direction[i] = 0.0);
    }
    more.retain(|direction| direction.iter().any(|d| *d != 0.0));
    (axes.collect(), more)
}

/// Returns `true` if a number is at the border of its domain.
fn bordered(e: &Evidence<'_>, i: usize) -> bool {
    let inside = [-BORDER, BORDER].map(|step| {
        let mut there = e.x.to_vec();
        there[i] += step * e.scales[i];
        e.on().inside(&there)
    });
    inside.contains(&false)
}

/// Returns directions that keep ties: all numbers of one magnitude move alike along each. A kink of many arguments is
/// smooth there, and a derivative is unique.
fn tied(e: &Evidence<'_>) -> Vec<Vec<f64>> {
    let mut sizes: Vec<u64> = e.x.iter().map(|x| x.abs().to_bits()).collect();
    sizes.sort_unstable();
    sizes.dedup();
    // Without a source nothing is known beyond a border, so a number there stays.
    let stays = |i: usize| e.trace.is_none() && e.subject.conventions().flat && bordered(e, i);
    let direction = |size: u64| {
        let member = |i: &usize| e.x[*i].abs().to_bits() == size && !stays(*i);
        let group: Vec<usize> = (0..e.x.len()).filter(member).collect();
        let least = |m: f64, &i: &usize| m.min(e.scales[i]);
        let step = group.iter().fold(f64::INFINITY, least);
        let mut direction = vec![0.0; e.x.len()];
        for &i in &group {
            direction[i] = step.copysign(e.x[i]);
        }
        (group.len() > 1).then_some(direction)
    };
    let all = sizes.into_iter().filter_map(direction);
    all.take(TIED_DIRECTIONS).collect()
}
