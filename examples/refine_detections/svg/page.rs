//! The page: its measures, the looks of boxes, and what is written and drawn on it.
use geograd::{Obb2, Vec2};
use std::fmt::Write as _;

/// The page, in pixels.
pub const WIDTH: f32 = 1160.0;
pub const MARGIN: f32 = 30.0;
pub const GAP: f32 = 70.0;
pub const HEAD: f32 = 116.0;
/// Left of and below a map, for its numbers.
pub const SIDE: f32 = 40.0;
pub const FOOT: f32 = 44.0;

pub const INK: &str = "#212529";
pub const FAINT: &str = "#868e96";

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
    pub fn outline(self, page: &mut String, shape: Obb2<f32>, kind: Kind) {
        let corners = shape.corners().map(|corner| self.place(corner));
        let points: Vec<_> = corners
            .iter()
            .map(|p| format!("{:.1},{:.1}", p.x, p.y))
            .collect();
        let style = kind.style();
        let _ = writeln!(page, r#"<polygon points="{}" {style}/>"#, points.join(" "));
    }

    pub fn draw(self, page: &mut String, shape: Obb2<f32>, kind: Kind) {
        self.outline(page, shape, kind);
        // From the centre to the front, where there is room for it.
        if shape.size.x * self.scale > 14.0 {
            let style = kind.style();
            let [_, right, left, _] = shape.corners().map(|corner| self.place(corner));
            let front = right.lerp(left, 0.5);
            let center = self.place(shape.center);
            let _ = writeln!(
                page,
                r#"<path d="M{:.1},{:.1}L{:.1},{:.1}" {style}/>"#,
                center.x, center.y, front.x, front.y,
            );
        }
    }
}

pub fn text(page: &mut String, x: f32, y: f32, style: &str, words: &str) {
    let _ = writeln!(
        page,
        r#"<text x="{x:.1}" y="{y:.1}" {style}>{words}</text>"#
    );
}

pub fn metres(ten: i32) -> String {
    format!("{}{}", if ten < 0 { "−" } else { "" }, 10 * ten.abs())
}

pub fn line(page: &mut String, from: Vec2<f32>, to: Vec2<f32>, strong: bool) {
    let color = if strong { "#ced4da" } else { "#e9ecef" };
    let _ = writeln!(
        page,
        r#"<path d="M{:.1},{:.1}L{:.1},{:.1}" stroke="{color}"/>"#,
        from.x, from.y, to.x, to.y,
    );
}
