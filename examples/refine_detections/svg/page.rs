//! The page: what is on it, its measures, the looks of boxes, and the map from metres to it.
use crate::loss::Goal;
use crate::matching::Match;
use crate::model::Frame;
use common::svg::{MIDDLE, Page, SMALL};
use geograd::{Obb2, Vec2};

/// The page, in pixels.
pub const WIDTH: f32 = 1160.0;
pub const MARGIN: f32 = 30.0;
pub const GAP: f32 = 70.0;
pub const HEAD: f32 = 116.0;
/// Left of and below a map, for its numbers.
pub const SIDE: f32 = 40.0;
pub const FOOT: f32 = 44.0;

/// One frame before and after.
pub struct Scene<'a> {
    pub number: u32,
    pub states: [State<'a>; 2],
    pub goal: Goal,
}

/// The detections of a frame, and their matches.
#[derive(Clone, Copy)]
pub struct State<'a> {
    pub frame: &'a Frame,
    pub matches: &'a [Match],
}

/// The looks and the names of both states.
pub const STATES: [(Kind, &str); 2] = [(Kind::Before, "Before"), (Kind::After, "After")];

/// The kinds of boxes and their looks.
#[derive(Clone, Copy)]
pub enum Kind {
    Truth,
    Missed,
    Before,
    After,
    Unmatched,
}

impl Kind {
    pub const ALL: [Kind; 5] = [
        Kind::Truth,
        Kind::Missed,
        Kind::Before,
        Kind::After,
        Kind::Unmatched,
    ];

    pub fn style(self) -> &'static str {
        match self {
            Kind::Truth => r##"fill="#b2d8a5" stroke="#5c9a4a" stroke-width="1""##,
            Kind::Missed => {
                r##"fill="#fff" stroke="#5c9a4a" stroke-width="1.2" stroke-dasharray="3 2.5""##
            }
            Kind::Before => {
                r##"fill="#e8590c" fill-opacity="0.10" stroke="#e8590c" stroke-width="1.7""##
            }
            Kind::After => {
                r##"fill="#1864ab" fill-opacity="0.10" stroke="#1864ab" stroke-width="1.7""##
            }
            Kind::Unmatched => {
                r##"fill="none" stroke="#868e96" stroke-width="1.3" stroke-dasharray="4 3""##
            }
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Kind::Truth => "ground truth",
            Kind::Missed => "ground truth, not detected",
            Kind::Before => "detection, before",
            Kind::After => "detection, after",
            Kind::Unmatched => "detection of nothing",
        }
    }
}

/// The map from metres to the page.
#[derive(Clone, Copy)]
pub struct View {
    /// The lower left corner, in metres and on the page.
    pub corner: Vec2<f32>,
    pub at: Vec2<f32>,
    /// Pixels per metre.
    pub scale: f32,
}

impl View {
    pub fn place(self, point: Vec2<f32>) -> Vec2<f32> {
        let off = (point - self.corner) * self.scale;
        Vec2::new(self.at.x + off.x, self.at.y - off.y)
    }

    /// A box without its front.
    pub fn outline(self, page: &mut Page, shape: Obb2<f32>, kind: Kind) {
        page.polygon(shape.corners().map(|p| self.place(p)), kind.style());
    }

    pub fn draw(self, page: &mut Page, shape: Obb2<f32>, kind: Kind) {
        self.outline(page, shape, kind);
        // From the centre to the front, where there is room for it.
        if shape.size.x * self.scale > 14.0 {
            let [_, right, left, _] = shape.corners().map(|corner| self.place(corner));
            let way = [self.place(shape.center), right.lerp(left, 0.5)];
            page.strokes([way], kind.style());
        }
    }

    /// The ground of a map, from its lower left corner to the upper right one, given in metres.
    pub fn ground(self, page: &mut Page, id: &str, min: Vec2<f32>, max: Vec2<f32>) {
        let (low, high) = (self.place(min), self.place(max));
        page.ground(id, [low.x, high.y, high.x - low.x, low.y - high.y]);
    }

    /// Upright lines every ten metres, with their numbers if they are wanted.
    pub fn upright(self, page: &mut Page, min: Vec2<f32>, max: Vec2<f32>, numbers: bool) {
        for ten in tens(min.x, max.x) {
            let x = ten as f32 * 10.0;
            let ends = [min.y, max.y].map(|y| self.place(Vec2::new(x, y)));
            line(page, ends, ten == 0);
            if numbers {
                let foot = Vec2::new(ends[0].x, ends[0].y + 16.0);
                page.text(foot, format_args!("{SMALL} {MIDDLE}"), metres(ten));
            }
        }
    }
}

/// The multiples of ten metres in a range.
pub fn tens(min: f32, max: f32) -> std::ops::RangeInclusive<i32> {
    (min / 10.0).ceil() as i32..=(max / 10.0).floor() as i32
}

pub fn metres(ten: i32) -> String {
    (10 * ten).to_string().replace('-', "−")
}

pub fn line(page: &mut Page, ends: [Vec2<f32>; 2], strong: bool) {
    let color = if strong { "#ced4da" } else { "#e9ecef" };
    page.strokes([ends], format_args!(r#"stroke="{color}""#));
}
