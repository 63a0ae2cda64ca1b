//! Measures of detections: which ones are right, precision and recall, average precision.
//!
//! [`kitti`] and [`nuscenes`] judge by the rules of these benchmarks. Every function takes one frame or all frames.
//!
//! ```
//! use geograd::metric::{Frame, Recalls, average_precision, curve, outcomes};
//! use geograd::suppression::Pair;
//!
//! // Two detections of one truth: the better one is right, the other one is not.
//! let pairs = [Pair { first: 0, second: 0, overlap: 0.8 }, Pair { first: 1, second: 0, overlap: 0.9 }];
//! let frame = Frame::new(&[0.9, 0.5], 1, &pairs);
//! let found = outcomes(&frame, 0.5)?;
//! let curve = curve(&[0.9, 0.5], &found, 1)?;
//! assert_eq!(curve[0].precision, 1.0);
//! assert_eq!(average_precision(&curve, Recalls::All), 1.0);
//! # Ok::<(), geograd::Error>(())
//! ```
use crate::error::{Argument, Error, Field, Flaw};
use crate::suppression::{Pair, invalid, order};

pub mod kitti;
pub mod nuscenes;

/// The detections and truths of one image or scan, of one class; or of all frames, one after another.
///
/// Pairs of indices in the lists of all frames join those of one frame only, as
/// [`Cpu::above_grouped`](crate::kernels::Cpu::above_grouped) gives them. So one call judges all frames, with the
/// outcomes of a call per frame.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The score of every detection.
    pub scores: &'a [f64],
    /// The number of truths.
    pub truths: usize,
    /// Overlaps of detections (the first of a pair) and truths (the second); others do not overlap.
    pub pairs: &'a [Pair<f64>],
    /// Truths that need not be found, such as those of a similar class, too far away or too hidden; empty if all count.
    pub ignored_truths: &'a [bool],
    /// Detections that cannot be wrong, such as those too small or in a region without labels; empty where
    /// all can.
    pub ignored_detections: &'a [bool],
}

impl<'a> Frame<'a> {
    /// Creates a frame without anything to ignore.
    #[must_use]
    pub fn new(scores: &'a [f64], truths: usize, pairs: &'a [Pair<f64>]) -> Self {
        Frame {
            scores,
            truths,
            pairs,
            ignored_truths: &[],
            ignored_detections: &[],
        }
    }
}

/// The outcome of a detection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It found this truth.
    Right(usize),
    /// It found nothing, or a truth that another one had found.
    Wrong,
    /// It counts neither as right nor as wrong.
    Ignored,
}

fn flags(name: &'static str, flags: &[bool], count: usize) -> Result<(), Error> {
    if flags.is_empty() || flags.len() == count {
        return Ok(());
    }
    Err(Error::Length {
        argument: Argument::Named(name),
        expected: count,
        found: flags.len(),
    })
}

/// The truths that a detection overlaps by at least the threshold, with the overlaps.
type OverlappedTruths = Vec<(f64, usize)>;

/// Returns the truths near every detection of a valid frame.
fn near(frame: &Frame<'_>, threshold: f64) -> Result<Vec<OverlappedTruths>, Error> {
    let count = frame.scores.len();
    flags("ignored_truths", frame.ignored_truths, frame.truths)?;
    flags("ignored_detections", frame.ignored_detections, count)?;
    let mut near = vec![Vec::new(); count];
    for (row, pair) in frame.pairs.iter().enumerate() {
        for (name, place, end) in [
            ("first", pair.first, count),
            ("second", pair.second, frame.truths),
        ] {
            if place >= end {
                let flaw = Flaw::Broken(Field::new(name), "is beyond its list");
                return Err(invalid("pairs", row, flaw));
            }
        }
        if !pair.overlap.is_finite() {
            let flaw = Flaw::NotFinite(Field::new("overlap"));
            return Err(invalid("pairs", row, flaw));
        }
        if pair.overlap >= threshold {
            near[pair.first].push((pair.overlap, pair.second));
        }
    }
    Ok(near)
}

