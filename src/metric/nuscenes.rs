//! The rules of nuScenes' detection benchmark, as its development kit has them: matching by distances of centres,
//! average precision, the errors of true positives, the detection score.
//!
//! Caesar et al., *nuScenes: a multimodal dataset for autonomous driving*, CVPR 2020. By descending score every
//! detection takes the nearest truth of its frame that no other one took, if its centre is closer than the threshold,
//! seen from above. The curve is read at the recalls 0, 0.01, …, 1, linearly between detections. Precision counts above
//! a tenth, at recalls above a tenth, as the kit does it.
//!
//! The caller leaves out what the benchmark leaves out: truths without points, objects beyond the range of their class.
use crate::Scalar;
use crate::error::{Argument, Error, Field, Flaw};
use crate::suppression::{check_groups, invalid};
use std::ops::Range;

/// Distances at which the benchmark matches, in metres. It takes the mean of the average precisions.
pub const THRESHOLDS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
/// The distance at which it takes the errors of true positives, in metres.
pub const THRESHOLD_OF_ERRORS: f64 = 2.0;

/// Recalls at which the curve is read.
const RECALLS: usize = 101;
/// The first of those that count: recalls above a tenth.
const FIRST: usize = 11;
/// The least precision that counts.
const LEAST: f64 = 0.1;

/// A box in space, detected or true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// Its centre, seen from above.
    pub center: [f64; 2],
    /// Its width, length and height.
    pub size: [f64; 3],
    /// Its heading in radians.
    pub yaw: f64,
    /// Its velocity, seen from above; `None` where it is unknown.
    pub velocity: Option<[f64; 2]>,
    /// Its attribute, such as parked or moving; `None` where it has none.
    pub attribute: Option<u32>,
}

impl Object {
    /// Returns an object without velocity or attribute.
    #[must_use]
    pub const fn new(center: [f64; 2], size: [f64; 3], yaw: f64) -> Self {
        Object {
            center,
            size,
            yaw,
            velocity: None,
            attribute: None,
        }
    }
    fn distance(&self, other: &Object) -> f64 {
        let [x, y] = [0, 1].map(|k| self.center[k] - other.center[k]);
        Scalar::hypot(x, y)
    }
    /// Returns the flaw of numbers that have no meaning.
    fn flaw(&self) -> Option<Flaw> {
        let is_finite = |all: &[f64]| all.iter().all(|x| x.is_finite());
        let velocity = self.velocity.unwrap_or_default();
        let parts = [
            ("center", &self.center[..]),
            ("size", &self.size[..]),
            ("yaw", &[self.yaw][..]),
            ("velocity", &velocity[..]),
        ];
        let wrong = parts.into_iter().find(|part| !is_finite(part.1));
        let infinite = wrong.map(|(name, _)| Flaw::NotFinite(Field::new(name)));
        let flat = || self.size.iter().any(|&x| x <= 0.0);
        infinite.or_else(|| flat().then(|| Flaw::NotPositive(Field::new("size"))))
    }
}

/// An error of true positives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TruePositive {
    /// Distance of centres, seen from above: ATE.
    Translation,
    /// One minus the IoU of the boxes put on one another: ASE.
    Scale,
    /// The angle between headings in radians: AOE.
    Orientation,
    /// The length of the difference of velocities, seen from above: AVE.
    Velocity,
    /// The share of wrong attributes: AAE.
    Attribute,
}

impl TruePositive {
    /// All of them, in the order of the benchmark.
    pub const ALL: [TruePositive; 5] = [
        TruePositive::Translation,
        TruePositive::Scale,
        TruePositive::Orientation,
        TruePositive::Velocity,
        TruePositive::Attribute,
    ];
}

/// The detections and truths of all frames, of one class.
#[derive(Clone, Copy, Debug)]
pub struct Frames<'a> {
    /// The detections, frame by frame.
    pub detections: &'a [Object],
    /// The score of every detection.
    pub scores: &'a [f64],
    /// Frame f has the detections `detection_offsets[f]..detection_offsets[f + 1]`.
    pub detection_offsets: &'a [usize],
    /// The truths, frame by frame.
    pub truths: &'a [Object],
    /// The offsets of the truths of each frame.
    pub truth_offsets: &'a [usize],
    /// The rotation that maps an object to itself, in radians: 2π, and π for barriers.
    pub period: f64,
}

/// The curve of a class at one threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Precision at the recalls 0, 0.01, …, 1; zero at recalls that are not reached.
    pub precision: Vec<f64>,
    /// The score at these recalls; zero where they are not reached.
    pub score: Vec<f64>,
    /// Errors of true positives up to these recalls, in the order of [`TruePositive::ALL`].
    pub errors: [Vec<f64>; 5],
    /// The number of truths.
    pub truths: usize,
}

