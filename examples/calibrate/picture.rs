//! The picture: both sensors' boxes from above, before and after, and the way between.
use crate::descent::State;
use crate::scene::{FAR, Scene};
use common::svg::{BLUE, GROUND, MIDDLE, ORANGE, Page, SMALL, headed};
use geograd::{Obb3, Vec2, Vec3};

/// The page, in pixels: two maps side by side, and two charts below.
const PAGE: Vec2<f64> = Vec2::new(1160.0, 966.0);
const SIDE: f64 = 524.0;
const LEFT: [f64; 2] = [40.0, 606.0];
const TOP: f64 = 116.0;
const CHART: Vec2<f64> = Vec2::new(500.0, 210.0);
const CHART_LEFT: [f64; 2] = [64.0, 630.0];
const CHART_TOP: f64 = 690.0;

/// The colours of the first sensor, and of lines to read numbers by.
const GREEN: &str = "#5c9a4a";
const RULE: &str = "#e9ecef";

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
fn draw(page: &mut Page, left: f64, shape: Obb3<f64>, style: &str) {
    let corners = shape.corners();
    page.polygon([4, 5, 7, 6].map(|k| place(left, corners[k])), style);
}

/// One map: the first sensor's boxes, and those of the second as a motion places them.
fn map(page: &mut Page, k: usize, scene: &Scene, state: &State) {
    let (left, name) = (LEFT[k], ["Before", "After"][k]);
    let (style, color, loose) = [(BEFORE, ORANGE, BEFORE), (AFTER, BLUE, ALONE)][k];
    let id = format!("map{k}");
    page.ground(&id, [left, TOP, SIDE, SIDE]);
    page.inside(&id, |page| {
        let center = place(left, Vec3::zero());
        for ring in [10.0, 20.0, 30.0, 40.0] {
            let radius = place(left, Vec3::new(ring, 0.0, 0.0)).x - center.x;
            let style = format_args!(r#"fill="none" stroke="{RULE}""#);
            page.circle(center, format_args!("{radius:.1}"), style);
            let at = center + Vec2::new(0.71 * radius, 0.71 * radius);
            page.text(at, SMALL, format_args!("{ring:.0} m"));
        }
        for &shape in &scene.a {
            draw(page, left, shape, FIRST);
        }
        // A box that overlaps another one is joined to it.
        let overlaps = |pair: &&geograd::suppression::Pair<f64>| pair.overlap > 0.0;
        let mut styles = vec![loose; scene.b.len()];
        for pair in state.pairs.iter().filter(overlaps) {
            styles[pair.second] = style;
        }
        for (&shape, style) in scene.b.iter().zip(styles) {
            draw(page, left, state.a_from_b * shape, style);
        }
    });
    // The sensors: a from its own place, b from where the motion puts it.
    for (at, color) in [(Vec3::zero(), GREEN), (state.a_from_b.translation, color)] {
        page.circle(place(left, at), 4, format_args!(r#"fill="{color}""#));
    }
    let words = format!(
        ": off by {:.2}° and {:.3} m, mean IoU {:.3}",
        state.angle_error.to_degrees(),
        state.shift_error,
        state.iou,
    );
    page.text(Vec2::new(left, TOP - 10.0), "", headed(name, words));
}

/// A line of a chart: its name, its colour and its numbers.
type Line<'a> = (&'a str, &'a str, Vec<f64>);

/// A chart over the iterations, of numbers between `low` and `high`, each at a tick of `ticks`.
fn chart(page: &mut Page, k: usize, ticks: &[f64], is_log: bool, lines: &[Line<'_>]) {
    let left = CHART_LEFT[k];
    let (Some(&low), Some(&high)) = (ticks.first(), ticks.last()) else {
        return;
    };
    let share = |x: f64| match is_log {
        true => (x.max(low).min(high) / low).ln() / (high / low).ln(),
        false => (x.clamp(low, high) - low) / (high - low),
    };
    let up = |x: f64| CHART_TOP + CHART.y * (1.0 - share(x));
    page.rect([left, CHART_TOP, CHART.x, CHART.y], GROUND);
    for &tick in ticks {
        let from = Vec2::new(left, up(tick));
        let to = Vec2::new(left + CHART.x, from.y);
        page.strokes([[from, to]], format_args!(r#"stroke="{RULE}""#));
        page.left_of(from, SMALL, tick);
    }
    let mut x_name = left;
    for (name, color, numbers) in lines {
        let steps = (numbers.len() - 1).max(1) as f64;
        let points = numbers
            .iter()
            .enumerate()
            .map(|(i, &x)| Vec2::new(left + CHART.x * i as f64 / steps, up(x)));
        page.polyline(
            points,
            format_args!(
                r#"fill="none" stroke="{color}" stroke-width="1.8" stroke-linejoin="round""#
            ),
        );
        let at = Vec2::new(x_name, CHART_TOP - 10.0);
        let style = format_args!(r#"fill="{color}" font-weight="600""#);
        page.text(at, style, name);
        x_name += 8.2 * name.chars().count() as f64 + 22.0;
    }
    let last = lines.first().map_or(0, |line| line.2.len() - 1);
    for part in 0..=3 {
        let at = left + CHART.x * f64::from(part) / 3.0;
        let foot = Vec2::new(at, CHART_TOP + CHART.y);
        page.below(foot, SMALL, last * part as usize / 3);
    }
    let foot = Vec2::new(left + 0.5 * CHART.x, CHART_TOP + CHART.y + 36.0);
    page.text(foot, format_args!("{SMALL} {MIDDLE}"), "iteration");
}

/// The picture.
pub fn picture(scene: &Scene, states: &[State]) -> String {
    let (Some(first), Some(last)) = (states.first(), states.last()) else {
        return String::new();
    };
    let title = "The motion between two sensors, from the overlap of their boxes";
    let mut page = Page::titled(PAGE, title);
    let heading = "The motion between two sensors, found by descent on the overlap of their boxes";
    let legend = [
        (FIRST, "first sensor"),
        (BEFORE, "second sensor, as guessed"),
        (AFTER, "second sensor, as found"),
        (ALONE, "overlaps nothing"),
    ];
    page.head(LEFT[0], heading, legend);
    map(&mut page, 0, scene, first);
    map(&mut page, 1, scene, last);
    let of = |number: fn(&State) -> f64| states.iter().map(number).collect::<Vec<_>>();
    let overlap = [
        ("loss", ORANGE, of(|state| state.loss)),
        ("mean IoU", BLUE, of(|state| state.iou)),
    ];
    let ticks = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25];
    chart(&mut page, 0, &ticks, false, &overlap);
    let angles = of(|state| state.angle_error.to_degrees());
    let errors = [
        ("angle error, degrees", "#862e9c", angles),
        (
            "shift error, metres",
            "#2b8a3e",
            of(|state| state.shift_error),
        ),
    ];
    chart(&mut page, 1, &[0.001, 0.01, 0.1, 1.0, 10.0], true, &errors);
    page.finish()
}
