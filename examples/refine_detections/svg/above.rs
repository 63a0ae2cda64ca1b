//! A map of a frame seen from above.
use super::page::{Kind, State, View, line, metres, tens};
use crate::model::Seen;
use common::svg::{INK, MIDDLE, Page, SMALL};
use geograd::Vec2;

/// The part of the plane that a map shows.
pub struct Extent {
    pub min: Vec2<f32>,
    pub max: Vec2<f32>,
}

impl Extent {
    /// All boxes and the camera, out to the next five metres.
    pub fn of<'a>(shapes: impl Iterator<Item = &'a Seen>) -> Self {
        let (mut min, mut max) = (Vec2::new(-9.0, 1.0), Vec2::new(9.0_f32, 19.0));
        for seen in shapes {
            let bounds = seen.ground().bounding();
            (min, max) = (min.least(bounds.min), max.most(bounds.max));
        }
        let down = |x: f32| ((x - 1.0) / 5.0).floor() * 5.0;
        let up = |x: f32| ((x + 1.0) / 5.0).ceil() * 5.0;
        let mut extent = Extent {
            min: Vec2::new(down(min.x), down(min.y)),
            max: Vec2::new(up(max.x), up(max.y)),
        };
        // Neither a tower nor a ribbon.
        while extent.size().y > 1.5 * extent.size().x {
            extent.min.x -= 5.0;
            extent.max.x += 5.0;
        }
        while extent.size().y < 0.6 * extent.size().x {
            extent.max.y += 5.0;
        }
        extent
    }

    pub fn size(&self) -> Vec2<f32> {
        self.max - self.min
    }
}

/// Lines every ten metres with their numbers, the frame of the map, and the camera.
pub fn grid(page: &mut Page, view: View, extent: &Extent, id: &str) {
    let Extent { min, max } = *extent;
    let (low, high) = (view.place(min), view.place(max));
    view.ground(page, id, min, max);
    view.upright(page, min, max, true);
    for ten in tens(min.y, max.y) {
        let y = view.place(Vec2::new(0.0, ten as f32 * 10.0)).y;
        let ends = [low.x, high.x].map(|x| Vec2::new(x, y));
        line(page, ends, ten == 0);
        page.left_of(ends[0], SMALL, metres(ten));
    }
    let middle = format!("{SMALL} {MIDDLE}");
    let foot = Vec2::new(low.x.midpoint(high.x), low.y + 33.0);
    page.text(foot, &middle, "to the right, metres");
    let side = Vec2::new(low.x - 33.0, low.y.midpoint(high.y));
    let turned = format_args!(
        r#"{middle} transform="rotate(-90 {:.1} {:.1})""#,
        side.x, side.y
    );
    page.text(side, turned, "forward, metres");
    let Vec2 { x, y } = view.place(Vec2::zero());
    page.element(format_args!(
        r#"<path d="M{x:.1},{:.1}l-6,11h12z" fill="{INK}"><title>camera</title></path>"#,
        y - 6.0,
    ));
    page.text(Vec2::new(x + 10.0, y - 4.0), SMALL, "camera");
}

/// All boxes of a frame: truths below, what belongs to nothing next, matched detections on top.
pub fn map(page: &mut Page, view: View, kind: Kind, state: State<'_>) {
    let State { frame, matches } = state;
    for (i, truth) in frame.truths.iter().enumerate() {
        let found = matches.iter().any(|m| m.truth == i);
        let kind = if found { Kind::Truth } else { Kind::Missed };
        view.draw(page, truth.ground(), kind);
    }
    let is_matched = |i: usize| matches.iter().any(|m| m.detection == i);
    for pass in [false, true] {
        let kind = if pass { kind } else { Kind::Unmatched };
        for (i, detection) in frame.detections.iter().enumerate() {
            if is_matched(i) == pass {
                view.draw(page, detection.ground(), kind);
            }
        }
    }
}