impl Judged {
    /// Creates the result for no detections at all.
    fn nothing(truths: usize) -> Self {
        Judged {
            precision: vec![0.0; RECALLS],
            score: vec![0.0; RECALLS],
            errors: std::array::from_fn(|_| vec![1.0; RECALLS]),
            truths,
        }
    }
    /// Returns the average precision, in `[0, 1]`.
    #[must_use]
    pub fn average_precision(&self) -> f64 {
        let counted = &self.precision[FIRST..];
        let sum: f64 = counted.iter().map(|p| (p - LEAST).max(0.0)).sum();
        // A mean of ones may round to more than one.
        (sum / counted.len() as f64 / (1.0 - LEAST)).min(1.0)
    }
    /// Returns the mean of an error over recalls above a tenth that are reached; 1 where none is.
    #[must_use]
    pub fn error(&self, which: TruePositive) -> f64 {
        let last = self.score.iter().rposition(|&score| score != 0.0);
        let errors = &self.errors[which as usize];
        match last {
            Some(last) if last >= FIRST => {
                errors[FIRST..=last].iter().sum::<f64>() / (last + 1 - FIRST) as f64
            }
            _ => 1.0,
        }
    }
}

/// Returns the nuScenes detection score, in `[0, 1]`, of the mean average precision of all classes and the mean errors
/// of true positives.
///
/// ```
/// use geograd::metric::nuscenes::detection_score;
/// assert_eq!(detection_score(1.0, [0.0; 5]), 1.0);
/// assert_eq!(detection_score(0.4, [0.5, 0.5, 2.0, 2.0, 0.0]), 0.4);
/// ```
#[must_use]
pub fn detection_score(mean_average_precision: f64, mean_errors: [f64; 5]) -> f64 {
    let scores: f64 = mean_errors.iter().map(|error| 1.0 - error.min(1.0)).sum();
    (5.0 * mean_average_precision + scores) / 10.0
}

/// Returns the errors of a detection relative to the truth that it found; NaN where one is unknown.
fn errors(detection: &Object, truth: &Object, period: f64) -> [f64; 5] {
    let volume = |size: &[f64; 3]| size.iter().product::<f64>();
    let shared: f64 = (0..3)
        .map(|k| detection.size[k].min(truth.size[k]))
        .product();
    let union = volume(&detection.size) + volume(&truth.size) - shared;
    let half = 0.5 * period;
    let mut turn = (truth.yaw - detection.yaw + half).rem_euclid(period) - half;
    if turn > std::f64::consts::PI {
        turn -= 2.0 * std::f64::consts::PI;
    }
    let velocity = match (detection.velocity, truth.velocity) {
        (Some(own), Some(other)) => Scalar::hypot(own[0] - other[0], own[1] - other[1]),
        _ => f64::NAN,
    };
    let attribute = match truth.attribute {
        None => f64::NAN,
        own => f64::from(u8::from(own != detection.attribute)),
    };
    [
        detection.distance(truth),
        1.0 - shared / union,
        turn.abs(),
        velocity,
        attribute,
    ]
}

/// Returns the mean of all numbers up to each, without those that are unknown: zero before the first one known, one
/// everywhere if none is.
fn running_means(numbers: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    if numbers.clone().all(f64::is_nan) {
        return numbers.map(|_| 1.0).collect();
    }
    let (mut sum, mut count) = (0.0, 0.0);
    let mean = |x: f64| {
        if !x.is_nan() {
            (sum, count) = (sum + x, count + 1.0);
        }
        if count > 0.0 { sum / count } else { 0.0 }
    };
    numbers.map(mean).collect()
}

/// Returns the value at a coordinate, interpolated linearly between the values at ascending coordinates; of equal
/// coordinates the last one counts.
fn between(at: f64, places: &[f64], values: &[f64], beyond: f64) -> f64 {
    let after = places.partition_point(|&place| place <= at);
    let last = places.len() - 1;
    match after {
        0 => values[0],
        _ if at > places[last] => beyond,
        _ if after > last || places[after - 1] == at => values[after - 1],
        _ => {
            let slope = (values[after] - values[after - 1]) / (places[after] - places[after - 1]);
            slope * (at - places[after - 1]) + values[after - 1]
        }
    }
}

pub(crate) fn check(frames: &Frames<'_>) -> Result<(), Error> {
    let lists = [
        (
            "detections",
            frames.detections,
            frames.detection_offsets,
            Argument::Named("detection_offsets"),
        ),
        (
            "truths",
            frames.truths,
            frames.truth_offsets,
            Argument::Named("truth_offsets"),
        ),
    ];
    for (name, objects, offsets, argument) in lists {
        check_groups(argument, objects.len(), offsets)?;
        let flaws = objects.iter().enumerate();
        if let Some((item, flaw)) = flaws.filter_map(|(i, x)| Some((i, x.flaw()?))).next() {
            return Err(invalid(name, item, flaw));
        }
    }
    let lengths = [
        ("scores", frames.detections.len(), frames.scores.len()),
        (
            "truth_offsets",
            frames.detection_offsets.len(),
            frames.truth_offsets.len(),
        ),
    ];
    for (name, expected, found) in lengths {
        if expected != found {
            let argument = Argument::Named(name);
            return Err(Error::Length {
                argument,
                expected,
                found,
            });
        }
    }
    if let Some(item) = frames.scores.iter().position(|x| !x.is_finite()) {
        return Err(invalid("scores", item, Flaw::NotFinite(Field::VALUE)));
    }
    if !(frames.period.is_finite() && frames.period > 0.0) {
        return Err(invalid("period", 0, Flaw::NotPositive(Field::VALUE)));
    }
    Ok(())
}

