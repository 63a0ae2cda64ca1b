//! The picture: both sensors' boxes from above, before and after, and the way between.
use crate::descent::State;
use crate::scene::{FAR, Scene};
use geograd::{Obb3, Vec2, Vec3};
use std::fmt::Write as _;

/// The page, in pixels: two maps side by side, and two charts below.
const PAGE: Vec2<f64> = Vec2::new(1160.0, 966.0);
const SIDE: f64 = 524.0;
const LEFT: [f64; 2] = [40.0, 606.0];
const TOP: f64 = 116.0;
const CHART: Vec2<f64> = Vec2::new(500.0, 210.0);
const CHART_LEFT: [f64; 2] = [64.0, 630.0];
const CHART_TOP: f64 = 690.0;

const INK: &str = "#212529";
const FAINT: &str = "#868e96";
const FIRST: &str = r##"fill="#b2d8a5" stroke="#5c9a4a" stroke-width="1""##;
const BEFORE: &str = r##"fill="#e8590c" fill-opacity="0.10" stroke="#e8590c" stroke-width="1.5""##;
const AFTER: &str = r##"fill="#1864ab" fill-opacity="0.10" stroke="#1864ab" stroke-width="1.5""##;
const ALONE: &str = r##"fill="none" stroke="#868e96" stroke-width="1.2" stroke-dasharray="4 3""##;

/// The place on a map of a point in the first sensor's coordinates.
fn place(left: f64, at: Vec3<f64>) -> Vec2<f64> {
    let scale = SIDE / (2.0 * FAR + 6.0);
    let middle = 0.5 * SIDE;
    Vec2::new(left + middle + at.x * scale, TOP + middle - at.y * scale)
}

