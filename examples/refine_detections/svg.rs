//! A bird's-eye view of one frame before and after, as a picture.
use crate::matching::Match;
use crate::model::{Frame, Seen};
use geograd::{Obb2, Vec2};
use std::fmt::Write as _;

/// The page, in pixels.
const WIDTH: f32 = 1160.0;
const MARGIN: f32 = 30.0;
const GAP: f32 = 70.0;
const HEAD: f32 = 116.0;
/// Left of and below a map, for its numbers.
const SIDE: f32 = 40.0;
const FOOT: f32 = 44.0;

/// Close-ups in a row under the maps.
const CLOSE_UPS: usize = 4;
const CLOSE_UP_GAP: f32 = 20.0;
const CLOSE_UP_HEIGHT: f32 = 190.0;

const INK: &str = "#212529";
const FAINT: &str = "#868e96";

/// The kinds of boxes and their looks.
#[derive(Clone, Copy)]
enum Kind {
    Truth,
    Missed,
    Before,
    After,
    Unmatched,
}

impl Kind {
    fn style(self) -> &'static str {
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

    fn name(self) -> &'static str {
        match self {
            Kind::Truth => "ground truth",
            Kind::Missed => "ground truth, not detected",
            Kind::Before => "detection, before",
            Kind::After => "detection, after",
            Kind::Unmatched => "detection of nothing",
        }
    }
}

/// One frame with its detections before and after, and their matches.
pub struct Scene<'a> {
    pub number: u32,
    pub before: &'a Frame,
    pub after: &'a Frame,
    pub matches_before: &'a [Match],
    pub matches_after: &'a [Match],
}

/// Where metres lie on the page.
#[derive(Clone, Copy)]
struct View {
    /// The lower left corner, in metres and on the page.
    corner: Vec2<f32>,
    at: Vec2<f32>,
    /// Pixels per metre.
    scale: f32,
}

impl View {
    fn place(self, point: Vec2<f32>) -> Vec2<f32> {
        let off = (point - self.corner) * self.scale;
        Vec2::new(self.at.x + off.x, self.at.y - off.y)
    }

