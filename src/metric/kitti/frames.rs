//! Frames of truths and detections, and how each of them counts.
use crate::suppression::Pair;

/// The role of a truth or a detection in the count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Counts {
    /// It must be found, or must be right.
    Fully,
    /// It may be found, or may be wrong.
    Ignored,
    /// It is not there.
    Not,
}

/// The truths and detections of one image or scan.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The role of every truth.
    pub truths: &'a [Counts],
    /// The score of every detection.
    pub scores: &'a [f64],
    /// The role of every detection.
    pub detections: &'a [Counts],
    /// Overlaps of detections (the first of a pair) and truths (the second); others do not overlap.
    pub pairs: &'a [Pair<f64>],
    /// For every detection the largest share of its box in the image in a region without labels; empty where
    /// there are none, and for overlaps in space or seen from above.
    pub unlabelled: &'a [f64],
}

/// Observation angles of a frame in radians: the kit's `alpha`.
#[derive(Clone, Copy, Debug)]
pub struct Angles<'a> {
    /// One angle for every truth.
    pub truths: &'a [f64],
    /// One angle for every detection.
    pub detections: &'a [f64],
}
