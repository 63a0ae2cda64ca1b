//! A frame seen from the side: forward to the right, up upwards, at one scale.
use super::page::{Kind, MARGIN, SIDE, STATES, Scene, State, View, WIDTH, line};
use crate::loss::Space;
use common::svg::{MIDDLE, Page, SMALL, headed};
use geograd::{Obb2, Vec2, YawBox3};

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

/// The matched boxes of a state: truths with detections.
fn silhouettes(state: &State<'_>) -> impl Iterator<Item = [Obb2<f32>; 2]> {
    let State { frame, matches } = *state;
    matches.iter().map(|pair| {
        let (truth, seen) = (&frame.truths[pair.truth], &frame.detections[pair.detection]);
        [truth, seen].map(|own| silhouette(own.shape))
    })
}

impl Strips {
    pub fn of(scene: &Scene<'_>, top: f32) -> Self {
        let (mut min, mut max) = (Vec2::new(0.0, -1.7), Vec2::new(20.0_f32, 0.3));
        for shape in scene.states.iter().flat_map(silhouettes).flatten() {
            let bounds = shape.bounding();
            (min, max) = (min.least(bounds.min), max.most(bounds.max));
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

    pub fn draw(&self, page: &mut Page, scene: &Scene<'_>) {
        if self.scale <= 0.0 {
            return;
        }
        for (i, (state, (kind, name))) in scene.states.iter().zip(STATES).enumerate() {
            let top = self.top + NAME + i as f32 * (NAME + self.strip());
            let view = View {
                corner: self.min,
                at: Vec2::new(MARGIN + SIDE, top + self.strip()),
                scale: self.scale,
            };
            let words = headed(name, ", from the right: matched boxes");
            page.text(Vec2::new(MARGIN + SIDE, top - 8.0), "", words);
            let id = format!("side{i}");
            view.ground(page, &id, self.min, self.max);
            view.upright(page, self.min, self.max, i == 1);
            // The camera's height.
            let ends = [self.min.x, self.max.x].map(|x| view.place(Vec2::new(x, 0.0)));
            line(page, ends, true);
            page.left_of(ends[0], SMALL, "camera");
            page.inside(&id, |page| {
                for [truth, _] in silhouettes(state) {
                    view.outline(page, truth, Kind::Truth);
                }
                for [_, detection] in silhouettes(state) {
                    view.outline(page, detection, kind);
                }
            });
        }
        let foot = self.top + self.height() - FOOT + 33.0;
        let at = Vec2::new(0.5 * (SIDE + WIDTH), foot);
        page.text(at, format_args!("{SMALL} {MIDDLE}"), "forward, metres");
    }
}
