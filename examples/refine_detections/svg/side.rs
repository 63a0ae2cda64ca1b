//! A frame seen from the side: forward to the right, up upwards, at one scale.
use super::Scene;
use super::page::{FAINT, Kind, MARGIN, SIDE, View, WIDTH, line, metres, text};
use crate::loss::Space;
use crate::matching::Match;
use crate::model::Frame;
use geograd::{Obb2, Vec2, YawBox3};
use std::fmt::Write as _;

/// Above each strip for its name, and below both for the numbers.
const NAME: f32 = 24.0;
const FOOT: f32 = 40.0;

/// Two strips below the maps, before and after; none where heights do not count.
pub struct Strips {
    top: f32,
    /// The range that they show, forward and up, in metres.
    min: Vec2<f32>,
    max: Vec2<f32>,
    /// Pixels per metre.
    scale: f32,
}

/// A box from the side.
fn silhouette(shape: YawBox3<f32>) -> Obb2<f32> {
    let bounds = shape.bounding();
    let (near, far) = (bounds.min.y, bounds.max.y);
    Obb2::new(
        near.midpoint(far),
        shape.center.z,
        far - near,
        shape.size.z,
        0.0,
    )
}

impl Strips {
    pub fn of(scene: &Scene<'_>, top: f32) -> Self {
        let (mut min, mut max) = (Vec2::new(0.0, -1.7), Vec2::new(20.0_f32, 0.3));
        let states = [
            (scene.before, scene.matches_before),
            (scene.after, scene.matches_after),
        ];
        for (frame, pair) in states.iter().flat_map(|(frame, matches)| {
            let pairs = matches.iter();
            pairs.map(move |pair| (frame, pair))
        }) {
            let (truth, seen) = (&frame.truths[pair.truth], &frame.detections[pair.detection]);
            for shape in [truth.shape, seen.shape] {
                let bounds = silhouette(shape).bounding();
                (min, max) = (min.least(bounds.min), max.most(bounds.max));
            }
        }
        let round = |x: f32, up: f32| ((x + up) / 5.0).floor() * 5.0;
        let air = Vec2::new(0.0, 0.25);
        let (min, max) = (min - air, max + air);
        let (min, max) = (
            Vec2::new(round(min.x, 0.0), min.y),
            Vec2::new(round(max.x, 5.0), max.y),
        );
        let scale = match scene.goal.space {
            Space::BirdsEye => 0.0,
            Space::Full => (WIDTH - 2.0 * MARGIN - SIDE) / (max.x - min.x),
        };
        Strips {
            top,
            min,
            max,
            scale,
        }
    }

    /// The height of one strip.
    fn strip(&self) -> f32 {
        self.scale * (self.max.y - self.min.y)
    }

    /// The height of both with the text around them.
    pub fn height(&self) -> f32 {
        match self.scale > 0.0 {
            true => 2.0 * (NAME + self.strip()) + FOOT,
            false => 0.0,
        }
    }

    pub fn draw(&self, page: &mut String, scene: &Scene<'_>) {
        if self.scale <= 0.0 {
            return;
        }
        let states = [
            (Kind::Before, scene.before, scene.matches_before, "Before"),
            (Kind::After, scene.after, scene.matches_after, "After"),
        ];
        for (i, (kind, frame, matches, name)) in states.into_iter().enumerate() {
            let top = self.top + NAME + i as f32 * (NAME + self.strip());
            let view = View {
                corner: self.min,
                at: Vec2::new(MARGIN + SIDE, top + self.strip()),
                scale: self.scale,
            };
            let words = format!(
                r##"<tspan font-weight="600">{name}</tspan><tspan fill="{FAINT}">, from the right: matched boxes</tspan>"##
            );
            text(page, MARGIN + SIDE, top - 8.0, "", &words);
            self.grid(page, view, i);
            let _ = writeln!(page, r#"<g clip-path="url(#side{i})">"#);
            boxes(page, view, kind, frame, matches);
            page.push_str("</g>\n");
        }
        let small = format!(r#"font-size="11" fill="{FAINT}" text-anchor="middle""#);
        let (middle, foot) = (0.5 * (SIDE + WIDTH), self.top + self.height() - FOOT);
        text(page, middle, foot + 33.0, &small, "forward, metres");
    }

    fn grid(&self, page: &mut String, view: View, index: usize) {
        let (low, high) = (view.place(self.min), view.place(self.max));
        let _ = writeln!(
            page,
            r##"<clipPath id="side{index}"><rect x="{x:.1}" y="{y:.1}" width="{w:.1}" height="{h:.1}"/></clipPath>
<rect x="{x:.1}" y="{y:.1}" width="{w:.1}" height="{h:.1}" fill="#fcfcfd" stroke="#ced4da"/>"##,
            x = low.x,
            y = high.y,
            w = high.x - low.x,
            h = low.y - high.y,
        );
        let small = format!(r#"font-size="11" fill="{FAINT}""#);
        let middle = format!(r#"{small} text-anchor="middle""#);
        let end = format!(r#"{small} text-anchor="end""#);
        let tens = (self.min.x / 10.0).ceil() as i32..=(self.max.x / 10.0).floor() as i32;
        for ten in tens {
            let x = view.place(Vec2::new(ten as f32 * 10.0, 0.0)).x;
            line(page, Vec2::new(x, low.y), Vec2::new(x, high.y), ten == 0);
            if index == 1 {
                text(page, x, low.y + 16.0, &middle, &metres(ten));
            }
        }
        // The camera's height.
        let y = view.place(Vec2::zero()).y;
        line(page, Vec2::new(low.x, y), Vec2::new(high.x, y), true);
        text(page, low.x - 7.0, y + 4.0, &end, "camera");
    }
}

/// The matched boxes of a frame.
fn boxes(page: &mut String, view: View, kind: Kind, frame: &Frame, matches: &[Match]) {
    for pair in matches {
        let truth = frame.truths[pair.truth].shape;
        view.outline(page, silhouette(truth), Kind::Truth);
    }
    for pair in matches {
        let detection = frame.detections[pair.detection].shape;
        view.outline(page, silhouette(detection), kind);
    }
}
