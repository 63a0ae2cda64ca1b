//! The picture: a path before and after from three sides, and the clearance along it.
use crate::arm::{Joints, MOUNT, RADIUS, Solids, scene, solids};
use crate::path::{self, MARGIN, Path};
use geograd::{Capsule3, Error, Obb3, Vec2, Vec3};
use std::fmt::Write as _;

const INK: &str = "#212529";
const FAINT: &str = "#868e96";
const RED: &str = "#c92a2a";
const BLUE: &str = "#1864ab";
/// Outlines of what is red and blue.
const DEEP_RED: &str = "#5c0f0f";
const DEEP_BLUE: &str = "#0b3054";
const WOOD: &str = "#b08968";

/// Pixels of a metre, and the margin.
const SCALE: f64 = 230.0;
const MARGINS: f64 = 34.0;
const TOP: f64 = 100.0;
/// Pieces between two points of a path where clearance is looked at.
const PIECES: usize = 8;
/// Arms drawn along a path.
const ARMS: usize = 7;
/// Pixels of an outline.
const OUTLINE: f64 = 0.9;

/// A path with its clearance, at its points and between them.
pub struct Way {
    fine: Path,
    clearances: Vec<f64>,
}

impl Way {
    pub fn new(path: Path) -> Result<Self, Error> {
        let fine = path::refined(&path, PIECES);
        let clearances = path::clearances(&fine)?;
        Ok(Way { fine, clearances })
    }
    /// The least clearance in metres.
    pub fn least(&self) -> f64 {
        self.clearances
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min)
    }
    /// The length in radians.
    pub fn length(&self) -> f64 {
        path::length(&self.fine)
    }
}

/// A view along one axis: which coordinates go right and up, and what is in it, in metres.
#[derive(Clone, Copy)]
struct View {
    name: &'static str,
    right: fn(Vec3<f64>) -> f64,
    up: fn(Vec3<f64>) -> f64,
    low: Vec2<f64>,
    size: Vec2<f64>,
}

const VIEWS: [View; 3] = [
    View {
        name: "front (along −x)",
        right: |p| p.y,
        up: |p| p.z,
        low: Vec2::new(-0.78, -0.06),
        size: Vec2::new(1.56, 1.3),
    },
    View {
        name: "side (along y)",
        right: |p| p.x,
        up: |p| p.z,
        low: Vec2::new(-0.3, -0.06),
        size: Vec2::new(1.3, 1.3),
    },
    View {
        name: "top (along −z)",
        right: |p| p.x,
        up: |p| p.y,
        low: Vec2::new(-0.3, -0.62),
        size: Vec2::new(1.3, 1.3),
    },
];

/// A view at a place of the page.
#[derive(Clone, Copy)]
struct Panel {
    view: View,
    corner: Vec2<f64>,
}

