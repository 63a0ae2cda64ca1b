//! Suppression that lowers scores step by step, with derivatives.
use super::{Decay, Kept, Pair, Rules, neighbours, order};
use crate::Scalar;
use crate::error::Error;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The record of a soft suppression: which pairs lowered which scores, and what was kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decayed {
    /// The kept detections, in the order in which they were taken.
    pub kept: Vec<usize>,
    /// For every kept detection the pairs that lowered its score, in the order in which they did.
    pub by: Vec<Vec<usize>>,
}

/// Takes detection after detection, the one of the highest score first, and lowers the scores of those that
/// overlap it, until none is left or the best score is below the rules'. Gives the kept ones with their
/// scores, the best first.
///
/// Pairs count by [`Decay`]: with the linear one those above the threshold. Scores below zero stay as they are, with
/// derivative one by themselves.
///
/// # Errors
///
/// As [`hard`](super::hard()), and [`Error::Invalid`] for a `sigma` that is not above zero.
///
/// ```
/// use geograd::suppression::{Decay, Pair, Rules, soft};
/// let pairs = [Pair { first: 0, second: 1, overlap: 0.75 }];
/// let kept = soft(&[0.8, 0.6], &pairs, Decay::Linear, Rules::above(0.5))?;
/// assert_eq!((kept[1].index, kept[1].score), (1, 0.15));
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn soft<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    decay: Decay<S>,
    rules: Rules<'_, S>,
) -> Result<Vec<Kept<S>>, Error> {
    Ok(soft_search(scores, pairs, decay, rules)?.0)
}

/// Returns the result of [`soft`] and the record of its decisions, for [`soft_replay`] and
/// [`soft_vjp`](crate::ad::adjoint::suppression::soft_vjp).
///
/// # Errors
///
/// As [`soft`].
pub fn soft_search<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    decay: Decay<S>,
    rules: Rules<'_, S>,
) -> Result<(Vec<Kept<S>>, Decayed), Error> {
    decay.check()?;
    let near = neighbours(scores, pairs, &rules)?;
    let order = order(scores, rules.score)?;
    let mut left = vec![false; scores.len()];
    for &i in &order {
        left[i] = true;
    }
    let mut now = scores.to_vec();
    let mut by = vec![Vec::new(); scores.len()];
    // A score that falls is put in again; its old entries are passed over.
    let mut heap: BinaryHeap<Entry<S>> = order.into_iter().map(|i| Entry(i, now[i])).collect();
    let (mut kept, mut record) = (Vec::new(), Decayed::default());
    while let Some(Entry(index, score)) = heap.pop() {
        if !left[index] || !score.equals(now[index]) {
            continue;
        }
        if now[index].below(rules.score) || kept.len() == rules.most {
            break;
        }
        left[index] = false;
        kept.push(Kept {
            index,
            score: now[index],
        });
        record.kept.push(index);
        record.by.push(std::mem::take(&mut by[index]));
        for &(other, pair) in near.of(index) {
            let overlap = pairs[pair].overlap;
            let counts = match decay {
                Decay::Linear => overlap.above(rules.overlap),
                Decay::Gaussian { .. } => true,
            };
            // A factor would raise a score below zero.
            let falls = !now[other].below(S::zero());
            if left[other] && counts && falls {
                now[other] *= decay.factor(overlap, rules.overlap).0;
                by[other].push(pair);
                heap.push(Entry(other, now[other]));
            }
        }
    }
    Ok((kept, record))
}

/// A detection with the score that it had when it was put into the heap.
struct Entry<S>(usize, S);

impl<S: Scalar<Mask = bool>> Ord for Entry<S> {
    fn cmp(&self, other: &Self) -> Ordering {
        // The best is the greatest.
        if self.1.above(other.1) {
            Ordering::Greater
        } else if other.1.above(self.1) {
            Ordering::Less
        } else {
            other.0.cmp(&self.0)
        }
    }
}
impl<S: Scalar<Mask = bool>> PartialOrd for Entry<S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<S: Scalar<Mask = bool>> PartialEq for Entry<S> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl<S: Scalar<Mask = bool>> Eq for Entry<S> {}

/// Returns the scores of the kept detections, by a record: straight line.
#[must_use]
pub fn soft_replay<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    decay: Decay<S>,
    threshold: S,
    record: &Decayed,
) -> Vec<S> {
    let kept = record.kept.iter().zip(&record.by);
    kept.map(|(&i, by)| {
        by.iter().fold(scores[i], |score, &pair| {
            score * decay.factor(pairs[pair].overlap, threshold).0
        })
    })
    .collect()
}
