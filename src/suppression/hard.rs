//! Suppression that keeps a detection or drops it.
use super::{Pair, Rules, neighbours, order};
use crate::Scalar;
use crate::error::Error;

/// Returns the indices of the detections that no better one, kept itself, overlaps by more than the threshold, the best
/// first.
///
/// # Errors
///
/// [`Error::Invalid`] for a score or an overlap that is not finite, a threshold outside `[0, 1]`, a pair of
/// something that has no score; [`Error::Length`] for another number of classes than of scores.
///
/// ```
/// use geograd::kernels::{Cpu, Iou};
/// use geograd::suppression::{Rules, hard};
/// use geograd::Obb2;
///
/// let boxes = [0.0, 0.2, 3.0].map(|x| Obb2::new(x, 0.0, 2.0, 1.0, 0.0_f32));
/// let scores = [0.6, 0.9, 0.5];
/// let pairs = Cpu::new().overlaps(Iou, &boxes, 0.5)?;
/// assert_eq!(hard(&scores, &pairs, Rules::above(0.5))?, [1, 2]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn hard<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    rules: Rules<'_, S>,
) -> Result<Vec<usize>, Error> {
    let near = neighbours(scores, pairs, &rules)?;
    let mut gone = vec![false; scores.len()];
    let mut kept = Vec::new();
    for i in order(scores, rules.score)? {
        if gone[i] {
            continue;
        }
        if kept.len() == rules.most {
            break;
        }
        kept.push(i);
        for &(other, pair) in near.of(i) {
            gone[other] |= pairs[pair].overlap.above(rules.overlap);
        }
    }
    Ok(kept)
}

/// Returns the detections that [`hard`] keeps, computed round by round: in every round a detection stays if no better
/// one that stayed in the previous round overlaps it, until nothing changes. Also returns the number of rounds, which
/// is at most the length of the longest chain of overlaps. The best detection is first.
///
/// # Errors
///
/// As [`hard`].
pub fn cluster<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    rules: Rules<'_, S>,
) -> Result<(Vec<usize>, usize), Error> {
    let near = neighbours(scores, pairs, &rules)?;
    let order = order(scores, rules.score)?;
    let mut rank = vec![usize::MAX; scores.len()];
    for (place, &i) in order.iter().enumerate() {
        rank[i] = place;
    }
    let mut stays = vec![false; scores.len()];
    for &i in &order {
        stays[i] = true;
    }
    let mut rounds = 0;
    loop {
        rounds += 1;
        let is_free = |&i: &usize| {
            !near.of(i).iter().any(|&(other, pair)| {
                stays[other] && rank[other] < rank[i] && pairs[pair].overlap.above(rules.overlap)
            })
        };
        let now: Vec<bool> = order.iter().map(is_free).collect();
        let mut changed = false;
        for (&i, now) in order.iter().zip(now) {
            changed |= stays[i] != now;
            stays[i] = now;
        }
        if !changed {
            break;
        }
    }
    let kept = order.into_iter().filter(|&i| stays[i]);
    Ok((kept.take(rules.most).collect(), rounds))
}
