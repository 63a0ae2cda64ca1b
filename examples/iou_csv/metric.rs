//! The scores of a pair and the formats of its shapes, by the words of the command line.
use common::cli::{Failure, choice};

/// The score of a pair of shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    Iou,
    Iof,
    /// GIoU with an enclosing shape.
    Giou(Enclosing),
    Diou(Enclosing),
    /// DIoU with the axis-aligned box around a pair.
    DiouBox,
    Ciou(Enclosing),
    Eiou(Enclosing),
}

impl Metric {
    const ALL: [Metric; 7] = [
        Metric::Iou,
        Metric::Iof,
        Metric::Giou(Enclosing::Hull),
        Metric::Diou(Enclosing::Hull),
        Metric::DiouBox,
        Metric::Ciou(Enclosing::Hull),
        Metric::Eiou(Enclosing::Hull),
    ];

    /// The word on the command line, and the name of the column.
    pub fn name(self) -> &'static str {
        match self {
            Metric::Iou => "iou",
            Metric::Iof => "iof",
            Metric::Giou(_) => "giou",
            Metric::Diou(_) => "diou",
            Metric::DiouBox => "diou-box",
            Metric::Ciou(_) => "ciou",
            Metric::Eiou(_) => "eiou",
        }
    }

    /// The shape that it puts around a pair, if that can be chosen.
    pub fn enclosing(&mut self) -> Option<&mut Enclosing> {
        match self {
            Metric::Giou(around)
            | Metric::Diou(around)
            | Metric::Ciou(around)
            | Metric::Eiou(around) => Some(around),
            Metric::Iou | Metric::Iof | Metric::DiouBox => None,
        }
    }

    /// `true` if it compares widths and heights.
    pub fn compares_sizes(self) -> bool {
        matches!(self, Metric::Ciou(_) | Metric::Eiou(_))
    }

    pub fn from_name(name: &str) -> Result<Self, Failure> {
        choice("--metric", name, Self::ALL.map(|own| (own.name(), own)))
    }

    /// `true` if GPUs compute it.
    pub fn is_on_gpus(self) -> bool {
        matches!(self, Metric::Iou | Metric::Iof)
    }
}

/// The shape that scores put around a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enclosing {
    /// The axis-aligned box.
    Aabb,
    /// A box that turns with the pair.
    Rect,
    /// The convex hull; of upright boxes that of their grounds, times the height of both.
    Hull,
}

impl Enclosing {
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        let known = [
            ("aabb", Enclosing::Aabb),
            ("rect", Enclosing::Rect),
            ("hull", Enclosing::Hull),
        ];
        choice("--enclosing", name, known)
    }
}

/// The shape of a row of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Obb2,
    Polygons,
    Yaw3,
    Obb3,
}

impl Format {
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        let known = [
            ("obb2", Format::Obb2),
            ("polygons", Format::Polygons),
            ("yaw3", Format::Yaw3),
            ("obb3", Format::Obb3),
        ];
        choice("--format", name, known)
    }

    /// The tightest shape that there is around a pair: what the library's plain names put there.
    pub fn enclosing(self) -> Enclosing {
        match self {
            Format::Obb3 => Enclosing::Rect,
            _ => Enclosing::Hull,
        }
    }
}