/// Judges the detections of all frames together, of one class at one threshold. If scores are equal the later detection
/// comes first, as in the kit.
///
/// # Errors
///
/// [`Error::GroupsOf`] for offsets that decrease or do not cover their list, [`Error::Length`] for another number of
/// scores or frames, [`Error::Invalid`] for numbers that are not finite and sizes that are not above zero.
///
/// ```
/// use geograd::metric::nuscenes::{Frames, Object, TruePositive, judge};
/// let at = |x| Object::new([x, 0.0], [2.0, 4.0, 1.5], 0.0);
/// let frames = Frames {
///     detections: &[at(0.5), at(9.0)],
///     scores: &[0.9, 0.8],
///     detection_offsets: &[0, 1, 2],
///     truths: &[at(0.0), at(9.0)],
///     truth_offsets: &[0, 1, 2],
///     period: std::f64::consts::TAU,
/// };
/// let judged = judge(&frames, 2.0)?;
/// assert_eq!(judged.average_precision(), 1.0);
/// assert!(judged.error(TruePositive::Translation) > 0.25);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn judge(frames: &Frames<'_>, threshold: f64) -> Result<Judged, Error> {
    check(frames)?;
    let mut found = vec![None; frames.detections.len()];
    found_truths(frames, 0..frames.count(), threshold, &mut found);
    Ok(judged(frames, &ranked(frames, 0..found.len()), &found))
}

impl Frames<'_> {
    pub(crate) fn count(&self) -> usize {
        self.detection_offsets.len().saturating_sub(1)
    }
}

/// Returns the detections of a range by descending score; of equal scores the later one is first.
pub(crate) fn ranked(frames: &Frames<'_>, range: Range<usize>) -> Vec<usize> {
    let (mut order, scores): (Vec<usize>, _) = (range.collect(), frames.scores);
    order.sort_unstable_by(|&i, &j| scores[j].total_cmp(&scores[i]).then(j.cmp(&i)));
    order
}

/// Writes the truths that the detections of some frames find to `found`, whose first entry belongs to the first of
/// these detections.
pub(crate) fn found_truths(
    frames: &Frames<'_>,
    range: Range<usize>,
    threshold: f64,
    found: &mut [Option<usize>],
) {
    let start = frames.detection_offsets[range.start];
    for f in range {
        let own = frames.detection_offsets[f]..frames.detection_offsets[f + 1];
        let first = frames.truth_offsets[f];
        let truths = &frames.truths[first..frames.truth_offsets[f + 1]];
        let mut taken = vec![false; truths.len()];
        for i in ranked(frames, own) {
            let mut nearest: Option<(f64, usize)> = None;
            for (k, truth) in truths.iter().enumerate().filter(|(k, _)| !taken[*k]) {
                let distance = frames.detections[i].distance(truth);
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, k));
                }
            }
            let nearest = nearest.filter(|(distance, _)| *distance < threshold);
            found[i - start] = nearest.map(|(_, k)| {
                taken[k] = true;
                first + k
            });
        }
    }
}

/// Returns the curve of ranked detections, given the truth that each found.
pub(crate) fn judged(frames: &Frames<'_>, order: &[usize], found: &[Option<usize>]) -> Judged {
    let (truths, scores) = (frames.truths.len(), frames.scores);
    // Precision, recall and score after every detection; scores and errors of those that are right.
    let (mut precision, mut recall, mut score) = (Vec::new(), Vec::new(), Vec::new());
    let (mut right_scores, mut right_errors) = (Vec::new(), Vec::new());
    for (place, &i) in order.iter().enumerate() {
        if let Some(truth) = found[i] {
            right_scores.push(scores[i]);
            let (own, truth) = (&frames.detections[i], &frames.truths[truth]);
            right_errors.push(errors(own, truth, frames.period));
        }
        let right = right_scores.len() as f64;
        precision.push(right / (place + 1) as f64);
        recall.push(right / truths as f64);
        score.push(scores[i]);
    }
    if right_scores.is_empty() {
        return Judged::nothing(truths);
    }
    let at = |k: usize| {
        if k + 1 == RECALLS {
            1.0
        } else {
            k as f64 * 0.01
        }
    };
    let read = |values: &[f64]| -> Vec<f64> {
        let recalls = (0..RECALLS).map(at);
        recalls
            .map(|at| between(at, &recall, values, 0.0))
            .collect()
    };
    let (precision, score) = (read(&precision), read(&score));
    // Scores descend, and coordinates ascend.
    right_scores.reverse();
    let errors = std::array::from_fn(|k| {
        let mut means = running_means(right_errors.iter().map(|errors| errors[k]));
        means.reverse();
        let last = means[means.len() - 1];
        let read = |&at: &f64| between(at, &right_scores, &means, last);
        score.iter().map(read).collect()
    });
    Judged {
        precision,
        score,
        errors,
        truths,
    }
}
