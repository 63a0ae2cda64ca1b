//! One frame before and after, seen from above and from the side, as a picture.
mod above;
mod close_up;
mod page;
mod side;

use crate::loss::{Loss, Space};
use above::{Extent, grid, map};
use close_up::{CLOSE_UP_HEIGHT, close_ups};
use common::svg::{Page, headed};
use geograd::Vec2;
use page::{FOOT, GAP, HEAD, Kind, MARGIN, SIDE, STATES, View, WIDTH};
pub use page::{Scene, State};

/// The picture.
pub fn picture(scene: &Scene<'_>) -> String {
    let [before, after] = scene.states.map(|state| state.frame);
    let all = before.truths.iter().chain(&before.detections);
    let extent = Extent::of(all.chain(&after.detections));
    let map_width = (WIDTH - 2.0 * MARGIN - GAP) / 2.0 - SIDE;
    let scale = map_width / extent.size().x;
    let map_height = scale * extent.size().y;
    let close_ups = close_ups(scene);
    let below = HEAD + map_height + FOOT;
    let sides = side::Strips::of(scene, below);
    let strip = below + sides.height();
    let height = if close_ups.is_empty() {
        strip + MARGIN
    } else {
        strip + 44.0 + CLOSE_UP_HEIGHT + 28.0 + MARGIN
    };

    let score = scene.goal.loss.title();
    let title = match scene.goal.loss {
        Loss::Gwd | Loss::Kld => format!("1 − 1/(1 + ln(1 + {score}))"),
        _ => format!("1 − {score}"),
    };
    let by = match (scene.goal.loss, scene.goal.space) {
        (Loss::Iou, Space::BirdsEye) => "their overlap".to_string(),
        (Loss::Iou, Space::Full) => "their overlap in space".to_string(),
        (_, Space::BirdsEye) => format!("{score} seen from above"),
        (_, Space::Full) => format!("{score} in space"),
    };
    let title = format!("Detections before and after gradient descent on {title}");
    let mut page = Page::titled(Vec2::new(WIDTH, height), title);
    let heading = format!("Detections moved onto their ground truth by the gradient of {by}");
    let legend = Kind::ALL.map(|kind| (kind.style(), kind.name()));
    page.head(MARGIN, heading, legend);
    for (i, (state, (kind, name))) in scene.states.into_iter().zip(STATES).enumerate() {
        let left = MARGIN + SIDE + i as f32 * (map_width + SIDE + GAP);
        let view = View {
            corner: extent.min,
            at: Vec2::new(left, HEAD + map_height),
            scale,
        };
        let (id, count) = (format!("map{i}"), state.matches.len());
        grid(&mut page, view, &extent, &id);
        let sum = state.matches.iter().map(|m| m.iou).sum::<f32>();
        let words = format!(
            ": frame {}, {count} matches, mean IoU {:.4}",
            scene.number,
            sum / count.max(1) as f32
        );
        page.text(Vec2::new(left, HEAD - 9.0), "", headed(name, words));
        page.inside(&id, |page| map(page, view, kind, state));
    }
    sides.draw(&mut page, scene);
    if !close_ups.is_empty() {
        let words = match scene.goal.space {
            Space::BirdsEye => "Close-ups of the largest improvements",
            Space::Full => "Close-ups of the largest improvements, from above and from the right",
        };
        let at = Vec2::new(MARGIN, strip + 26.0);
        page.text(at, r#"font-weight="600""#, words);
        close_up::draw(&mut page, strip + 44.0, scene.goal.space, &close_ups);
    }
    page.finish()
}
