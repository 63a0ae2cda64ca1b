//! The picture: the arm among its obstacles, and its clearance over both joints with its derivatives.
use crate::{Arm, Clearance, Post};
use common::cli::Failure;
use common::file;
use common::svg::{BLUE, END, FAINT, INK, MIDDLE, Page, RED, SMALL};
use geograd::kernels::{Cpu, One};
use geograd::{Error, Obb2, Vec2};
use std::f32::consts::{PI, TAU};
use std::path::Path;

/// The obstacles around the arm.
pub const WALL: Obb2<f32> = Obb2::new(0.85, 1.05, 1.1, 0.24, -0.35);
pub const POST: Post<f32> = Post {
    center: Vec2::new(-0.95, -0.35),
    radius: 0.34,
};

/// The arm with its joints at two angles.
pub fn posture(shoulder: f32, elbow: f32) -> Arm<f32> {
    Arm {
        base: Vec2::new(0.0, 0.0),
        links: [1.0, 0.75],
        shoulder,
        elbow,
        thickness: 0.16,
    }
}

/// The page, in pixels: two square panels side by side.
const PAGE: Vec2<f32> = Vec2::new(1160.0, 668.0);
const SIDE: f32 = 512.0;
const TOP: f32 = 84.0;
const LEFT: [f32; 2] = [30.0, 618.0];

/// The side of the place that the left panel shows, in metres.
const PLACE: f32 = 4.0;
/// Points of the field along each joint.
const POINTS: usize = 241;
/// Arrows along each joint.
const ARROWS: usize = 25;
/// The distance between contours, in metres.
const BAND: f32 = 0.1;
/// Contours below and above zero.
const BANDS: std::ops::RangeInclusive<i32> = -3..=7;

const FRAME: &str = "#ced4da";
const STEEL: &str = "#495057";

/// Values and derivatives at postures.
type Found = (Vec<f32>, Vec<Arm<f32>>);

fn clearances(postures: &[Arm<f32>]) -> Result<Found, Error> {
    let columns = (postures, One(WALL), One(POST));
    let (values, (by_arm, _, _)) = Cpu::new().aligned(Clearance.value_grad(), columns)?;
    Ok((values, by_arm))
}

/// From a posture in the wall along the derivatives to one that is free: joints, one after another.
fn way_out() -> Result<Vec<Vec2<f32>>, Error> {
    let mut way = vec![Vec2::new(0.42, 1.35)];
    for _ in 0..400 {
        let at = way[way.len() - 1];
        let (value, by) = clearances(&[posture(at.x, at.y)])?;
        if value[0] > 0.25 {
            break;
        }
        let derivative = Vec2::new(by[0].shoulder, by[0].elbow);
        way.push(at + derivative * (0.02 / derivative.length().max(0.1)));
    }
    Ok(way)
}

/// A colour between those of a scale; white next to zero.
fn colour(band: i32) -> String {
    let mix = |from: [f32; 3], to: [f32; 3], t: f32| {
        let [r, g, b] = [0, 1, 2].map(|i| (from[i] + (to[i] - from[i]) * t).round());
        format!("rgb({r},{g},{b})")
    };
    if band < 0 {
        let t = (-1 - band) as f32 / -(*BANDS.start() as f32 - 1.0);
        return mix([255.0, 205.0, 178.0], [190.0, 60.0, 40.0], t);
    }
    let t = band as f32 / *BANDS.end() as f32;
    mix([248.0, 250.0, 252.0], [104.0, 166.0, 212.0], t)
}

/// The place of two joint angles on the page.
fn joints(at: Vec2<f32>) -> Vec2<f32> {
    Vec2::new(
        LEFT[1] + (at.x + PI) / TAU * SIDE,
        TOP + SIDE - (at.y + PI) / TAU * SIDE,
    )
}

/// The place of a point on the page.
fn place(at: Vec2<f32>) -> Vec2<f32> {
    let scale = SIDE / PLACE;
    Vec2::new(
        LEFT[0] + SIDE / 2.0 + at.x * scale,
        TOP + SIDE / 2.0 - at.y * scale,
    )
}

/// The field over both joints, row by row, with a frame of far too low numbers around it.
struct Field {
    values: Vec<f32>,
}

impl Field {
    const WIDTH: usize = POINTS + 2;

    fn new() -> Result<Self, Error> {
        let mut values = vec![-1e3; Self::WIDTH * Self::WIDTH];
        let angle = |i: usize| TAU * i as f32 / (POINTS - 1) as f32 - PI;
        let all = (0..POINTS * POINTS).map(|k| posture(angle(k % POINTS), angle(k / POINTS)));
        let (found, _) = clearances(&all.collect::<Vec<_>>())?;
        for (row, found) in values[Self::WIDTH..]
            .chunks_exact_mut(Self::WIDTH)
            .zip(found.chunks_exact(POINTS))
        {
            row[1..=POINTS].copy_from_slice(found);
        }
        Ok(Field { values })
    }