/// A box from above: the face that looks up most.
fn draw(page: &mut String, left: f64, shape: Obb3<f64>, style: &str) {
    let corners = shape.corners();
    let ring = [4, 5, 7, 6].map(|k| place(left, corners[k]));
    let points = ring.map(|p| format!("{:.1},{:.1}", p.x, p.y)).join(" ");
    let _ = writeln!(page, r#"<polygon points="{points}" {style}/>"#);
}

fn text(page: &mut String, at: Vec2<f64>, style: &str, words: &str) {
    let (x, y) = (at.x, at.y);
    let _ = writeln!(
        page,
        r#"<text x="{x:.1}" y="{y:.1}" {style}>{words}</text>"#
    );
}

/// One map: the first sensor's boxes, and those of the second as a motion places them.
fn map(page: &mut String, k: usize, scene: &Scene, state: &State, style: &str, name: &str) {
    let left = LEFT[k];
    let _ = writeln!(
        page,
        r##"<clipPath id="map{k}"><rect x="{left}" y="{TOP}" width="{SIDE}" height="{SIDE}"/></clipPath>
<rect x="{left}" y="{TOP}" width="{SIDE}" height="{SIDE}" fill="#fcfcfd" stroke="#ced4da"/>
<g clip-path="url(#map{k})">"##
    );
    for ring in [10.0, 20.0, 30.0, 40.0] {
        let center = place(left, Vec3::zero());
        let edge = place(left, Vec3::new(ring, 0.0, 0.0));
        let radius = edge.x - center.x;
        let _ = writeln!(
            page,
            r##"<circle cx="{:.1}" cy="{:.1}" r="{radius:.1}" fill="none" stroke="#e9ecef"/>"##,
            center.x, center.y,
        );
        let at = Vec2::new(center.x + 0.71 * radius, center.y + 0.71 * radius);
        let small = format!(r#"font-size="11" fill="{FAINT}""#);
        text(page, at, &small, &format!("{ring:.0} m"));
    }
    // A box that overlaps another one is joined to it.
    let overlaps = |pair: &&geograd::suppression::Pair<f64>| pair.overlap > 0.0;
    let mut is_joined = vec![false; scene.b.len()];
    for pair in state.pairs.iter().filter(overlaps) {
        is_joined[pair.second] = true;
    }
    let seen: Vec<_> = scene
        .b
        .iter()
        .map(|&shape| state.a_from_b * shape)
        .collect();
    for &shape in &scene.a {
        draw(page, left, shape, FIRST);
    }
    for (&shape, joined) in seen.iter().zip(is_joined) {
        let loose = if k == 0 { style } else { ALONE };
        draw(page, left, shape, if joined { style } else { loose });
    }
    page.push_str("</g>\n");
    // The sensors: a from its own place, b from where the motion puts it.
    let sensors = [
        (Vec3::zero(), "#5c9a4a"),
        (
            state.a_from_b.translation,
            if k == 0 { "#e8590c" } else { "#1864ab" },
        ),
    ];
    for (at, color) in sensors {
        let p = place(left, at);
        let _ = writeln!(
            page,
            r#"<circle cx="{:.1}" cy="{:.1}" r="4" fill="{color}"/>"#,
            p.x, p.y
        );
    }
    let words = format!(
        r##"<tspan font-weight="600">{name}</tspan><tspan fill="{FAINT}">: off by {:.2}° and {:.3} m, mean IoU {:.3}</tspan>"##,
        state.angle_error.to_degrees(),
        state.shift_error,
        state.iou,
    );
    text(page, Vec2::new(left, TOP - 10.0), "", &words);
}

/// A line of a chart: its name, its colour and its numbers.
type Line<'a> = (&'a str, &'a str, Vec<f64>);

/// A chart over the iterations, of numbers between `low` and `high`, each at a tick of `ticks`.
fn chart(page: &mut String, k: usize, ticks: &[f64], is_log: bool, lines: &[Line<'_>]) {
    let left = CHART_LEFT[k];
    let (Some(&low), Some(&high)) = (ticks.first(), ticks.last()) else {
        return;
    };
    let share = |x: f64| match is_log {
        true => (x.max(low).min(high) / low).ln() / (high / low).ln(),
        false => (x.clamp(low, high) - low) / (high - low),
    };
    let up = |x: f64| CHART_TOP + CHART.y * (1.0 - share(x));
    let _ = writeln!(
        page,
        r##"<rect x="{left}" y="{CHART_TOP}" width="{}" height="{}" fill="#fcfcfd" stroke="#ced4da"/>"##,
        CHART.x, CHART.y
    );
    let small = format!(r#"font-size="11" fill="{FAINT}""#);
    for &tick in ticks {
        let y = up(tick);
        let _ = writeln!(
            page,
            r##"<path d="M{left},{y:.1}h{}" stroke="#e9ecef"/>"##,
            CHART.x
        );
        let end = format!(r#"{small} text-anchor="end""#);
        text(
            page,
            Vec2::new(left - 7.0, y + 4.0),
            &end,
            &tick.to_string(),
        );
    }
    let mut x_name = left;
    for (name, color, numbers) in lines {
        let steps = (numbers.len() - 1).max(1) as f64;
        let points: Vec<_> = numbers
            .iter()
            .enumerate()
            .map(|(i, &x)| format!("{:.1},{:.1}", left + CHART.x * i as f64 / steps, up(x)))
            .collect();
        let points = points.join(" ");
        let _ = writeln!(
            page,
            r#"<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.8" stroke-linejoin="round"/>"#
        );
        let at = Vec2::new(x_name, CHART_TOP - 10.0);
        text(
            page,
            at,
            &format!(r#"fill="{color}" font-weight="600""#),
            name,
        );
        x_name += 8.2 * name.chars().count() as f64 + 22.0;
    }
    let last = lines.first().map_or(0, |line| line.2.len() - 1);
    let middle = format!(r#"{small} text-anchor="middle""#);
    for part in 0..=3 {
        let at = left + CHART.x * f64::from(part) / 3.0;
        let foot = CHART_TOP + CHART.y + 17.0;
        let words = (last * part as usize / 3).to_string();
        text(page, Vec2::new(at, foot), &middle, &words);
    }
    let foot = Vec2::new(left + 0.5 * CHART.x, CHART_TOP + CHART.y + 36.0);
    text(page, foot, &middle, "iteration");
}

/// The picture.
pub fn picture(scene: &Scene, states: &[State]) -> String {
    let (Some(first), Some(last)) = (states.first(), states.last()) else {
        return String::new();
    };
    let mut page = String::new();
    let (width, height) = (PAGE.x, PAGE.y);
    let _ = writeln!(
        page,
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" font-family="Inter, 'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif" font-size="13" fill="{INK}">
<title>The motion between two sensors, from the overlap of their boxes</title>
<rect width="{width}" height="{height}" rx="10" fill="#fff"/>"##
    );
    let title = "The motion between two sensors, found by descent on the overlap of their boxes";
    let style = r#"font-size="21" font-weight="600""#;
    text(&mut page, Vec2::new(LEFT[0], 44.0), style, title);
    let mut x = LEFT[0];
    for (style, name) in [
        (FIRST, "first sensor"),
        (BEFORE, "second sensor, as guessed"),
        (AFTER, "second sensor, as found"),
        (ALONE, "overlaps nothing"),
    ] {
        let _ = writeln!(
            page,
            r#"<rect x="{x:.1}" y="61" width="24" height="12" {style}/>"#
        );
        text(&mut page, Vec2::new(x + 32.0, 71.5), "", name);
        x += 32.0 + 7.1 * name.len() as f64 + 24.0;
    }
    map(&mut page, 0, scene, first, BEFORE, "Before");
    map(&mut page, 1, scene, last, AFTER, "After");
    let of = |number: fn(&State) -> f64| states.iter().map(number).collect::<Vec<_>>();
    let overlap = [
        ("loss", "#e8590c", of(|state| state.loss)),
        ("mean IoU", "#1864ab", of(|state| state.iou)),
    ];
    chart(
        &mut page,
        0,
        &[0.0, 0.25, 0.5, 0.75, 1.0, 1.25],
        false,
        &overlap,
    );
    let errors = [
        (
            "angle error, degrees",
            "#862e9c",
            of(|state| state.angle_error.to_degrees()),
        ),
        (
            "shift error, metres",
            "#2b8a3e",
            of(|state| state.shift_error),
        ),
    ];
    chart(&mut page, 1, &[0.001, 0.01, 0.1, 1.0, 10.0], true, &errors);
    page.push_str("</svg>\n");
    page
}
