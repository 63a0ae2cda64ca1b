//! Which detection belongs to which truth, and how good the detections are by that.
use crate::assign::assign;
use crate::model::{Frame, Frames};
use geograd::Error;
use geograd::kernels::Backend;
use geograd::kernels::ops::overlap::IouObb2;

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
/// Every detection with every truth is one batch. Of all ways to pair them one to one within
/// their classes this takes the one whose overlaps have the largest sum (the Hungarian method), and
/// drops the pairs without overlap.
pub fn match_frame(backend: Backend<'_>, number: u32, frame: &Frame) -> Result<Vec<Match>, Error> {
    let shapes = |seen: &[crate::model::Seen]| seen.iter().map(|s| s.shape).collect::<Vec<_>>();
    let (detections, truths) = (shapes(&frame.detections), shapes(&frame.truths));
    let mut overlaps = backend.all_pairs::<IouObb2>(&detections, &truths)?;
    for (i, iou) in overlaps.iter_mut().enumerate() {
        let (detection, truth) = (i / truths.len(), i % truths.len());
        if frame.detections[detection].class != frame.truths[truth].class {
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

/// How good the detections of all frames are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quality {
    pub matches: usize,
    /// Of all matches; `None` without matches.
    pub mean_iou: Option<f64>,
    /// Precision and recall at overlap 0.5 and at 0.7; `None` where there is nothing to count.
    pub precision: [Option<f64>; 2],
    pub recall: [Option<f64>; 2],
}

/// The overlaps that count as found.
pub const THRESHOLDS: [f32; 2] = [0.5, 0.7];

impl Quality {
    /// Of that many detections and truths with these matches.
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
