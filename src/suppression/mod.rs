//! Suppression of detections that others overlap, and the order in which that happens.
//!
//! All start from scores and a list of [`Pair`]s of detections that overlap;
//! [`Cpu::overlaps`](crate::kernels::Cpu::overlaps) makes that list by any operation, so that pairs far from
//! each other cost nothing. Pairs that are not in the list do not overlap.
//!
//! | function | what happens to a detection that a better one overlaps | source |
//! | --- | --- | --- |
//! | [`hard`] | it goes | Neubeck and Van Gool, *Efficient non-maximum suppression*, ICPR 2006 |
//! | [`cluster`] | the same, round by round instead of one by one | Zheng et al., *Enhancing geometric factors in model learning and inference*, 2021 |
//! | [`soft`] | its score falls, step by step | Bodla et al., *Soft-NMS*, ICCV 2017 |
//! | [`matrix`] | its score falls, at once for all | Wang et al., *SOLOv2*, NeurIPS 2020 |
//!
//! Better is a higher score; of equal ones the detection that comes first. So results do not depend on the
//! order of the pairs, nor on the machine.
//!
//! A score never rises. [`Decay`] lowers scores towards zero, so that scores below zero, such as logits, stay as they
//! are, and those above zero never fall below them: every list is in the order of its scores, the best first.
use crate::error::{Argument, Error, Field, Flaw};
use crate::scalar::Scalar;
use std::cmp::Ordering;

mod hard;
mod matrix_nms;
mod soft;

pub use hard::{cluster, hard};
pub use matrix_nms::matrix;
pub use soft::{Decayed, soft, soft_replay, soft_search};

/// Two things of a list, or one of each of two lists, and how much they overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<S> {
    /// The first one's index in its list.
    pub first: usize,
    /// The second one's index in its list.
    pub second: usize,
    /// Their overlap.
    pub overlap: S,
}

/// The rules that select the detections that count, and the number that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules<'a, S> {
    /// The class of every detection; `None` where all are of one. Detections of two classes do not suppress
    /// each other.
    pub classes: Option<&'a [u32]>,
    /// Overlaps above this one suppress: in `[0, 1]`.
    pub overlap: S,
    /// Scores below this one do not count, before suppression and after.
    pub score: S,
    /// The most detections that are kept.
    pub most: usize,
}

impl<S: Scalar> Rules<'_, S> {
    /// Creates the options that suppress overlaps above a threshold, of one class, of all scores, of any number.
    pub fn above(overlap: S) -> Self {
        Rules {
            classes: None,
            overlap,
            score: S::lowest(),
            most: usize::MAX,
        }
    }
}

/// The decay of a score by an overlap: a factor in `[0, 1]`. Scores below zero, which a factor would raise, stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decay<S> {
    /// By the factor `1 − overlap`, for overlaps above the threshold; by the factor 0 for overlaps above one.
    Linear,
    /// By the factor `exp(−overlap² / sigma)`, for all overlaps.
    Gaussian {
        /// The square of the overlap at which a score falls by the factor e; above zero.
        sigma: S,
    },
}

impl<S: Scalar<Mask = bool>> Decay<S> {
    /// Returns the factor of an overlap, and its derivative by the overlap.
    pub(crate) fn factor(self, overlap: S, threshold: S) -> (S, S) {
        match self {
            Decay::Linear if overlap.above(S::one()) => (S::zero(), S::zero()),
            Decay::Linear if overlap.above(threshold) => (S::one() - overlap, -S::one()),
            Decay::Linear => (S::one(), S::zero()),
            Decay::Gaussian { sigma } => {
                let factor = (-(overlap * overlap).over(sigma)).exp();
                (factor, -(factor * (overlap + overlap)).over(sigma))
            }
        }
    }
    fn check(self) -> Result<(), Error> {
        match self {
            Decay::Gaussian { sigma } if !sigma.above(S::zero()) | !is_finite(sigma) => {
                Err(invalid("sigma", 0, Flaw::NotPositive(Field::VALUE)))
            }
            _ => Ok(()),
        }
    }
}

/// A detection that is kept, and its score after suppression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept<S> {
    /// Its index in the list of scores.
    pub index: usize,
    /// Its score.
    pub score: S,
}

fn is_finite<S: Scalar<Mask = bool>>(x: S) -> bool {
    x.magnitude().at_most(S::largest())
}

pub(crate) fn invalid(name: &'static str, row: usize, flaw: Flaw) -> Error {
    let argument = Argument::Named(name);
    Error::Invalid {
        argument,
        item: row,
        flaw,
    }
}

