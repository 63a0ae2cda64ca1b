//! The picture: the arm among its obstacles, and its clearance over both joints with its derivatives.
use crate::{Arm, Clearance, Post};
use common::cli::Failure;
use geograd::kernels::{Cpu, One};
use geograd::{Error, Obb2, Vec2};
use std::f32::consts::{PI, TAU};
use std::ffi::OsStr;
use std::fmt::Write as _;

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

const INK: &str = "#212529";
const FAINT: &str = "#868e96";
const START: &str = "#c92a2a";
const END: &str = "#1864ab";

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

    /// The outlines of where the field exceeds a level, as a path (marching squares).
    fn above(&self, level: f32) -> String {
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
        let mut path = String::new();
        for start in 0..next.len() {
            let (mut edge, mut pen) = (start, 'M');
            while next[edge] != usize::MAX {
                let p = self.crossing(level, edge / 2, edge % 2 == 1);
                let _ = write!(path, "{pen}{:.1},{:.1}", p.x, p.y);
                edge = std::mem::replace(&mut next[edge], usize::MAX);
                pen = 'L';
            }
            if pen == 'L' {
                path.push('Z');
            }
        }
        path
    }
}

fn text(page: &mut String, at: (f32, f32), style: &str, words: &str) {
    let _ = writeln!(
        page,
        r#"<text x="{:.1}" y="{:.1}" {style}>{words}</text>"#,
        at.0, at.1
    );
}

/// The arm as two thick lines.
fn arm(page: &mut String, arm: Arm<f32>, style: &str) {
    let scale = SIDE / PLACE;
    let links = arm.links();
    let [a, b, c] = [links[0].from, links[0].to, links[1].to].map(place);
    let _ = writeln!(
        page,
        r#"<path d="M{:.1},{:.1}L{:.1},{:.1}L{:.1},{:.1}" fill="none" stroke-width="{:.1}" stroke-linecap="round" stroke-linejoin="round" {style}/>"#,
        a.x,
        a.y,
        b.x,
        b.y,
        c.x,
        c.y,
        arm.thickness * scale
    );
}