fn is(flags: &[bool], i: usize) -> bool {
    flags.get(i).copied().unwrap_or(false)
}

/// Returns the truth that is overlapped most, of equal ones the first.
fn most(near: impl Iterator<Item = (f64, usize)>) -> Option<usize> {
    let better = |(most, at): (f64, usize), (overlap, truth): (f64, usize)| {
        if overlap > most || (overlap == most && truth < at) {
            (overlap, truth)
        } else {
            (most, at)
        }
    };
    near.reduce(better).map(|(_, truth)| truth)
}

/// Returns the outcomes of all detections of a frame, by COCO's rule.
///
/// By descending score every detection takes the truth that it overlaps most, of those that no other one
/// took and that it overlaps by at least the threshold. It takes an ignored truth only where no other one is
/// left, and is ignored then: it is neither right nor wrong. Several may share an ignored truth. A detection
/// that takes nothing is wrong, unless it is ignored itself; one that is ignored itself takes a truth only to
/// be ignored, and leaves it to others. PASCAL VOC differs ([`outcomes_voc`]), and so does KITTI's own benchmark, in
/// detail ([`kitti`]).
///
/// # Errors
///
/// [`Error::Invalid`] for scores and overlaps that are not finite and pairs beyond the lists,
/// [`Error::Length`] for flags of another number.
pub fn outcomes(frame: &Frame<'_>, threshold: f64) -> Result<Vec<Outcome>, Error> {
    judged(frame, threshold, |near, taken| {
        let is_ignored = |truth: usize| is(frame.ignored_truths, truth);
        let own = near.iter().copied();
        let free = own.filter(|&(_, truth)| !is_ignored(truth) && !taken[truth]);
        match most(free) {
            Some(truth) => {
                taken[truth] = true;
                Outcome::Right(truth)
            }
            None if near.iter().any(|&(_, truth)| is_ignored(truth)) => Outcome::Ignored,
            None => Outcome::Wrong,
        }
    })
}

/// Returns the outcomes of all detections of a frame, by PASCAL VOC's rule.
///
/// By descending score every detection is judged by the truth that it overlaps most, taken or not. It is right if it is
/// the first one there, wrong if another one took that truth or the overlap is below the threshold, and ignored if the
/// truth is (VOC's *difficult* ones). A second truth that it overlaps less does not count, where [`outcomes`] takes it.
/// Detections that are ignored themselves take nothing.
///
/// ```
/// use geograd::metric::{Frame, Outcome, outcomes, outcomes_voc};
/// use geograd::suppression::Pair;
/// let pair = |first, second, overlap| Pair { first, second, overlap };
/// // Both overlap truth 0 most, and truth 1, too.
/// let pairs = [pair(0, 0, 0.9), pair(1, 0, 0.8), pair(1, 1, 0.7)];
/// let frame = Frame::new(&[0.9, 0.5], 2, &pairs);
/// assert_eq!(outcomes(&frame, 0.5)?, [Outcome::Right(0), Outcome::Right(1)]);
/// assert_eq!(outcomes_voc(&frame, 0.5)?, [Outcome::Right(0), Outcome::Wrong]);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// As [`outcomes`].
pub fn outcomes_voc(frame: &Frame<'_>, threshold: f64) -> Result<Vec<Outcome>, Error> {
    judged(frame, threshold, |near, taken| {
        match most(near.iter().copied()) {
            Some(truth) if is(frame.ignored_truths, truth) => Outcome::Ignored,
            Some(truth) if !std::mem::replace(&mut taken[truth], true) => Outcome::Right(truth),
            _ => Outcome::Wrong,
        }
    })
}