    /// The place at which the field crosses a level between point `k` and its neighbour to the right or above.
    fn crossing(&self, level: f32, k: usize, above: bool) -> Vec2<f32> {
        let step = if above { Self::WIDTH } else { 1 };
        let (from, to) = (self.values[k] - level, self.values[k + step] - level);
        let t = from / (from - to);
        let (i, j) = ((k % Self::WIDTH) as f32, (k / Self::WIDTH) as f32);
        let at = if above {
            Vec2::new(i, j + t)
        } else {
            Vec2::new(i + t, j)
        };
        let angle = |x: f32| TAU * (x - 1.0) / (POINTS - 1) as f32 - PI;
        joints(Vec2::new(angle(at.x), angle(at.y)))
    }

    /// The outlines of where the field exceeds a level (marching squares).
    fn above(&self, level: f32) -> Vec<Vec<Vec2<f32>>> {
        let inside = |k: usize| self.values[k] > level;
        // By the edge through which an outline enters a cell the one by which it leaves it.
        let mut next = vec![usize::MAX; 2 * self.values.len()];
        for k in 0..self.values.len() - Self::WIDTH - 1 {
            let corners = [k, k + 1, k + 1 + Self::WIDTH, k + Self::WIDTH].map(inside);
            let edges = [2 * k, 2 * (k + 1) + 1, 2 * (k + Self::WIDTH), 2 * k + 1];
            for side in 0..4 {
                if corners[side] && !corners[(side + 1) % 4] {
                    let back = (1..4).map(|i| (side + i) % 4);
                    let enters = |i: &usize| !corners[*i] && corners[(i + 1) % 4];
                    next[edges[side]] = back.clone().find(enters).map_or(usize::MAX, |i| edges[i]);
                }
            }
        }
        let mut outlines = Vec::new();
        for start in 0..next.len() {
            let (mut edge, mut outline) = (start, Vec::new());
            while next[edge] != usize::MAX {
                outline.push(self.crossing(level, edge / 2, edge % 2 == 1));
                edge = std::mem::replace(&mut next[edge], usize::MAX);
            }
            outlines.push(outline);
        }
        outlines.retain(|outline| !outline.is_empty());
        outlines
    }
}

/// The arm as two thick lines.
fn arm(page: &mut Page, arm: Arm<f32>, colour: &str, opacity: f32) {
    let links = arm.links();
    let joints = [links[0].from, links[0].to, links[1].to].map(place);
    let width = arm.thickness * SIDE / PLACE;
    let round = r#"stroke-linecap="round" stroke-linejoin="round""#;
    let style = format_args!(
        r#"fill="none" stroke-width="{width:.1}" {round} stroke="{colour}" stroke-opacity="{opacity}""#
    );
    page.strokes([joints], style);
}