/// Returns `Ok` when all scores are finite.
pub(crate) fn check_scores<S: Scalar<Mask = bool>>(scores: &[S]) -> Result<(), Error> {
    match scores.iter().position(|&x| !is_finite(x)) {
        Some(row) => Err(invalid("scores", row, Flaw::NotFinite(Field::VALUE))),
        None => Ok(()),
    }
}

/// Checks the offsets of groups of a list of such a length.
pub(crate) fn check_groups(
    argument: Argument,
    count: usize,
    offsets: &[usize],
) -> Result<(), Error> {
    let mut before = 0;
    for (item, &offset) in offsets.iter().enumerate() {
        if (item == 0 && offset != 0) || offset < before || offset > count {
            return Err(Error::GroupsOf { argument, item });
        }
        before = offset;
    }
    match offsets.last() {
        Some(&last) if last == count => Ok(()),
        _ => Err(Error::GroupsOf {
            argument,
            item: offsets.len().saturating_sub(1),
        }),
    }
}

/// Returns the higher score first, of equal ones the smaller index.
pub(crate) fn better<S: Scalar<Mask = bool>>(scores: &[S], i: usize, j: usize) -> Ordering {
    if scores[i].above(scores[j]) {
        Ordering::Less
    } else if scores[j].above(scores[i]) {
        Ordering::Greater
    } else {
        i.cmp(&j)
    }
}

/// Returns the indices of all scores that are at least so large, the best first; of equal ones the one that comes
/// first.
///
/// # Errors
///
/// [`Error::Invalid`] for a score that is not finite.
///
/// ```
/// use geograd::suppression::order;
/// assert_eq!(order(&[0.2, 0.9, 0.1, 0.9], 0.2)?, [1, 3, 0]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn order<S: Scalar<Mask = bool>>(scores: &[S], least: S) -> Result<Vec<usize>, Error> {
    check_scores(scores)?;
    let mut order: Vec<usize> = (0..scores.len())
        .filter(|&i| !scores[i].below(least))
        .collect();
    order.sort_unstable_by(|&i, &j| better(scores, i, j));
    Ok(order)
}

/// The overlapping pairs of each detection, in both orders, within a class.
pub(crate) struct Neighbours {
    start: Vec<usize>,
    /// The other one, and the pair.
    all: Vec<(usize, usize)>,
}

impl Neighbours {
    fn of(&self, i: usize) -> &[(usize, usize)] {
        &self.all[self.start[i]..self.start[i + 1]]
    }
}

/// Checks rules for a number of detections.
pub(crate) fn check_rules<S: Scalar<Mask = bool>>(
    count: usize,
    rules: &Rules<'_, S>,
) -> Result<(), Error> {
    if !(rules.overlap.at_least(S::zero()) && rules.overlap.at_most(S::one())) {
        let flaw = Flaw::Broken(Field::VALUE, "is not in [0, 1]");
        return Err(Error::Invalid {
            argument: Argument::Threshold,
            item: 0,
            flaw,
        });
    }
    if let Some(classes) = rules.classes.filter(|classes| classes.len() != count) {
        return Err(Error::Length {
            argument: Argument::Named("classes"),
            expected: count,
            found: classes.len(),
        });
    }
    Ok(())
}

/// Checks what goes in, and sorts the pairs by detection.
fn neighbours<S: Scalar<Mask = bool>>(
    scores: &[S],
    pairs: &[Pair<S>],
    rules: &Rules<'_, S>,
) -> Result<Neighbours, Error> {
    let count = scores.len();
    check_rules(count, rules)?;
    let class = |i: usize| rules.classes.map_or(0, |classes| classes[i]);
    let mut start = vec![0; count + 1];
    let mut near = Vec::new();
    for (row, pair) in pairs.iter().enumerate() {
        let (i, j) = (pair.first, pair.second);
        for (name, place) in [("first", i), ("second", j)] {
            if place >= count {
                let flaw = Flaw::Broken(Field::new(name), "is beyond the scores");
                return Err(invalid("pairs", row, flaw));
            }
        }
        if !is_finite(pair.overlap) {
            let flaw = Flaw::NotFinite(Field::new("overlap"));
            return Err(invalid("pairs", row, flaw));
        }
        if i != j && class(i) == class(j) {
            start[i + 1] += 1;
            start[j + 1] += 1;
            near.push(row);
        }
    }
    for i in 0..count {
        start[i + 1] += start[i];
    }
    let mut next = start.clone();
    let mut all = vec![(0, 0); start[count]];
    for row in near {
        let (i, j) = (pairs[row].first, pairs[row].second);
        for (own, other) in [(i, j), (j, i)] {
            all[next[own]] = (other, row);
            next[own] += 1;
        }
    }
    Ok(Neighbours { start, all })
}