/// Returns the outcomes of all detections by descending score; ignored ones take nothing. `rule` is given the truths
/// near a detection and those that are taken, and takes one.
fn judged(
    frame: &Frame<'_>,
    threshold: f64,
    rule: impl Fn(&[(f64, usize)], &mut [bool]) -> Outcome,
) -> Result<Vec<Outcome>, Error> {
    let near = near(frame, threshold)?;
    let mut taken = vec![false; frame.truths];
    let mut outcomes = vec![Outcome::Wrong; frame.scores.len()];
    for i in order(frame.scores, f64::MIN)? {
        outcomes[i] = match is(frame.ignored_detections, i) {
            true => Outcome::Ignored,
            false => rule(&near[i], &mut taken),
        };
    }
    Ok(outcomes)
}

/// Precision and recall of all detections of at least a score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The score.
    pub score: f64,
    /// The share of them that is right, in `[0, 1]`.
    pub precision: f64,
    /// The share of the truths that they found, in `[0, 1]`; zero without truths.
    pub recall: f64,
}

/// Returns precision and recall at every score, the highest score first, of the detections of all frames together.
/// Detections of equal scores are added at once; ignored ones do not count. `truths` is the number of truths that are
/// not ignored.
///
/// # Errors
///
/// [`Error::Length`] for another number of outcomes than of scores, [`Error::Invalid`] for a score that is
/// not finite.
pub fn curve(scores: &[f64], outcomes: &[Outcome], truths: usize) -> Result<Vec<Point>, Error> {
    if outcomes.len() != scores.len() {
        return Err(Error::Length {
            argument: Argument::Named("outcomes"),
            expected: scores.len(),
            found: outcomes.len(),
        });
    }
    let (mut right, mut all) = (0, 0);
    let mut curve: Vec<Point> = Vec::new();
    for i in order(scores, f64::MIN)? {
        match outcomes[i] {
            Outcome::Ignored => continue,
            Outcome::Right(_) => right += 1,
            Outcome::Wrong => {}
        }
        all += 1;
        let point = Point {
            score: scores[i],
            precision: f64::from(right) / f64::from(all),
            recall: f64::from(right) / (truths as f64).max(1.0),
        };
        match curve.last_mut().filter(|last| last.score == point.score) {
            Some(last) => *last = point,
            None => curve.push(point),
        }
    }
    Ok(curve)
}

/// At which recalls precision is averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Recalls {
    /// At 0, 1/10, …, 1: PASCAL VOC until 2009, KITTI until 2019 (Everingham et al., *The PASCAL visual object
    /// classes challenge*, 2010).
    Eleven,
    /// At 1/40, 2/40, …, 1: KITTI since (Simonelli et al., *Disentangling monocular 3D object detection*, ICCV
    /// 2019).
    Forty,
    /// At all of them: the area under the curve, PASCAL VOC since 2010.
    All,
}

/// Returns the average precision, in `[0, 1]`: the mean over recalls of the best precision at that recall or a higher
/// one; zero at recalls that are not reached.
#[must_use]
pub fn average_precision(curve: &[Point], recalls: Recalls) -> f64 {
    // The best precision from every point on.
    let mut best: Vec<f64> = curve.iter().map(|point| point.precision).collect();
    for i in (1..best.len()).rev() {
        best[i - 1] = best[i - 1].max(best[i]);
    }
    let at = |recall: f64| {
        // Recalls are ratios of small whole numbers: rounding moves them by less.
        let reached = curve.iter().position(|p| p.recall >= recall - 1e-12);
        reached.map_or(0.0, |i| best[i])
    };
    match recalls {
        Recalls::Eleven => (0..=10).map(|k| at(f64::from(k) / 10.0)).sum::<f64>() / 11.0,
        Recalls::Forty => (1..=40).map(|k| at(f64::from(k) / 40.0)).sum::<f64>() / 40.0,
        Recalls::All => {
            let mut before = 0.0;
            let parts = curve.iter().zip(&best).map(|(point, best)| {
                let width = point.recall - before;
                before = point.recall;
                width * best
            });
            parts.sum()
        }
    }
}
