//! Suppression that lowers all scores at once.
use super::{Decay, Kept, Pair, Rules, better, neighbours, order};
use crate::Scalar;
use crate::error::Error;

/// Lowers every score by the least of `f(overlap) / f(largest overlap of the other one with a better one)`
/// over all better detections that overlap it, with the factor f of [`Decay`]. Gives those whose score is
/// not below the rules', the best first.
///
/// The rules' threshold does not count: all overlaps do. Scores below zero stay as they are.
///
/// # Errors
///
/// As [`soft`](super::soft()).
///
/// ```
/// use geograd::suppression::{Decay, Pair, Rules, matrix};
/// let pairs = [Pair { first: 0, second: 1, overlap: 0.75 }];
/// let kept = matrix(&[0.8, 0.6], &pairs, Decay::Linear, Rules::above(0.0))?;
/// assert_eq!((kept[1].index, kept[1].score), (1, 0.15));
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn matrix<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    decay: Decay<S>,
    rules: Rules<'_, S>,
) -> Result<Vec<Kept<S>>, Error> {
    decay.check()?;
    let near = neighbours(scores, pairs, &rules)?;
    let order = order(scores, rules.score)?;
    let mut counts = vec![false; scores.len()];
    for &i in &order {
        counts[i] = true;
    }
    let is_better = |i: usize, j: usize| counts[i] && better(scores, i, j).is_lt();
    // The largest overlap of every detection with a better one.
    let mut most = vec![S::zero(); scores.len()];
    for &i in &order {
        for &(other, pair) in near.of(i) {
            let overlap = pairs[pair].overlap;
            if is_better(other, i) && overlap.above(most[i]) {
                most[i] = overlap;
            }
        }
    }
    let factor = |overlap: S| decay.factor(overlap, S::zero()).0;
    let mut now = scores.to_vec();
    // A factor would raise a score below zero.
    for &i in order.iter().filter(|&&i| !scores[i].below(S::zero())) {
        let mut least = S::one();
        for &(other, pair) in near.of(i) {
            let hidden = factor(most[other]);
            // One that is hidden wholly hides nothing.
            if is_better(other, i) && hidden.above(S::zero()) {
                least = least.least(factor(pairs[pair].overlap).over(hidden));
            }
        }
        now[i] *= least;
    }
    let mut kept: Vec<usize> = order
        .into_iter()
        .filter(|&i| !now[i].below(rules.score))
        .collect();
    kept.sort_unstable_by(|&i, &j| better(&now, i, j));
    kept.truncate(rules.most);
    let score = |index: usize| Kept {
        index,
        score: now[index],
    };
    Ok(kept.into_iter().map(score).collect())
}
