//! A map of a frame seen from above.
use super::page::{FAINT, INK, Kind, View, line, metres, text};
use crate::matching::Match;
use crate::model::{Frame, Seen};
use geograd::Vec2;
use std::fmt::Write as _;

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
pub fn grid(page: &mut String, view: View, extent: &Extent, index: usize) {
    let (low, high) = (view.place(extent.min), view.place(extent.max));
    let _ = writeln!(
        page,
        r##"<clipPath id="map{index}"><rect x="{x:.1}" y="{y:.1}" width="{w:.1}" height="{h:.1}"/></clipPath>
<rect x="{x:.1}" y="{y:.1}" width="{w:.1}" height="{h:.1}" fill="#fcfcfd" stroke="#ced4da"/>"##,
        x = low.x,
        y = high.y,
        w = high.x - low.x,
        h = low.y - high.y,
    );
    let small = format!(r#"font-size="11" fill="{FAINT}""#);
    let middle = format!(r#"{small} text-anchor="middle""#);
    let end = format!(r#"{small} text-anchor="end""#);
    let tens = |min: f32, max: f32| (min / 10.0).ceil() as i32..=(max / 10.0).floor() as i32;
    for ten in tens(extent.min.x, extent.max.x) {
        let x = view.place(Vec2::new(ten as f32 * 10.0, 0.0)).x;
        line(page, Vec2::new(x, low.y), Vec2::new(x, high.y), ten == 0);
        text(page, x, low.y + 16.0, &middle, &metres(ten));
    }
    for ten in tens(extent.min.y, extent.max.y) {
        let y = view.place(Vec2::new(0.0, ten as f32 * 10.0)).y;
        line(page, Vec2::new(low.x, y), Vec2::new(high.x, y), ten == 0);
        text(page, low.x - 7.0, y + 4.0, &end, &metres(ten));
    }
    let x = low.x.midpoint(high.x);
    text(page, x, low.y + 33.0, &middle, "to the right, metres");
    let (x, y) = (low.x - 33.0, low.y.midpoint(high.y));
    let turned = format!(r#"{middle} transform="rotate(-90 {x:.1} {y:.1})""#);
    text(page, x, y, &turned, "forward, metres");
    let camera = view.place(Vec2::zero());
    let _ = writeln!(
        page,
        r#"<path d="M{:.1},{:.1}l-6,11h12z" fill="{INK}"><title>camera</title></path>"#,
        camera.x,
        camera.y - 6.0,
    );
    text(page, camera.x + 10.0, camera.y - 4.0, &small, "camera");
}

/// All boxes of a frame: truths below, what belongs to nothing next, matched detections on top.
pub fn map(page: &mut String, view: View, kind: Kind, frame: &Frame, matches: &[Match]) {
    for (i, truth) in frame.truths.iter().enumerate() {
        let found = matches.iter().any(|m| m.truth == i);
        let kind = if found { Kind::Truth } else { Kind::Missed };
        view.draw(page, truth.ground(), kind);
    }
    let is_matched = |i: usize| matches.iter().any(|m| m.detection == i);
    for pass in [false, true] {
        for (i, detection) in frame.detections.iter().enumerate() {
            if is_matched(i) == pass {
                let kind = if pass { kind } else { Kind::Unmatched };
                view.draw(page, detection.ground(), kind);
            }
        }
    }
}
