//! The matching of truths to detections, and precision at the scores where it is read.
use super::frames::{Angles, Counts, Frame};
use crate::Scalar;
use crate::error::{Argument, Error, Field, Flaw};
use crate::metric::{Outcome, Point, Recalls};
use crate::suppression::invalid;

/// Average precision by the rules, and the curve it is read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Precision and recall at the scores where it was read, the highest one first.
    pub curve: Vec<Point>,
    /// Similarity of orientation at these scores: the mean over right detections of `(1 + cos(a − b)) / 2` for the
    /// angles of truth and detection, times precision. Empty without angles.
    pub similarity: Vec<f64>,
    /// The number of truths that have to be found.
    pub truths: usize,
}

impl Judged {
    /// Returns the average precision, in `[0, 1]`. At eleven recalls it takes every fourth of the forty-one recalls
    /// that have scores, at forty all except the first. [`Recalls::All`] counts as forty, which is all there are.
    #[must_use]
    pub fn average_precision(&self, recalls: Recalls) -> f64 {
        average(self.curve.iter().map(|point| point.precision), recalls)
    }
    /// Returns the average orientation similarity (AOS), in `[0, 1]`, at the recalls of
    /// [`average_precision`](Self::average_precision), which bounds it from above. Zero if no angles were given.
    #[must_use]
    pub fn average_orientation_similarity(&self, recalls: Recalls) -> f64 {
        average(self.similarity.iter().copied(), recalls)
    }
}

/// Returns the mean over recalls of the best value at that recall or a higher one.
fn average(values: impl Iterator<Item = f64>, recalls: Recalls) -> f64 {
    let mut best = [0.0_f64; 41];
    for (slot, value) in best.iter_mut().zip(values) {
        *slot = value;
    }
    for i in (1..best.len()).rev() {
        best[i - 1] = best[i - 1].max(best[i]);
    }
    match recalls {
        Recalls::Eleven => best.iter().step_by(4).sum::<f64>() / 11.0,
        Recalls::Forty | Recalls::All => best[1..].iter().sum::<f64>() / 40.0,
    }
}

/// The outcomes of the detections of a frame of at least a score, and the number of truths missed.
struct FrameMatches {
    outcomes: Vec<Outcome>,
    missed: usize,
}

/// Overlaps of every truth above the threshold, with the detections in their order.
struct TruthOverlaps {
    all: Vec<(usize, f64)>,
    /// Truth t has the entries `starts[t]..starts[t + 1]`.
    starts: Vec<usize>,
}

fn near(frame: &Frame<'_>, threshold: f64) -> Result<TruthOverlaps, Error> {
    let counts = [
        ("detections", frame.detections.len(), frame.scores.len()),
        ("unlabelled", frame.unlabelled.len(), frame.scores.len()),
    ];
    for (name, found, expected) in counts {
        if found != expected && !(name == "unlabelled" && found == 0) {
            let argument = Argument::Named(name);
            return Err(Error::Length {
                argument,
                expected,
                found,
            });
        }
    }
    for (name, numbers) in [("scores", frame.scores), ("unlabelled", frame.unlabelled)] {
        if let Some(row) = numbers.iter().position(|x| !x.is_finite()) {
            return Err(invalid(name, row, Flaw::NotFinite(Field::VALUE)));
        }
    }
    let mut starts = vec![0; frame.truths.len() + 1];
    for (row, pair) in frame.pairs.iter().enumerate() {
        let ends = [
            ("first", pair.first, frame.scores.len()),
            ("second", pair.second, frame.truths.len()),
        ];
        for (name, place, end) in ends {
            if place >= end {
                let flaw = Flaw::Broken(Field::new(name), "is beyond its list");
                return Err(invalid("pairs", row, flaw));
            }
        }
        if !pair.overlap.is_finite() {
            let flaw = Flaw::NotFinite(Field::new("overlap"));
            return Err(invalid("pairs", row, flaw));
        }
        starts[pair.second + 1] += usize::from(pair.overlap > threshold);
    }
    for truth in 0..frame.truths.len() {
        starts[truth + 1] += starts[truth];
    }
    let (mut all, mut next) = (vec![(0, 0.0); starts[frame.truths.len()]], starts.clone());
    for pair in frame.pairs.iter().filter(|pair| pair.overlap > threshold) {
        all[next[pair.second]] = (pair.first, pair.overlap);
        next[pair.second] += 1;
    }
    for own in starts.windows(2) {
        all[own[0]..own[1]].sort_by_key(|&(detection, _)| detection);
    }
    Ok(TruthOverlaps { all, starts })
}

