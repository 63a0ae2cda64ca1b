//! Adjoint of soft suppression.
use crate::Scalar;
use crate::suppression::{Decay, Decayed, Pair};

/// Returns the derivatives of `Σ kept_bar · score` of the kept detections by all scores and by the overlaps of all pairs.
///
/// Which detections are kept, and which pairs lower which scores, stays as recorded.
#[must_use]
pub fn soft_vjp<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    decay: Decay<S>,
    threshold: S,
    record: &Decayed,
    kept_bar: &[S],
) -> (Vec<S>, Vec<S>) {
    let mut scores_bar = vec![S::zero(); scores.len()];
    let mut pairs_bar = vec![S::zero(); pairs.len()];
    for ((&i, by), &bar) in record.kept.iter().zip(&record.by).zip(kept_bar) {
        let factors: Vec<(S, S)> = by
            .iter()
            .map(|&pair| decay.factor(pairs[pair].overlap, threshold))
            .collect();
        // Products of all that come after, so that none is divided by.
        let mut after = vec![S::one(); by.len() + 1];
        for k in (0..by.len()).rev() {
            after[k] = after[k + 1] * factors[k].0;
        }
        scores_bar[i] += bar * after[0];
        let mut before = bar * scores[i];
        for (k, &pair) in by.iter().enumerate() {
            pairs_bar[pair] += before * after[k + 1] * factors[k].1;
            before *= factors[k].0;
        }
    }
    (scores_bar, pairs_bar)
}
