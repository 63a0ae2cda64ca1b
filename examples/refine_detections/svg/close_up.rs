//! Matched pairs from near by.
use super::page::{Kind, MARGIN, Scene, View, WIDTH};
use crate::loss::Space;
use crate::matching::Match;
use crate::model::Seen;
use common::svg::{BLUE, FAINT, GROUND, MIDDLE, ORANGE, Page, SMALL};
use geograd::{Obb2, Rotation2, Vec2, YawBox3};

/// Close-ups in a row under the maps.
pub const CLOSE_UPS: usize = 4;
pub const CLOSE_UP_GAP: f32 = 20.0;
pub const CLOSE_UP_HEIGHT: f32 = 190.0;

/// A matched pair worth a closer look.
pub struct CloseUp {
    truth: Seen,
    before: YawBox3<f32>,
    after: YawBox3<f32>,
    iou: [f32; 2],
}

/// The pairs that improved most, the largest first.
pub fn close_ups(scene: &Scene<'_>) -> Vec<CloseUp> {
    let [first, last] = &scene.states;
    let close_up = |before: &Match| {
        let is_same = |m: &&Match| m.detection == before.detection && m.truth == before.truth;
        let after = last.matches.iter().find(is_same)?;
        Some(CloseUp {
            truth: first.frame.truths[before.truth],
            before: first.frame.detections[before.detection].shape,
            after: last.frame.detections[before.detection].shape,
            iou: [before.iou, after.iou],
        })
    };
    let mut pairs: Vec<CloseUp> = first.matches.iter().filter_map(close_up).collect();
    let gain = |pair: &CloseUp| pair.iou[1] - pair.iou[0];
    pairs.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
    pairs.truncate(CLOSE_UPS);
    pairs
}

/// The three boxes of a pair as flat ones: truth, before, after.
fn flat(pair: &CloseUp, from_side: bool) -> [Obb2<f32>; 3] {
    let all = [pair.truth.shape, pair.before, pair.after];
    if !from_side {
        return all.map(|shape| shape.birds_eye());
    }
    // As seen from the truth's right: along its heading, and up.
    let back = Rotation2::from_angle(pair.truth.shape.heading).inverse();
    all.map(|shape| {
        let along = shape.corners().map(|p| (back * Vec2::new(p.x, p.y)).x);
        let (low, high) = along
            .into_iter()
            .fold((f32::MAX, f32::MIN), |(low, high), x| {
                (low.min(x), high.max(x))
            });
        let (z, height) = (shape.center.z, shape.size.z);
        Obb2::new(low.midpoint(high), z, high - low, height, 0.0)
    })
}

/// A row of close-ups: in space each pair from above and from the side.
pub fn draw(page: &mut Page, top: f32, space: Space, pairs: &[CloseUp]) {
    let sides: &[bool] = match space {
        Space::BirdsEye => &[false],
        Space::Full => &[false, true],
    };
    let each = pairs
        .iter()
        .flat_map(|pair| sides.iter().map(move |&from_side| (pair, from_side)));
    for (i, (pair, from_side)) in each.take(CLOSE_UPS).enumerate() {
        close_up(page, i, top, pair, from_side);
    }
}

fn close_up(page: &mut Page, index: usize, top: f32, pair: &CloseUp, from_side: bool) {
    let count = CLOSE_UPS as f32;
    let width = (WIDTH - 2.0 * MARGIN - (count - 1.0) * CLOSE_UP_GAP) / count;
    let left = MARGIN + index as f32 * (width + CLOSE_UP_GAP);
    let boxes = flat(pair, from_side);
    let (truth, before) = (boxes[0].bounding(), boxes[1].bounding());
    let (min, max) = (truth.min.least(before.min), truth.max.most(before.max));
    // As large as fits with some air around.
    let size = Vec2::new(width, CLOSE_UP_HEIGHT);
    let room = size * 0.74;
    let scale = (room.x / (max.x - min.x)).min(room.y / (max.y - min.y));
    let view = View {
        corner: (min + max) * 0.5 - size * (0.5 / scale),
        at: Vec2::new(left, top + CLOSE_UP_HEIGHT),
        scale,
    };
    let area = [left, top, width, CLOSE_UP_HEIGHT];
    page.rect(area, format_args!(r#"rx="5" {GROUND}"#));
    for (shape, kind) in boxes
        .into_iter()
        .zip([Kind::Truth, Kind::Before, Kind::After])
    {
        match from_side {
            true => view.outline(page, shape, kind),
            false => view.draw(page, shape, kind),
        }
    }
    let bar = if scale > 60.0 { 0.5 } else { 1.0 };
    let foot = Vec2::new(left + 10.0, top + CLOSE_UP_HEIGHT - 10.0);
    page.path(
        format_args!("M{:.1},{:.1}v5h{:.1}v-5", foot.x, foot.y - 5.0, bar * scale),
        format_args!(r#"fill="none" stroke="{FAINT}""#),
    );
    let beside = Vec2::new(foot.x + bar * scale + 6.0, foot.y);
    page.text(beside, SMALL, format_args!("{bar} m"));
    let strong =
        |colour, iou: f32| format!(r#"<tspan fill="{colour}" font-weight="600">{iou:.2}</tspan>"#);
    let words = match from_side {
        true => "the same from its right".into(),
        false => format!(
            "{} at {:.0} m: IoU {} → {}",
            pair.truth.class.name(),
            pair.truth.shape.center.y,
            strong(ORANGE, pair.iou[0]),
            strong(BLUE, pair.iou[1]),
        ),
    };
    let caption = Vec2::new(left + 0.5 * width, top + CLOSE_UP_HEIGHT + 20.0);
    page.text(caption, MIDDLE, words);
}