/// Matches the truths, one after the other, to detections. With `least` a truth takes the detection of the largest
/// overlap of at least this score, and ignored ones only if no other is left. Without it a truth takes the detection of
/// the highest score.
fn matched(frame: &Frame<'_>, near: &TruthOverlaps, least: Option<f64>) -> FrameMatches {
    let mut outcomes = vec![Outcome::Wrong; frame.scores.len()];
    let mut is_taken = vec![false; frame.scores.len()];
    let mut missed = 0;
    for (truth, own) in near.starts.windows(2).enumerate() {
        if frame.truths[truth] == Counts::Not {
            continue;
        }
        let mut best: Option<(usize, f64)> = None;
        for &(detection, overlap) in &near.all[own[0]..own[1]] {
            let counts = frame.detections[detection];
            let score = frame.scores[detection];
            if counts == Counts::Not
                || is_taken[detection]
                || least.is_some_and(|least| score < least)
            {
                continue;
            }
            let is_ignored = counts == Counts::Ignored;
            let is_better = match (least, best) {
                (None, Some((other, _))) => score > frame.scores[other],
                (Some(_), Some((other, most))) => {
                    let other_is_ignored = frame.detections[other] == Counts::Ignored;
                    !is_ignored && (other_is_ignored || overlap > most)
                }
                (_, None) => true,
            };
            if is_better {
                best = Some((detection, overlap));
            }
        }
        let must = frame.truths[truth] == Counts::Fully;
        match best {
            None => missed += usize::from(must),
            Some((detection, _)) => {
                is_taken[detection] = true;
                let is_right = must && frame.detections[detection] == Counts::Fully;
                outcomes[detection] = match is_right {
                    true => Outcome::Right(truth),
                    false => Outcome::Ignored,
                };
            }
        }
    }
    FrameMatches { outcomes, missed }
}

/// Returns the scores of right detections, the highest first, at which recall passes the next fortieth.
fn thresholds(mut right: Vec<f64>, truths: usize) -> Vec<f64> {
    right.sort_unstable_by(|a, b| b.total_cmp(a));
    let (mut recall, mut out) = (0.0, Vec::new());
    for (i, &score) in right.iter().enumerate() {
        let is_last = i + 1 == right.len();
        let left = (i + 1) as f64 / truths as f64;
        let next = if is_last {
            left
        } else {
            (i + 2) as f64 / truths as f64
        };
        if next - recall < recall - left && !is_last {
            continue;
        }
        out.push(score);
        recall += 1.0 / 40.0;
    }
    out
}

/// Frames that are judged: the data that is read at every score separately.
pub(crate) struct Judging<'a> {
    frames: &'a [Frame<'a>],
    /// Empty where none were given.
    angles: &'a [Angles<'a>],
    threshold: f64,
    near: Vec<TruthOverlaps>,
    /// The number of truths that have to be found.
    truths: usize,
    /// The scores at which precision is read, the highest one first.
    pub(crate) scores: Vec<f64>,
}