impl Panel {
    fn place(self, point: Vec3<f64>) -> Vec2<f64> {
        let View {
            right,
            up,
            low,
            size,
            ..
        } = self.view;
        Vec2::new(
            self.corner.x + (right(point) - low.x) * SCALE,
            self.corner.y + (size.y - up(point) + low.y) * SCALE,
        )
    }
    fn rod(self, page: &mut String, rod: Capsule3<f64>, colour: &str) {
        self.wider_rod(page, rod, colour, 0.0);
    }
    /// A rod with so many more pixels all around.
    fn wider_rod(self, page: &mut String, rod: Capsule3<f64>, colour: &str, more: f64) {
        let [a, b] = [rod.start, rod.end].map(|end| self.place(end));
        let _ = writeln!(
            page,
            r#"<line x1="{:.2}" y1="{:.2}" x2="{:.2}" y2="{:.2}" stroke="{colour}" stroke-width="{:.2}" stroke-linecap="round"/>"#,
            a.x,
            a.y,
            b.x,
            b.y,
            2.0 * (rod.radius * SCALE + more)
        );
    }
    /// All six faces: together they cover what the box does.
    fn solid(self, page: &mut String, solid: Obb3<f64>, style: &str) {
        let corners = solid.corners().map(|corner| self.place(corner));
        let faces = [
            [0, 1, 3, 2],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 3, 7, 6],
            [0, 2, 6, 4],
            [1, 3, 7, 5],
        ];
        let mut path = String::new();
        for face in faces {
            let [a, mut b, c, mut d] = face.map(|k: usize| corners[k]);
            // Turned the same way round, faces that cover each other add up.
            if (c - a).perp().dot(d - b) < 0.0 {
                (b, d) = (d, b);
            }
            let _ = write!(
                path,
                "M{:.2},{:.2}L{:.2},{:.2}L{:.2},{:.2}L{:.2},{:.2}Z",
                a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y
            );
        }
        let _ = writeln!(
            page,
            r#"<path d="{path}" stroke-linejoin="round" {style}/>"#
        );
    }
    /// The arm with an outline, so that arms which cover each other can be told apart.
    fn arm(self, page: &mut String, joints: Joints<f64>, colour: [&str; 2], opacity: f64) {
        let Solids { links, hand } = solids(joints, RADIUS);
        let [fill, edge] = colour;
        let _ = writeln!(page, r#"<g opacity="{opacity}">"#);
        for link in links {
            self.wider_rod(page, link, edge, OUTLINE);
        }
        let style = format!(
            r#"fill="{edge}" stroke="{edge}" stroke-width="{}""#,
            2.0 * OUTLINE
        );
        self.solid(page, hand, &style);
        for link in links {
            self.rod(page, link, fill);
        }
        self.solid(page, hand, &format!(r#"fill="{fill}" stroke="none""#));
        page.push_str("</g>\n");
    }
    /// The names of what is around, where the view from the front has room for them.
    fn names(self, page: &mut String) {
        let names = [
            ("pipe", [-0.74, 1.035], "#fff"),
            ("bench", [-0.67, 0.03], INK),
            ("crate", [0.03, 0.325], INK),
            ("post", [-0.435, 0.325], INK),
        ];
        for (name, [right, up], colour) in names {
            let at = self.place(Vec3::new(0.0, right, up));
            let style = format!(r#"font-size="11.5" fill="{colour}""#);
            text(page, (at.x, at.y), &style, name);
        }
    }
    fn draw(self, page: &mut String, way: &Way) {
        let (Vec2 { x: left, y: top }, around) = (self.corner, scene::<f64>());
        let (width, height) = (self.view.size.x * SCALE, self.view.size.y * SCALE);
        let name = format!("{}{:.0}", &self.view.name[..1], top);
        let _ = writeln!(
            page,
            r##"<clipPath id="{name}"><rect x="{left}" y="{top}" width="{width:.2}" height="{height:.2}"/></clipPath>
<g clip-path="url(#{name})"><rect x="{left}" y="{top}" width="{width:.2}" height="{height:.2}" fill="#f8f9fa"/>"##
        );
        let (floor, above) = (
            self.place(Vec3::zero()).y,
            self.view.name.starts_with("top"),
        );
        if !above {
            let _ = writeln!(
                page,
                r##"<rect x="{left}" y="{floor:.2}" width="{width:.2}" height="{height:.2}" fill="#adb5bd"/>"##
            );
        }
        let style = |fill| format!(r##"fill="{fill}" stroke="#868e96" stroke-width="0.8""##);
        self.solid(page, around.pedestal, &style("#ced4da"));
        for (solid, fill) in around.boxes.into_iter().zip(["#dee2e6", "#ffd8a8"]) {
            self.solid(page, solid, &style(fill));
        }
        let [post, pipe] = around.rods;
        self.rod(page, post, WOOD);
        if !above {
            self.rod(page, pipe, WOOD);
        }
        let last = way.fine.len() - 1;
        for i in 0..ARMS {
            let k = i * last / (ARMS - 1);
            let collides = way.clearances[k] < 0.0;
            let colour = if collides {
                [RED, DEEP_RED]
            } else {
                [BLUE, DEEP_BLUE]
            };
            let opacity = if i == 0 || i == ARMS - 1 { 0.8 } else { 0.32 };
            self.arm(page, way.fine[k], colour, opacity);
        }
        let hand = |joints: &Joints<f64>| self.place(solids(*joints, RADIUS).hand.center);
        line(page, way.fine.iter().map(hand), INK, 1.6);
        if above {
            // Seen from there, it hides the arm.
            page.push_str("<g opacity=\"0.6\">");
            self.rod(page, pipe, WOOD);
            page.push_str("</g>\n");
        }
        if self.view.name.starts_with("front") {
            self.names(page);
        }
        let base = self.place(Vec3::new(0.0, 0.0, MOUNT));
        let _ = writeln!(
            page,
            r##"<circle cx="{:.2}" cy="{:.2}" r="4" fill="#fff" stroke="{INK}" stroke-width="1.5"/></g>
<rect x="{left}" y="{top}" width="{width:.2}" height="{height:.2}" fill="none" stroke="#ced4da"/>"##,
            base.x, base.y
        );
    }
}

fn line(page: &mut String, points: impl Iterator<Item = Vec2<f64>>, colour: &str, width: f64) {
    let points: Vec<_> = points.map(|p| format!("{:.2},{:.2}", p.x, p.y)).collect();
    let _ = writeln!(
        page,
        r#"<polyline points="{}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round"/>"#,
        points.join(" ")
    );
}

fn text(page: &mut String, at: (f64, f64), style: &str, words: &str) {
    let _ = writeln!(
        page,
        r#"<text x="{:.1}" y="{:.1}" {style}>{words}</text>"#,
        at.0, at.1
    );
}

/// The clearance along both paths.
fn plot(page: &mut String, ways: &[Way; 2], corner: Vec2<f64>, size: Vec2<f64>) {
    let all = || ways.iter().flat_map(|way| way.clearances.iter().copied());
    let low = (all().fold(0.0, f64::min) / 0.05).floor() * 0.05;
    let high = (all().fold(MARGIN, f64::max) / 0.05).ceil() * 0.05;
    let at = |t: f64, value: f64| {
        Vec2::new(
            corner.x + t * size.x,
            corner.y + (high - value) / (high - low) * size.y,
        )
    };
    let small = format!(r#"font-size="12" fill="{FAINT}""#);
    let zero = at(0.0, 0.0).y;
    let _ = writeln!(
        page,
        r##"<rect x="{}" y="{zero:.2}" width="{}" height="{:.2}" fill="#fff5f5"/>"##,
        corner.x,
        size.x,
        corner.y + size.y - zero
    );
    for k in (low / 0.05).round() as i32..=(high / 0.05).round() as i32 {
        let value = 0.05 * f64::from(k);
        let colour = if k == 0 { INK } else { "#e9ecef" };
        line(
            page,
            [at(0.0, value), at(1.0, value)].into_iter(),
            colour,
            1.0,
        );
        let (style, words) = (
            format!(r#"{small} text-anchor="end""#),
            format!("{value:.2}").replace('-', "−"),
        );
        text(
            page,
            (corner.x - 7.0, at(0.0, value).y + 4.0),
            &style,
            &words,
        );
    }
    let [from, to] = [0.0, 1.0].map(|t| at(t, MARGIN));
    let _ = writeln!(
        page,
        r#"<line x1="{:.2}" y1="{:.2}" x2="{:.2}" y2="{:.2}" stroke="{FAINT}" stroke-dasharray="5 4"/>"#,
        from.x, from.y, to.x, to.y
    );
    text(page, (to.x + 6.0, to.y + 4.0), &small, "wanted");
    let below = corner.y + size.y + 17.0;
    text(page, (corner.x, below), &small, "start");
    let style = format!(r#"{small} text-anchor="end""#);
    text(page, (corner.x + size.x, below), &style, "end");
    for ((way, colour), words) in ways.iter().zip([RED, BLUE]).zip(["before", "after"]) {
        let last = way.clearances.len() - 1;
        let points = way.clearances.iter().enumerate();
        line(
            page,
            points.map(|(i, &value)| at(i as f64 / last as f64, value)),
            colour,
            2.4,
        );
        let shift = if words == "before" { 0.0 } else { 70.0 };
        let style = format!(r#"font-size="13" font-weight="bold" fill="{colour}""#);
        text(
            page,
            (corner.x + size.x - 120.0 + shift, corner.y - 9.0),
            &style,
            words,
        );
    }
    text(
        page,
        (corner.x, corner.y - 9.0),
        &format!(r#"font-size="13.5" fill="{INK}""#),
        "clearance along the path, in m",
    );
}

/// The whole picture.
pub fn page(ways: &[Way; 2]) -> String {
    let width = VIEWS
        .iter()
        .map(|view| view.size.x * SCALE + MARGINS)
        .sum::<f64>()
        + MARGINS;
    let row = VIEWS
        .iter()
        .map(|view| view.size.y * SCALE)
        .fold(0.0, f64::max)
        + 44.0;
    let chart = TOP + 2.0 * row + 26.0;
    let (tall, chart_height) = (chart + 262.0, 220.0);
    let mut page = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {tall:.0}\" width=\"{width:.0}\" \
         height=\"{tall:.0}\" font-family=\"Helvetica, Arial, sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let title = format!(r#"font-size="21" font-weight="bold" fill="{INK}""#);
    text(
        &mut page,
        (MARGINS, 38.0),
        &title,
        "A path of six joints leaves what it collides with",
    );
    let words = "the arm along its path, red where it collides, dark at both ends; the line is the hand's way";
    let under = format!(r#"font-size="13.5" fill="{FAINT}""#);
    text(&mut page, (MARGINS, 60.0), &under, words);
    for (k, (way, when)) in ways.iter().zip(["before", "after"]).enumerate() {
        let (mut left, top) = (MARGINS, TOP + k as f64 * row);
        for view in VIEWS {
            let style = format!(r#"font-size="13.5" fill="{INK}""#);
            let words = format!("{when}: {}", view.name);
            text(&mut page, (left, top - 9.0), &style, &words);
            let corner = Vec2::new(left, top);
            Panel { view, corner }.draw(&mut page, way);
            left += view.size.x * SCALE + MARGINS;
        }
    }
    let size = Vec2::new(width - 2.0 * MARGINS - 92.0, chart_height);
    plot(&mut page, ways, Vec2::new(MARGINS + 42.0, chart), size);
    page.push_str("</svg>\n");
    page
}
