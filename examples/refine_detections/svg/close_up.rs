//! Matched pairs from near by.
use super::Scene;
use super::page::{FAINT, Kind, MARGIN, View, WIDTH, text};
use crate::loss::Space;
use crate::model::Seen;
use geograd::{Obb2, Rotation2, Vec2, YawBox3};
use std::fmt::Write as _;

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
    let mut pairs: Vec<CloseUp> = scene
        .matches_before
        .iter()
        .filter_map(|before| {
            let after = scene
                .matches_after
                .iter()
                .find(|m| m.detection == before.detection && m.truth == before.truth)?;
            Some(CloseUp {
                truth: scene.before.truths[before.truth],
                before: scene.before.detections[before.detection].shape,
                after: scene.after.detections[before.detection].shape,
                iou: [before.iou, after.iou],
            })
        })
        .collect();
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
pub fn draw(page: &mut String, top: f32, space: Space, pairs: &[CloseUp]) {
    match space {
        Space::BirdsEye => {
            for (i, pair) in pairs.iter().enumerate() {
                close_up(page, i, top, pair, false);
            }
        }
        Space::Full => {
            for (i, pair) in pairs.iter().take(CLOSE_UPS / 2).enumerate() {
                close_up(page, 2 * i, top, pair, false);
                close_up(page, 2 * i + 1, top, pair, true);
            }
        }
    }
}

fn close_up(page: &mut String, index: usize, top: f32, pair: &CloseUp, from_side: bool) {
    let count = CLOSE_UPS as f32;
    let width = (WIDTH - 2.0 * MARGIN - (count - 1.0) * CLOSE_UP_GAP) / count;
    let left = MARGIN + index as f32 * (width + CLOSE_UP_GAP);
    let [truth_box, before_box, after_box] = flat(pair, from_side);
    let (truth, before) = (truth_box.bounding(), before_box.bounding());
    let (min, max) = (truth.min.least(before.min), truth.max.most(before.max));
    // As large as fits with some air around.
    let room = Vec2::new(width, CLOSE_UP_HEIGHT) * 0.74;
    let scale = (room.x / (max.x - min.x)).min(room.y / (max.y - min.y));
    let middle = (min + max) * 0.5;
    let half = Vec2::new(width, CLOSE_UP_HEIGHT) * (0.5 / scale);
    let view = View {
        corner: middle - half,
        at: Vec2::new(left, top + CLOSE_UP_HEIGHT),
        scale,
    };
    let _ = writeln!(
        page,
        r##"<rect x="{left:.1}" y="{top:.1}" width="{width:.1}" height="{CLOSE_UP_HEIGHT:.1}" rx="5" fill="#fcfcfd" stroke="#ced4da"/>"##
    );
    let boxes = [
        (truth_box, Kind::Truth),
        (before_box, Kind::Before),
        (after_box, Kind::After),
    ];
    for (shape, kind) in boxes {
        match from_side {
            true => view.outline(page, shape, kind),
            false => view.draw(page, shape, kind),
        }
    }
    let bar = if scale > 60.0 { 0.5 } else { 1.0 };
    let (x, y) = (left + 10.0, top + CLOSE_UP_HEIGHT - 10.0);
    let _ = writeln!(
        page,
        r#"<path d="M{x:.1},{:.1}v5h{:.1}v-5" fill="none" stroke="{FAINT}"/>"#,
        y - 5.0,
        bar * scale,
    );
    let small = format!(r#"font-size="11" fill="{FAINT}""#);
    let length = format!("{bar} m");
    text(page, x + bar * scale + 6.0, y, &small, &length);
    let center = pair.truth.shape.center;
    let mut place = format!(
        r##"{} at {:.0} m: IoU <tspan fill="#e8590c" font-weight="600">{:.2}</tspan> → <tspan fill="#1864ab" font-weight="600">{:.2}</tspan>"##,
        pair.truth.class.name(),
        center.y,
        pair.iou[0],
        pair.iou[1],
    );
    if from_side {
        place = "the same from its right".into();
    }
    let caption = top + CLOSE_UP_HEIGHT + 20.0;
    text(
        page,
        left + 0.5 * width,
        caption,
        r#"text-anchor="middle""#,
        &place,
    );
}