impl<'a> Judging<'a> {
    pub(crate) fn new(
        frames: &'a [Frame<'a>],
        angles: Option<&'a [Angles<'a>]>,
        threshold: f64,
    ) -> Result<Self, Error> {
        if let Some(angles) = angles {
            check_angles(frames, angles)?;
        }
        let near = frames.iter().map(|frame| near(frame, threshold));
        let near = near.collect::<Result<Vec<_>, _>>()?;
        let must = |frame: &Frame<'_>| frame.truths.iter().filter(|c| **c == Counts::Fully).count();
        let truths: usize = frames.iter().map(must).sum();
        let mut right = Vec::new();
        for (frame, near) in frames.iter().zip(&near) {
            let found = matched(frame, near, None).outcomes;
            let scores = found.iter().zip(frame.scores);
            let is_right = |pair: &(&Outcome, &f64)| matches!(pair.0, Outcome::Right(_));
            right.extend(scores.filter(is_right).map(|(_, score)| *score));
        }
        Ok(Judging {
            frames,
            angles: angles.unwrap_or_default(),
            threshold,
            near,
            truths,
            scores: thresholds(right, truths.max(1)),
        })
    }

    /// Returns precision, recall and orientation similarity of all detections of at least a score.
    pub(crate) fn at(&self, score: f64) -> (Point, f64) {
        let (mut right, mut wrong, mut missed) = (0_usize, 0_usize, 0_usize);
        let mut similar = 0.0;
        for (f, (frame, near)) in self.frames.iter().zip(&self.near).enumerate() {
            let found = matched(frame, near, Some(score));
            missed += found.missed;
            for (i, outcome) in found.outcomes.iter().enumerate() {
                let share = frame.unlabelled.get(i);
                let is_unlabelled = || share.is_some_and(|x| *x > self.threshold);
                match outcome {
                    Outcome::Right(truth) => {
                        right += 1;
                        if let Some(angles) = self.angles.get(f) {
                            let turn = angles.truths[*truth] - angles.detections[i];
                            similar += 0.5 * (1.0 + Scalar::cos(turn));
                        }
                    }
                    Outcome::Wrong if frame.detections[i] == Counts::Fully => {
                        wrong += usize::from(frame.scores[i] >= score && !is_unlabelled());
                    }
                    _ => {}
                }
            }
        }
        let point = Point {
            score,
            precision: right as f64 / (right + wrong).max(1) as f64,
            recall: right as f64 / (right + missed).max(1) as f64,
        };
        (point, similar / (right + wrong).max(1) as f64)
    }

    /// Returns all scores, one after the other.
    pub(super) fn judged(&self) -> Judged {
        self.collect(self.scores.iter().map(|&score| self.at(score)))
    }

    /// Returns the result of what was read at every score.
    pub(crate) fn collect(&self, read: impl Iterator<Item = (Point, f64)>) -> Judged {
        let (curve, mut similarity): (Vec<Point>, Vec<f64>) = read.unzip();
        if self.angles.is_empty() {
            similarity.clear();
        }
        Judged {
            curve,
            similarity,
            truths: self.truths,
        }
    }
}

/// Returns `Ok` for finite angles of every truth and detection.
fn check_angles(frames: &[Frame<'_>], angles: &[Angles<'_>]) -> Result<(), Error> {
    let length = |name, expected, found| match expected == found {
        true => Ok(()),
        false => Err(Error::Length {
            argument: Argument::Named(name),
            expected,
            found,
        }),
    };
    length("angles", frames.len(), angles.len())?;
    for (frame, angles) in frames.iter().zip(angles) {
        let lists = [
            ("angles of truths", angles.truths, frame.truths.len()),
            (
                "angles of detections",
                angles.detections,
                frame.scores.len(),
            ),
        ];
        for (name, own, expected) in lists {
            length(name, expected, own.len())?;
            if let Some(item) = own.iter().position(|x| !x.is_finite()) {
                return Err(invalid(name, item, Flaw::NotFinite(Field::VALUE)));
            }
        }
    }
    Ok(())
}
