//! The contents of a frame.
use geograd::{Obb2, YawBox3};
use std::collections::{BTreeMap, BTreeSet};

/// The class of an object. Only objects of the same class are matched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    Car,
    Pedestrian,
    Cyclist,
    /// Any other class, without a detector here.
    Other,
}

impl Class {
    pub fn name(self) -> &'static str {
        match self {
            Class::Car => "Car",
            Class::Pedestrian => "Pedestrian",
            Class::Cyclist => "Cyclist",
            Class::Other => "Other",
        }
    }
}

/// An object as a detector or a labeller saw it.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub class: Class,
    /// How sure the detector is; the scale is its own.
    pub score: f32,
    /// The axes are to the right, forward and up.
    pub shape: YawBox3<f32>,
}

impl Seen {
    /// The box seen from above.
    pub fn ground(&self) -> Obb2<f32> {
        self.shape.birds_eye()
    }
}

/// A call on lists of what was seen, with the boxes of a space in their place.
macro_rules! in_space {
    ($space:expr, |$($list:ident),+| $call:expr) => {
        match $space {
            $crate::loss::Space::BirdsEye => {
                $(let $list: Vec<_> = $list.iter().map($crate::model::Seen::ground).collect();)+
                $call
            }
            $crate::loss::Space::Full => {
                $(let $list: Vec<_> = $list.iter().map(|seen| seen.shape).collect();)+
                $call
            }
        }
    };
}
pub(crate) use in_space;

/// One moment.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    pub detections: Vec<Seen>,
    pub truths: Vec<Seen>,
    /// Objects that resemble those of a class and are neither right nor wrong to detect: vans beside
    /// cars, people who sit beside pedestrians.
    pub alike: Vec<Seen>,
}

/// All moments, by number.
pub type Frames = BTreeMap<u32, Frame>;

/// Sets aside what the numbers are not about: detections with a lower score, and truths of classes
/// that no detection has. Gives the number of each.
pub fn keep_scored(frames: &mut Frames, least_score: f32) -> (usize, usize) {
    let count = |frames: &Frames| {
        frames.values().fold((0, 0), |(d, t), frame| {
            (d + frame.detections.len(), t + frame.truths.len())
        })
    };
    let before = count(frames);
    let classes: BTreeSet<Class> = frames
        .values()
        .flat_map(|frame| frame.detections.iter().map(|seen| seen.class))
        .collect();
    for frame in frames.values_mut() {
        frame.detections.retain(|seen| seen.score >= least_score);
        frame.truths.retain(|seen| classes.contains(&seen.class));
    }
    let after = count(frames);
    (before.0 - after.0, before.1 - after.1)
}