/// The left panel: wall, post, and the arm on its way out.
fn scene(page: &mut Page, way: &[Vec2<f32>]) {
    let scale = SIDE / PLACE;
    let style = format_args!(r##"fill="#f8f9fa" stroke="{FRAME}""##);
    page.rect([LEFT[0], TOP, SIDE, SIDE], style);
    let base = place(Vec2::new(0.0, 0.0));
    let style = format_args!(r#"fill="none" stroke="{FRAME}" stroke-dasharray="4 4""#);
    page.circle(base, format_args!("{:.1}", 1.75 * scale), style);
    page.group(format_args!(r#"fill="{STEEL}""#), |page| {
        page.polygon(WALL.corners().map(place), "");
        let radius = format_args!("{:.1}", POST.radius * scale);
        page.circle(place(POST.center), radius, "");
    });
    let (last, steps) = (way.len() - 1, 6);
    for i in 0..=steps {
        let at = way[i * last / steps];
        let (colour, opacity) = match i {
            0 => (RED, 0.85),
            i if i == steps => (BLUE, 0.9),
            _ => (FAINT, 0.22),
        };
        arm(page, posture(at.x, at.y), colour, opacity);
    }
    let style = format_args!(r##"fill="#fff" stroke="{INK}" stroke-width="2""##);
    page.circle(base, 5, style);
}

/// The right panel: the field in bands, its derivatives as arrows, the way.
fn field(page: &mut Page, way: &[Vec2<f32>]) -> Result<(), Error> {
    let (left, foot) = (LEFT[1], TOP + SIDE);
    let square = [left, TOP, SIDE, SIDE];
    let style = format_args!(r#"fill="{}""#, colour(BANDS.start() - 1));
    page.rect(square, style);
    let field = Field::new()?;
    for band in BANDS {
        let outline = match band {
            0 => r##"stroke="#212529" stroke-width="1.8""##,
            _ => r##"stroke="#495057" stroke-opacity="0.18" stroke-width="0.7""##,
        };
        let style = format_args!(r#"fill="{}" {outline}"#, colour(band));
        page.rings(field.above(band as f32 * BAND), style);
    }
    let style = format_args!(
        r#"fill="none" stroke="{INK}" stroke-opacity="0.72" stroke-width="1.1" stroke-linecap="round""#
    );
    page.strokes(arrows()?, style);
    for (stroke, width) in [("#fff", 6.0), (BLUE, 3.0)] {
        let style = format_args!(
            r#"fill="none" stroke="{stroke}" stroke-width="{width}" stroke-linejoin="round""#
        );
        page.polyline(way.iter().map(|&at| joints(at)), style);
    }
    for (at, fill) in [(way[0], RED), (way[way.len() - 1], BLUE)] {
        let style = format_args!(r##"fill="{fill}" stroke="#fff" stroke-width="2""##);
        page.circle(joints(at), 6.5, style);
    }
    page.rect(square, format_args!(r#"fill="none" stroke="{STEEL}""#));
    let style = format!(r#"font-size="12" fill="{FAINT}""#);
    for (i, name) in ["−180°", "−90°", "0°", "90°", "180°"].iter().enumerate() {
        let off = SIDE * i as f32 / 4.0;
        page.below(Vec2::new(left + off, foot), &style, name);
        page.left_of(Vec2::new(left, foot - off), &style, name);
    }
    Ok(())
}

/// The derivatives of the field as arrows: a line and a tip each.
fn arrows() -> Result<Vec<Vec<Vec2<f32>>>, Error> {
    let angle = |i: usize| TAU * (i as f32 + 0.5) / ARROWS as f32 - PI;
    let at = |k: usize| Vec2::new(angle(k % ARROWS), angle(k / ARROWS));
    let count = ARROWS * ARROWS;
    let postures: Vec<_> = (0..count).map(|k| posture(at(k).x, at(k).y)).collect();
    let (_, by_arm) = clearances(&postures)?;
    let mut arrows = Vec::new();
    for (k, by) in by_arm.iter().enumerate() {
        // Up is less on a page.
        let (foot, derivative) = (joints(at(k)), Vec2::new(by.shoulder, -by.elbow));
        let along = derivative * (11.0 / derivative.length().max(0.3).sqrt());
        if derivative.length() < 0.02 {
            continue;
        }
        let (tail, tip) = (foot - along * 0.5, foot + along * 0.5);
        let barb = along * (4.2 / along.length());
        let [p, q] = [1.0, -1.0].map(|side| tip - barb + barb.perp() * (0.55 * side));
        arrows.extend([vec![tail, tip], vec![p, tip, q]]);
    }
    Ok(arrows)
}

/// Draws the legend of the colours.
fn legend(page: &mut Page) {
    let (width, x, y) = (24.0, LEFT[1] + 110.0, TOP + SIDE + 40.0);
    for (i, band) in (BANDS.start() - 1..=*BANDS.end()).enumerate() {
        let at = x + width * i as f32;
        let style = format_args!(r#"fill="{}""#, colour(band));
        page.rect([at, y, width, 12.0], style);
        if band % 2 == 0 && band >= *BANDS.start() {
            let words = format!("{:.1}", band as f32 * BAND).replace('-', "−");
            let style = format_args!("{SMALL} {MIDDLE}");
            page.text(Vec2::new(at, y + 25.0), style, words);
        }
    }
    let style = format_args!(r#"font-size="12" fill="{INK}" {END}"#);
    page.text(Vec2::new(x - 10.0, y + 10.0), style, "clearance in m");
}

/// Draws all of it into a file.
pub fn write(path: &Path) -> Result<String, Failure> {
    file::write(path, &picture()?)?;
    Ok(String::new())
}

/// All of it as SVG.
fn picture() -> Result<String, Error> {
    let way = way_out()?;
    let mut page = Page::new(PAGE, 1, r#"font-family="Helvetica, Arial, sans-serif""#);
    page.paper(r##"fill="#fff""##);
    let title = format_args!(r#"font-size="21" font-weight="bold" fill="{INK}""#);
    let under = format!(r#"font-size="13.5" fill="{FAINT}""#);
    let heading = "Up the derivative of its clearance the arm leaves the wall";
    page.text(Vec2::new(LEFT[0], 38.0), title, heading);
    let words = [
        "the arm at the start (red), on its way, and free (blue)",
        "clearance by shoulder (right) and elbow (up), and its derivatives",
    ];
    for (left, words) in LEFT.into_iter().zip(words) {
        page.text(Vec2::new(left, 66.0), &under, words);
    }
    scene(&mut page, &way);
    field(&mut page, &way)?;
    legend(&mut page);
    Ok(page.finish())
}
