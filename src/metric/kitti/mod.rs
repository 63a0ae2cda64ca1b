//! The rules of KITTI's object benchmark, as its development kit has them: which truths and detections count at
//! a difficulty, how they are matched, and average precision at forty or eleven recalls.
//!
//! Geiger, Lenz and Urtasun, *Are we ready for autonomous driving?*, CVPR 2012; forty recalls since Simonelli et
//! al., *Disentangling monocular 3D object detection*, ICCV 2019. Differences from [`outcomes`](super::outcomes):
//!
//! * truths choose detections, in the order of the truths, and not the reverse;
//! * precision is read at about forty scores, those of right detections at which recall passes a fortieth;
//! * an overlap must be above the threshold, equality is not enough;
//! * detections in regions without labels are not wrong: their overlap is the share of the detection in the
//!   region, where other overlaps are intersections over unions. The regions are parts of the image; they
//!   have no place in space, so the kit leaves out nothing where overlaps are of boxes in space or seen from
//!   above.
//!
//! Compared with public copies of the kit's source. They differ in one thing: newer ones ignore a truth whose
//! height equals the limit, as is done here, older ones do not.
use crate::error::Error;

mod frames;
mod judging;

pub use frames::{Angles, Counts, Frame};
pub use judging::Judged;
pub(crate) use judging::Judging;

/// A difficulty of the benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Difficulty {
    /// At least 40 pixels high, fully visible, truncated by at most 15 %.
    Easy,
    /// At least 25 pixels high, partly hidden at most, truncated by at most 30 %.
    Moderate,
    /// At least 25 pixels high, largely hidden at most, truncated by at most 50 %.
    Hard,
}

impl Difficulty {
    /// Returns the least height of what counts, in pixels; a truth must be higher.
    #[must_use]
    pub const fn height(self) -> f64 {
        match self {
            Difficulty::Easy => 40.0,
            Difficulty::Moderate | Difficulty::Hard => 25.0,
        }
    }
    /// Returns the highest level of occlusion that counts.
    #[must_use]
    pub const fn occlusion(self) -> u8 {
        match self {
            Difficulty::Easy => 0,
            Difficulty::Moderate => 1,
            Difficulty::Hard => 2,
        }
    }
    /// Returns the largest truncated share that counts.
    #[must_use]
    pub const fn truncation(self) -> f64 {
        match self {
            Difficulty::Easy => 0.15,
            Difficulty::Moderate => 0.3,
            Difficulty::Hard => 0.5,
        }
    }
    /// Returns the role of a truth in the count.
    ///
    /// ```
    /// use geograd::metric::kitti::{Counts, Difficulty, Label, GroundTruth};
    /// let car = GroundTruth { label: Label::Own, height: 30.0, occlusion: 0, truncation: 0.0 };
    /// assert_eq!(Difficulty::Moderate.truth(car), Counts::Fully);
    /// assert_eq!(Difficulty::Easy.truth(car), Counts::Ignored);
    /// let van = GroundTruth { label: Label::Neighbouring, ..car };
    /// assert_eq!(Difficulty::Moderate.truth(van), Counts::Ignored);
    /// ```
    #[must_use]
    pub fn truth(self, truth: GroundTruth) -> Counts {
        let is_easy = truth.occlusion <= self.occlusion()
            && truth.truncation <= self.truncation()
            && truth.height > self.height();
        match truth.label {
            Label::Own if is_easy => Counts::Fully,
            Label::Own | Label::Neighbouring => Counts::Ignored,
            Label::Other => Counts::Not,
        }
    }
    /// Returns the role in the count of a detection of a height in pixels, of the class that is judged or of another
    /// one.
    #[must_use]
    pub fn detection(self, height: f64, is_of_class: bool) -> Counts {
        if height < self.height() {
            Counts::Ignored
        } else if is_of_class {
            Counts::Fully
        } else {
            Counts::Not
        }
    }
}

/// A truth's class, relative to the class that is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Label {
    /// The class that is judged.
    Own,
    /// One so similar that finding it is no mistake: vans for cars, sitting people for pedestrians.
    Neighbouring,
    /// Any other one.
    Other,
}

/// The properties of a truth that the rules read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundTruth {
    /// Its class.
    pub label: Label,
    /// The height of its box in the image, in pixels.
    pub height: f64,
    /// The degree to which it is hidden: 0 not at all, 1 partly, 2 largely, 3 unknown.
    pub occlusion: u8,
    /// The share of it outside of the image, in `[0, 1]`.
    pub truncation: f64,
}

/// Judges the detections of all frames together, of one class and difficulty: overlaps above the threshold
/// are right (0.7 for cars, 0.5 for pedestrians and cyclists).
///
/// # Errors
///
/// [`Error::Length`] for lists of other lengths than the scores, [`Error::Invalid`] for numbers that are not
/// finite and pairs beyond the lists.
///
/// ```
/// use geograd::metric::{Recalls, kitti::{Counts, Frame, judge}};
/// use geograd::suppression::Pair;
/// let frame = Frame {
///     truths: &[Counts::Fully, Counts::Ignored],
///     scores: &[0.9, 0.8, 0.3],
///     detections: &[Counts::Fully; 3],
///     pairs: &[
///         Pair { first: 0, second: 0, overlap: 0.8 },
///         Pair { first: 1, second: 1, overlap: 0.9 },
///     ],
///     unlabelled: &[],
/// };
/// let judged = judge(&[frame], 0.7)?;
/// // The van that was found does not count, and no score below the last right one is looked at.
/// assert_eq!(judged.curve.len(), 1);
/// assert_eq!(judged.curve[0].precision, 1.0);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn judge(frames: &[Frame<'_>], threshold: f64) -> Result<Judged, Error> {
    Ok(Judging::new(frames, None, threshold)?.judged())
}

/// Judges frames as [`judge`] does, with the angles of every frame, for the similarity of orientation.
///
/// # Errors
///
/// As [`judge`]; [`Error::Length`] also for angles of another number than frames, truths and detections, and
/// [`Error::Invalid`] for those that are not finite.
///
/// ```
/// use geograd::metric::{Recalls, kitti::{Angles, Counts, Frame, judge_oriented}};
/// use geograd::suppression::Pair;
/// let frame = Frame {
///     truths: &[Counts::Fully],
///     scores: &[0.9],
///     detections: &[Counts::Fully],
///     pairs: &[Pair { first: 0, second: 0, overlap: 0.8 }],
///     unlabelled: &[],
/// };
/// let angles = Angles { truths: &[0.5], detections: &[0.5 + std::f64::consts::FRAC_PI_2] };
/// let judged = judge_oriented(&[frame], &[angles], 0.7)?;
/// assert_eq!(judged.curve[0].precision, 1.0);
/// assert!((judged.similarity[0] - 0.5).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn judge_oriented(
    frames: &[Frame<'_>],
    angles: &[Angles<'_>],
    threshold: f64,
) -> Result<Judged, Error> {
    Ok(Judging::new(frames, Some(angles), threshold)?.judged())
}
