//! One frame before and after, seen from above and from the side, as a picture.
mod above;
mod close_up;
mod page;
mod side;

use crate::loss::{Goal, Loss, Space};
use crate::matching::Match;
use crate::model::Frame;
use above::{Extent, grid, map};
use close_up::{CLOSE_UP_HEIGHT, close_ups};
use geograd::Vec2;
use page::{FAINT, FOOT, GAP, HEAD, INK, Kind, MARGIN, SIDE, View, WIDTH, text};
use std::fmt::Write as _;

/// One frame with its detections before and after, and their matches.
pub struct Scene<'a> {
    pub number: u32,
    pub before: &'a Frame,
    pub after: &'a Frame,
    pub matches_before: &'a [Match],
    pub matches_after: &'a [Match],
    pub goal: Goal,
}

/// The picture.
pub fn picture(scene: &Scene<'_>) -> String {
    let (before, after) = (scene.before, scene.after);
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
    let mut page = String::new();
    let _ = writeln!(
        page,
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:.0} {height:.0}" width="{WIDTH:.0}" height="{height:.0}" font-family="Inter, 'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif" font-size="13" fill="{INK}">
<title>Detections before and after gradient descent on {title}</title>
<rect width="{WIDTH:.0}" height="{height:.0}" rx="10" fill="#fff"/>"##
    );
    text(
        &mut page,
        MARGIN,
        44.0,
        r#"font-size="21" font-weight="600""#,
        &format!("Detections moved onto their ground truth by the gradient of {by}"),
    );
    legend(&mut page);
    let states = [
        (Kind::Before, before, scene.matches_before, "Before"),
        (Kind::After, after, scene.matches_after, "After"),
    ];
    for (i, (kind, frame, matches, name)) in states.into_iter().enumerate() {
        let left = MARGIN + SIDE + i as f32 * (map_width + SIDE + GAP);
        let view = View {
            corner: extent.min,
            at: Vec2::new(left, HEAD + map_height),
            scale,
        };
        grid(&mut page, view, &extent, i);
        let mean = matches.iter().map(|m| m.iou).sum::<f32>() / matches.len().max(1) as f32;
        text(
            &mut page,
            left,
            HEAD - 9.0,
            "",
            &format!(
                r##"<tspan font-weight="600">{name}</tspan><tspan fill="{FAINT}">: frame {}, {} matches, mean IoU {mean:.4}</tspan>"##,
                scene.number,
                matches.len(),
            ),
        );
        let _ = writeln!(page, r#"<g clip-path="url(#map{i})">"#);
        map(&mut page, view, kind, frame, matches);
        page.push_str("</g>\n");
    }
    sides.draw(&mut page, scene);
    if !close_ups.is_empty() {
        let words = match scene.goal.space {
            Space::BirdsEye => "Close-ups of the largest improvements",
            Space::Full => "Close-ups of the largest improvements, from above and from the right",
        };
        let style = r#"font-weight="600""#;
        text(&mut page, MARGIN, strip + 26.0, style, words);
        close_up::draw(&mut page, strip + 44.0, scene.goal.space, &close_ups);
    }
    page.push_str("</svg>\n");
    page
}

fn legend(page: &mut String) {
    let mut x = MARGIN;
    for kind in [
        Kind::Truth,
        Kind::Missed,
        Kind::Before,
        Kind::After,
        Kind::Unmatched,
    ] {
        let _ = writeln!(
            page,
            r#"<rect x="{x:.1}" y="61" width="24" height="12" {}/>"#,
            kind.style()
        );
        text(page, x + 32.0, 71.5, "", kind.name());
        x += 32.0 + 7.1 * kind.name().len() as f32 + 24.0;
    }
}
