//! The scores of a pair and the formats of its shapes, by the words of the command line.
use common::cli::Failure;

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
        let found = Self::ALL.into_iter().find(|metric| metric.name() == name);
        found.ok_or_else(|| {
            let known = Self::ALL.map(Metric::name).join(", ");
            Failure::Usage(format!("`--metric {name}`: it is one of {known}"))
        })
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
        match name {
            "aabb" => Ok(Enclosing::Aabb),
            "rect" => Ok(Enclosing::Rect),
            "hull" => Ok(Enclosing::Hull),
            other => Err(Failure::Usage(format!(
                "`--enclosing {other}`: it is aabb, rect or hull"
            ))),
        }
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
    const ALL: [Format; 4] = [Format::Obb2, Format::Polygons, Format::Yaw3, Format::Obb3];

    pub fn name(self) -> &'static str {
        match self {
            Format::Obb2 => "obb2",
            Format::Polygons => "polygons",
            Format::Yaw3 => "yaw3",
            Format::Obb3 => "obb3",
        }
    }

    pub fn from_name(name: &str) -> Result<Self, Failure> {
        let found = Self::ALL.into_iter().find(|format| format.name() == name);
        found.ok_or_else(|| {
            let known = Self::ALL.map(Format::name).join(", ");
            Failure::Usage(format!("`--format {name}`: it is one of {known}"))
        })
    }

    /// The tightest shape that there is around a pair: what the library's plain names put there.
    pub fn enclosing(self) -> Enclosing {
        match self {
            Format::Obb3 => Enclosing::Rect,
            _ => Enclosing::Hull,
        }
    }
}
