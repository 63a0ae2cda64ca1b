//! The picture: a path before and after from three sides, and the clearance along it.
use crate::arm::{Joints, MOUNT, RADIUS, Solids, scene, solids};
use crate::path::{self, MARGIN, Path};
use common::svg::{BLUE, END, FAINT, INK, Page, RED};
use geograd::{Capsule3, Error, Obb3, Vec2, Vec3};

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
    /// A rod with so many more pixels all around.
    fn rod(self, page: &mut Page, rod: Capsule3<f64>, colour: &str, more: f64) {
        let width = 2.0 * (rod.radius * SCALE + more);
        let style =
            format_args!(r#"stroke="{colour}" stroke-width="{width:.2}" stroke-linecap="round""#);
        page.line([rod.start, rod.end].map(|end| self.place(end)), style);
    }
    /// All six faces: together they cover what the box does.
    fn solid(self, page: &mut Page, solid: Obb3<f64>, style: &str) {
        let corners = solid.corners().map(|corner| self.place(corner));
        let faces = [
            [0, 1, 3, 2],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 3, 7, 6],
            [0, 2, 6, 4],
            [1, 3, 7, 5],
        ];
        let faces = faces.map(|face| {
            let [a, b, c, d] = face.map(|k: usize| corners[k]);
            // Turned the same way round, faces that cover each other add up.
            match (c - a).perp().dot(d - b) < 0.0 {
                true => [a, d, c, b],
                false => [a, b, c, d],
            }
        });
        page.rings(faces, format_args!(r#"stroke-linejoin="round" {style}"#));
    }
    /// The arm with an outline, so that arms which cover each other can be told apart.
    fn arm(self, page: &mut Page, joints: Joints<f64>, colour: [&str; 2], opacity: f64) {
        let Solids { links, hand } = solids(joints, RADIUS);
        let [fill, edge] = colour;
        page.group(format_args!(r#"opacity="{opacity}""#), |page| {
            for link in links {
                self.rod(page, link, edge, OUTLINE);
            }
            let width = 2.0 * OUTLINE;
            let style = format!(r#"fill="{edge}" stroke="{edge}" stroke-width="{width}""#);
            self.solid(page, hand, &style);
            for link in links {
                self.rod(page, link, fill, 0.0);
            }
            self.solid(page, hand, &format!(r#"fill="{fill}" stroke="none""#));
        });
    }
    /// The names of what is around, where the view from the front has room for them.
    fn names(self, page: &mut Page) {
        let names = [
            ("pipe", [-0.74, 1.035], "#fff"),
            ("bench", [-0.67, 0.03], INK),
            ("crate", [0.03, 0.325], INK),
            ("post", [-0.435, 0.325], INK),
        ];
        for (name, [right, up], colour) in names {
            let at = self.place(Vec3::new(0.0, right, up));
            let style = format_args!(r#"font-size="11.5" fill="{colour}""#);
            page.text(at, style, name);
        }
    }
    fn draw(self, page: &mut Page, way: &Way) {
        let Vec2 { x: left, y: top } = self.corner;
        let size = self.view.size * SCALE;
        let area = [left, top, size.x, size.y];
        let id = format!("{}{top:.0}", &self.view.name[..1]);
        page.window(&id, area);
        page.inside(&id, |page| {
            page.rect(area, r##"fill="#f8f9fa""##);
            self.contents(page, way);
        });
        page.rect(area, r##"fill="none" stroke="#ced4da""##);
    }
    fn contents(self, page: &mut Page, way: &Way) {
        let (size, around) = (self.view.size * SCALE, scene::<f64>());
        let floor = self.place(Vec3::zero()).y;
        let above = self.view.name.starts_with("top");
        if !above {
            let area = [self.corner.x, floor, size.x, size.y];
            page.rect(area, r##"fill="#adb5bd""##);
        }
        let style = |fill| format!(r#"fill="{fill}" stroke="{FAINT}" stroke-width="0.8""#);
        self.solid(page, around.pedestal, &style("#ced4da"));
        for (solid, fill) in around.boxes.into_iter().zip(["#dee2e6", "#ffd8a8"]) {
            self.solid(page, solid, &style(fill));
        }
        let [post, pipe] = around.rods;
        self.rod(page, post, WOOD, 0.0);
        if !above {
            self.rod(page, pipe, WOOD, 0.0);
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
            page.group(r#"opacity="0.6""#, |page| self.rod(page, pipe, WOOD, 0.0));
        }
        if self.view.name.starts_with("front") {
            self.names(page);
        }
        let base = self.place(Vec3::new(0.0, 0.0, MOUNT));
        let style = format_args!(r##"fill="#fff" stroke="{INK}" stroke-width="1.5""##);
        page.circle(base, 4, style);
    }
}

fn line(page: &mut Page, points: impl IntoIterator<Item = Vec2<f64>>, colour: &str, width: f64) {
    let style = format_args!(
        r#"fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round""#
    );
    page.polyline(points, style);
}

/// The clearance along both paths.
fn plot(page: &mut Page, ways: &[Way; 2], corner: Vec2<f64>, size: Vec2<f64>) {
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
    let (zero, foot) = (at(0.0, 0.0).y, corner.y + size.y);
    let area = [corner.x, zero, size.x, foot - zero];
    page.rect(area, r##"fill="#fff5f5""##);
    for k in (low / 0.05).round() as i32..=(high / 0.05).round() as i32 {
        let value = 0.05 * f64::from(k);
        let colour = if k == 0 { INK } else { "#e9ecef" };
        line(page, [at(0.0, value), at(1.0, value)], colour, 1.0);
        let words = format!("{value:.2}").replace('-', "−");
        page.left_of(at(0.0, value), &small, words);
    }
    let [from, to] = [0.0, 1.0].map(|t| at(t, MARGIN));
    let style = format_args!(r#"stroke="{FAINT}" stroke-dasharray="5 4""#);
    page.line([from, to], style);
    page.text(to + Vec2::new(6.0, 4.0), &small, "wanted");
    let below = foot + 17.0;
    page.text(Vec2::new(corner.x, below), &small, "start");
    let end = Vec2::new(corner.x + size.x, below);
    page.text(end, format_args!("{small} {END}"), "end");
    for (way, (colour, words, left)) in ways
        .iter()
        .zip([(RED, "before", 120.0), (BLUE, "after", 50.0)])
    {
        let last = way.clearances.len() - 1;
        let points = way.clearances.iter().enumerate();
        let points = points.map(|(i, &value)| at(i as f64 / last as f64, value));
        line(page, points, colour, 2.4);
        let style = format_args!(r#"font-size="13" font-weight="bold" fill="{colour}""#);
        page.text(corner + Vec2::new(size.x - left, -9.0), style, words);
    }
    let style = format_args!(r#"font-size="13.5" fill="{INK}""#);
    let words = "clearance along the path, in m";
    page.text(corner - Vec2::new(0.0, 9.0), style, words);
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
    let font = r#"font-family="Helvetica, Arial, sans-serif""#;
    let mut page = Page::new(Vec2::new(width, tall), 2, font);
    page.paper(r##"fill="#fff""##);
    let style = format_args!(r#"font-size="21" font-weight="bold" fill="{INK}""#);
    let title = "A path of six joints leaves what it collides with";
    page.text(Vec2::new(MARGINS, 38.0), style, title);
    let words = "the arm along its path, red where it collides, dark at both ends; the line is the hand's way";
    let style = format_args!(r#"font-size="13.5" fill="{FAINT}""#);
    page.text(Vec2::new(MARGINS, 60.0), style, words);
    for (k, (way, when)) in ways.iter().zip(["before", "after"]).enumerate() {
        let mut corner = Vec2::new(MARGINS, TOP + k as f64 * row);
        for view in VIEWS {
            let style = format_args!(r#"font-size="13.5" fill="{INK}""#);
            let words = format_args!("{when}: {}", view.name);
            page.text(corner - Vec2::new(0.0, 9.0), style, words);
            Panel { view, corner }.draw(&mut page, way);
            corner.x += view.size.x * SCALE + MARGINS;
        }
    }
    let size = Vec2::new(width - 2.0 * MARGINS - 92.0, chart_height);
    plot(&mut page, ways, Vec2::new(MARGINS + 42.0, chart), size);
    page.finish()
}
