//! Which detection belongs to which truth, and how good the detections are by that.
use crate::assign::assign;
use crate::loss::Space;
use crate::model::{Frame, Frames, in_space};
use geograd::Error;
use geograd::assignment::greedy;
use geograd::kernels::{Backend, Iou};
use geograd::suppression::Pair;

/// A detection and the truth it was matched to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    pub frame: u32,
    /// Index into the detections of the frame.
    pub detection: usize,
    /// Index into the truths of the frame.
    pub truth: usize,
    /// Their overlap.
    pub iou: f32,
}

/// All matches of a frame, and the number of pairs scored.
///
/// Every detection with every truth is one batch. Pairs are one to one within
/// their classes and have the largest sum of overlaps (the Hungarian method);
/// pairs without overlap are dropped.
pub fn match_frame(
    backend: Backend<'_>,
    space: Space,
    number: u32,
    frame: &Frame,
) -> Result<Vec<Match>, Error> {
    let (detections, truths) = (&frame.detections, &frame.truths);
    let table = in_space!(space, |detections, truths| backend.all_pairs(
        Iou,
        &detections,
        &truths
    ))?;
    let mut overlaps = table.into_planes();
    for (i, iou) in overlaps.iter_mut().enumerate() {
        if detections[i / truths.len()].class != truths[i % truths.len()].class {
            *iou = 0.0;
        }
    }
    let pairs = assign(&overlaps, detections.len(), truths.len());
    let matches = pairs.into_iter().map(|(detection, truth)| Match {
        frame: number,
        detection,
        truth,
        iou: overlaps[detection * truths.len() + truth],
    });
    Ok(matches.filter(|m| m.iou > 0.0).collect())
}

/// Detections and truths of a frame that overlap nothing and are near each other: no farther apart than
/// the truth is long. The nearest ones first, one to one within their classes.
pub fn apart(number: u32, frame: &Frame, matches: &[Match]) -> Vec<Match> {
    let mut pairs = Vec::new();
    for (first, detection) in frame.detections.iter().enumerate() {
        for (second, truth) in frame.truths.iter().enumerate() {
            let free = matches
                .iter()
                .all(|m| m.detection != first && m.truth != second);
            let distance = detection.shape.center.distance(truth.shape.center);
            let reach = truth.shape.size.length();
            if free && detection.class == truth.class && distance <= reach {
                pairs.push(Pair {
                    first,
                    second,
                    overlap: -distance,
                });
            }
        }
    }
    let pairs = greedy(&pairs).into_iter().map(|pair| Match {
        frame: number,
        detection: pair.first,
        truth: pair.second,
        iou: 0.0,
    });
    pairs.collect()
}

/// How good the detections of all frames are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quality {
    pub matches: usize,
    /// The mean IoU of all matches; `None` without matches.
    pub mean_iou: Option<f64>,
    /// Precision and recall at overlap 0.5 and at 0.7; `None` where there is nothing to count.
    pub precision: [Option<f64>; 2],
    pub recall: [Option<f64>; 2],
}

/// The overlaps that count as found.
pub const THRESHOLDS: [f32; 2] = [0.5, 0.7];

impl Quality {
    /// The quality of so many detections and truths with these matches.
    pub fn of(matches: &[Match], detections: usize, truths: usize) -> Self {
        let part = |count: f64, of: usize| (of > 0).then(|| count / of as f64);
        let good = THRESHOLDS.map(|t| matches.iter().filter(|m| m.iou >= t).count() as f64);
        let sum = matches.iter().map(|m| f64::from(m.iou)).sum();
        Quality {
            matches: matches.len(),
            mean_iou: part(sum, matches.len()),
            precision: good.map(|good| part(good, detections)),
            recall: good.map(|good| part(good, truths)),
        }
    }
}

/// Numbers of detections, truths and pairs of them in all frames.
pub fn count(frames: &Frames) -> (usize, usize, usize) {
    frames.values().fold((0, 0, 0), |(d, t, p), frame| {
        let (detections, truths) = (frame.detections.len(), frame.truths.len());
        (d + detections, t + truths, p + detections * truths)
    })
}