    fn draw(self, page: &mut String, shape: Obb2<f32>, kind: Kind) {
        let corners = shape.corners().map(|corner| self.place(corner));
        let points: Vec<_> = corners
            .iter()
            .map(|p| format!("{:.1},{:.1}", p.x, p.y))
            .collect();
        let style = kind.style();
        let _ = writeln!(page, r#"<polygon points="{}" {style}/>"#, points.join(" "));
        // From the centre to the front, where there is room for it.
        if shape.size.x * self.scale > 14.0 {
            let front = corners[1].lerp(corners[2], 0.5);
            let center = self.place(shape.center);
            let _ = writeln!(
                page,
                r#"<path d="M{:.1},{:.1}L{:.1},{:.1}" {style}/>"#,
                center.x, center.y, front.x, front.y,
            );
        }
    }
}

/// The part of the plane that a map shows.
struct Extent {
    min: Vec2<f32>,
    max: Vec2<f32>,
}

impl Extent {
    /// All boxes and the camera, out to the next five metres.
    fn of<'a>(shapes: impl Iterator<Item = &'a Seen>) -> Self {
        let (mut min, mut max) = (Vec2::new(-9.0, 1.0), Vec2::new(9.0_f32, 19.0));
        for seen in shapes {
            let bounds = seen.shape.bounding();
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

    fn size(&self) -> Vec2<f32> {
        self.max - self.min
    }
}

fn text(page: &mut String, x: f32, y: f32, style: &str, words: &str) {
    let _ = writeln!(
        page,
        r#"<text x="{x:.1}" y="{y:.1}" {style}>{words}</text>"#
    );
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
    let strip = HEAD + map_height + FOOT;
    let height = if close_ups.is_empty() {
        strip + MARGIN
    } else {
        strip + 44.0 + CLOSE_UP_HEIGHT + 28.0 + MARGIN
    };

    let mut page = String::new();
    let _ = writeln!(
        page,
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:.0} {height:.0}" width="{WIDTH:.0}" height="{height:.0}" font-family="Inter, 'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif" font-size="13" fill="{INK}">
<title>Detections before and after gradient descent on 1 − IoU</title>
<rect width="{WIDTH:.0}" height="{height:.0}" rx="10" fill="#fff"/>"##
    );
    text(
        &mut page,
        MARGIN,
        44.0,
        r#"font-size="21" font-weight="600""#,
        "Detections moved onto their ground truth by the gradient of their overlap",
    );
    legend(&mut page);
    let sides = [
        (Kind::Before, before, scene.matches_before, "Before"),
        (Kind::After, after, scene.matches_after, "After"),
    ];
    for (i, (kind, frame, matches, name)) in sides.into_iter().enumerate() {
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
    if !close_ups.is_empty() {
        text(
            &mut page,
            MARGIN,
            strip + 26.0,
            r#"font-weight="600""#,
            "Close-ups of the largest improvements",
        );
        for (i, pair) in close_ups.iter().enumerate() {
            close_up(&mut page, i, strip + 44.0, pair);
        }
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

/// Lines every ten metres with their numbers, the frame of the map, and the camera.
fn grid(page: &mut String, view: View, extent: &Extent, index: usize) {
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

fn metres(ten: i32) -> String {
    format!("{}{}", if ten < 0 { "−" } else { "" }, 10 * ten.abs())
}

fn line(page: &mut String, from: Vec2<f32>, to: Vec2<f32>, strong: bool) {
    let color = if strong { "#ced4da" } else { "#e9ecef" };
    let _ = writeln!(
        page,
        r#"<path d="M{:.1},{:.1}L{:.1},{:.1}" stroke="{color}"/>"#,
        from.x, from.y, to.x, to.y,
    );
}

/// All boxes of a frame: truths below, what belongs to nothing next, matched detections on top.
fn map(page: &mut String, view: View, kind: Kind, frame: &Frame, matches: &[Match]) {
    for (i, truth) in frame.truths.iter().enumerate() {
        let found = matches.iter().any(|m| m.truth == i);
        let kind = if found { Kind::Truth } else { Kind::Missed };
        view.draw(page, truth.shape, kind);
    }
    let is_matched = |i: usize| matches.iter().any(|m| m.detection == i);
    for pass in [false, true] {
        for (i, detection) in frame.detections.iter().enumerate() {
            if is_matched(i) == pass {
                let kind = if pass { kind } else { Kind::Unmatched };
                view.draw(page, detection.shape, kind);
            }
        }
    }
}

/// A matched pair worth a closer look.
struct CloseUp {
    truth: Seen,
    before: Obb2<f32>,
    after: Obb2<f32>,
    iou: [f32; 2],
}

/// The pairs that improved most, the largest first.
fn close_ups(scene: &Scene<'_>) -> Vec<CloseUp> {
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

fn close_up(page: &mut String, index: usize, top: f32, pair: &CloseUp) {
    let count = CLOSE_UPS as f32;
    let width = (WIDTH - 2.0 * MARGIN - (count - 1.0) * CLOSE_UP_GAP) / count;
    let left = MARGIN + index as f32 * (width + CLOSE_UP_GAP);
    let (truth, before) = (pair.truth.shape.bounding(), pair.before.bounding());
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
    view.draw(page, pair.truth.shape, Kind::Truth);
    view.draw(page, pair.before, Kind::Before);
    view.draw(page, pair.after, Kind::After);
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
    let place = format!(
        r##"{} at {:.0} m: IoU <tspan fill="#e8590c" font-weight="600">{:.2}</tspan> → <tspan fill="#1864ab" font-weight="600">{:.2}</tspan>"##,
        pair.truth.class.name(),
        center.y,
        pair.iou[0],
        pair.iou[1],
    );
    let caption = top + CLOSE_UP_HEIGHT + 20.0;
    text(
        page,
        left + 0.5 * width,
        caption,
        r#"text-anchor="middle""#,
        &place,
    );
}
