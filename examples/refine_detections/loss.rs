//! The scores that move boxes: of a box and its truth, 1 where both are the same. A loss is one minus
//! the score.
use common::cli::{Failure, choice};

/// The space in which boxes overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// Seen from above.
    #[default]
    BirdsEye,
    /// With their heights.
    Full,
}

impl Space {
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        let known = [("bev", Space::BirdsEye), ("3d", Space::Full)];
        choice("--space", name, known)
    }
}

/// The loss that moves a box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loss {
    #[default]
    Iou,
    Giou,
    Diou,
    Ciou,
    /// Wasserstein's distance of Gaussians.
    Gwd,
    /// Their Kullback-Leibler divergence.
    Kld,
    /// Their overlap as a Kalman filter fuses them, and the distance of their centres.
    Kfiou,
    /// One minus their Hellinger distance.
    Probiou,
    /// IoU, or for boxes apart how far.
    Separation,
}

impl Loss {
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        let known = [
            ("iou", Loss::Iou),
            ("giou", Loss::Giou),
            ("diou", Loss::Diou),
            ("ciou", Loss::Ciou),
            ("gwd", Loss::Gwd),
            ("kld", Loss::Kld),
            ("kfiou", Loss::Kfiou),
            ("probiou", Loss::Probiou),
            ("separation", Loss::Separation),
        ];
        choice("--loss", name, known)
    }

    /// The score as it is written.
    pub fn title(self) -> &'static str {
        match self {
            Loss::Iou => "IoU",
            Loss::Giou => "GIoU",
            Loss::Diou => "DIoU",
            Loss::Ciou => "CIoU",
            Loss::Gwd => "GWD",
            Loss::Kld => "KLD",
            Loss::Kfiou => "KFIoU",
            Loss::Probiou => "ProbIoU",
            Loss::Separation => "separation-aware overlap",
        }
    }

    /// The score from which a pair is no longer moved. Scores that are flat near one come nearer to it.
    pub fn close(self) -> f32 {
        match self {
            Loss::Kld | Loss::Kfiou => 1.0 - 2e-6,
            _ => 0.9995,
        }
    }

    /// `true` if it takes the overlap of both boxes.
    pub fn needs_iou(self, space: Space) -> bool {
        match self {
            Loss::Iou | Loss::Giou | Loss::Separation => true,
            Loss::Diou | Loss::Ciou => space == Space::Full,
            Loss::Gwd | Loss::Kld | Loss::Kfiou | Loss::Probiou => false,
        }
    }

    /// `true` if it has derivatives for boxes that do not overlap.
    pub fn reaches(self) -> bool {
        self != Loss::Iou
    }
}

/// The loss and the space in which it is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Goal {
    pub loss: Loss,
    pub space: Space,
}