/// The left panel: wall, post, and the arm on its way out.
fn scene(page: &mut String, way: &[Vec2<f32>]) {
    let (scale, left) = (SIDE / PLACE, LEFT[0]);
    let _ = writeln!(
        page,
        r##"<rect x="{left}" y="{TOP}" width="{SIDE}" height="{SIDE}" fill="#f8f9fa" stroke="#ced4da"/>"##
    );
    let reach = place(Vec2::new(0.0, 0.0));
    let _ = writeln!(
        page,
        r##"<circle cx="{}" cy="{}" r="{:.1}" fill="none" stroke="#ced4da" stroke-dasharray="4 4"/>"##,
        reach.x,
        reach.y,
        1.75 * scale
    );
    let corners = WALL.corners().map(place);
    let points: Vec<_> = corners
        .iter()
        .map(|p| format!("{:.1},{:.1}", p.x, p.y))
        .collect();
    let post = place(POST.center);
    let _ = writeln!(
        page,
        r##"<g fill="#495057"><polygon points="{}"/><circle cx="{:.1}" cy="{:.1}" r="{:.1}"/></g>"##,
        points.join(" "),
        post.x,
        post.y,
        POST.radius * scale
    );
    let last = way.len() - 1;
    let steps = 6;
    for i in 0..=steps {
        let at = way[i * last / steps];
        let style = match i {
            0 => format!(r#"stroke="{START}" stroke-opacity="0.85""#),
            i if i == steps => format!(r#"stroke="{END}" stroke-opacity="0.9""#),
            _ => format!(r#"stroke="{FAINT}" stroke-opacity="0.22""#),
        };
        arm(page, posture(at.x, at.y), &style);
    }
    let _ = writeln!(
        page,
        r##"<circle cx="{}" cy="{}" r="5" fill="#fff" stroke="{INK}" stroke-width="2"/>"##,
        reach.x, reach.y
    );
}

/// The right panel: the field in bands, its derivatives as arrows, the way.
fn field(page: &mut String, way: &[Vec2<f32>]) -> Result<(), Error> {
    let left = LEFT[1];
    let _ = writeln!(
        page,
        r#"<rect x="{left}" y="{TOP}" width="{SIDE}" height="{SIDE}" fill="{}"/>"#,
        colour(BANDS.start() - 1)
    );
    let field = Field::new()?;
    for band in BANDS {
        let outline = match band {
            0 => format!(r#"stroke="{INK}" stroke-width="1.8""#),
            _ => r##"stroke="#495057" stroke-opacity="0.18" stroke-width="0.7""##.into(),
        };
        let d = field.above(band as f32 * BAND);
        let _ = writeln!(page, r#"<path d="{d}" fill="{}" {outline}/>"#, colour(band));
    }
    let angle = |i: usize| TAU * (i as f32 + 0.5) / ARROWS as f32 - PI;
    let at = |k: usize| Vec2::new(angle(k % ARROWS), angle(k / ARROWS));
    let count = ARROWS * ARROWS;
    let postures: Vec<_> = (0..count).map(|k| posture(at(k).x, at(k).y)).collect();
    let (_, by_arm) = clearances(&postures)?;
    let mut arrows = String::new();
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
        let _ = write!(
            arrows,
            "M{:.1},{:.1}L{:.1},{:.1}M{:.1},{:.1}L{:.1},{:.1}L{:.1},{:.1}",
            tail.x, tail.y, tip.x, tip.y, p.x, p.y, tip.x, tip.y, q.x, q.y
        );
    }
    let _ = writeln!(
        page,
        r#"<path d="{arrows}" fill="none" stroke="{INK}" stroke-opacity="0.72" stroke-width="1.1" stroke-linecap="round"/>"#
    );
    let points: Vec<_> = way
        .iter()
        .map(|p| joints(*p))
        .map(|p| format!("{:.1},{:.1}", p.x, p.y))
        .collect();
    let points = points.join(" ");
    for (stroke, width) in [("#fff", 6.0), (END, 3.0)] {
        let _ = writeln!(
            page,
            r#"<polyline points="{points}" fill="none" stroke="{stroke}" stroke-width="{width}" stroke-linejoin="round"/>"#
        );
    }
    for (at, fill) in [(way[0], START), (way[way.len() - 1], END)] {
        let p = joints(at);
        let _ = writeln!(
            page,
            r##"<circle cx="{:.1}" cy="{:.1}" r="6.5" fill="{fill}" stroke="#fff" stroke-width="2"/>"##,
            p.x, p.y
        );
    }
    let _ = writeln!(
        page,
        r##"<rect x="{left}" y="{TOP}" width="{SIDE}" height="{SIDE}" fill="none" stroke="#495057"/>"##
    );
    for (i, name) in ["−180°", "−90°", "0°", "90°", "180°"].iter().enumerate() {
        let off = SIDE * i as f32 / 4.0;
        let small = format!(r#"font-size="12" fill="{FAINT}""#);
        text(
            page,
            (left + off, TOP + SIDE + 17.0),
            &format!(r#"{small} text-anchor="middle""#),
            name,
        );
        text(
            page,
            (left - 7.0, TOP + SIDE - off + 4.0),
            &format!(r#"{small} text-anchor="end""#),
            name,
        );
    }
    Ok(())
}

/// Writes the legend of the colours.
fn legend(page: &mut String) {
    let (width, x, y) = (24.0, LEFT[1] + 110.0, TOP + SIDE + 40.0);
    for (i, band) in (BANDS.start() - 1..=*BANDS.end()).enumerate() {
        let at = x + width * i as f32;
        let _ = writeln!(
            page,
            r#"<rect x="{at}" y="{y}" width="{width}" height="12" fill="{}"/>"#,
            colour(band)
        );
        if band % 2 == 0 && band >= *BANDS.start() {
            let style = format!(r#"font-size="11" fill="{FAINT}" text-anchor="middle""#);
            text(
                page,
                (at, y + 25.0),
                &style,
                &format!("{:.1}", band as f32 * BAND).replace('-', "−"),
            );
        }
    }
    text(
        page,
        (x - 10.0, y + 10.0),
        &format!(r#"font-size="12" fill="{INK}" text-anchor="end""#),
        "clearance in m",
    );
}

/// Draws all of it into a file.
pub fn write(file: &OsStr) -> Result<String, Failure> {
    let failed = |error| Failure::Work(format!("{}: {error}", file.display()));
    std::fs::write(file, picture()?).map_err(failed)?;
    Ok(String::new())
}

/// All of it as SVG.
fn picture() -> Result<String, Error> {
    let way = way_out()?;
    let mut page = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" font-family="Helvetica, Arial, sans-serif">
<rect width="100%" height="100%" fill="#fff"/>
"##,
        PAGE.x, PAGE.y
    );
    let title = format!(r#"font-size="21" font-weight="bold" fill="{INK}""#);
    let under = format!(r#"font-size="13.5" fill="{FAINT}""#);
    text(
        &mut page,
        (LEFT[0], 38.0),
        &title,
        "Up the derivative of its clearance the arm leaves the wall",
    );
    text(
        &mut page,
        (LEFT[0], 66.0),
        &under,
        "the arm at the start (red), on its way, and free (blue)",
    );
    text(
        &mut page,
        (LEFT[1], 66.0),
        &under,
        "clearance by shoulder (right) and elbow (up), and its derivatives",
    );
    scene(&mut page, &way);
    field(&mut page, &way)?;
    legend(&mut page);
    page.push_str("</svg>\n");
    Ok(page)
}
