//! The picture: the block without its walls in front and the peg along its path, before and after; and the clearance.
use crate::bodies::{self, GROUND, PLAY, Place, Solid};
use crate::insertion::{self, MARGIN};
use common::svg::{BLUE, END, FAINT, INK, Page, RED};
use geograd::distance3::ContactPoint3;
use geograd::{Error, Vec2, Vec3};

/// Outlines of what is red and blue.
const DEEP_RED: &str = "#5c0f0f";
const DEEP_BLUE: &str = "#0b3054";
const YELLOW: &str = "#ffd43b";
/// Pixels of a metre.
const SCALE: f64 = 248.0;
const PANEL: Vec2<f64> = Vec2::new(510.0, 474.0);
const LEFT: f64 = 24.0;
const TOP: f64 = 112.0;
/// Pegs drawn along a path.
const PEGS: usize = 9;
/// Places of a piece of a path where the distance is looked at.
const PIECES: usize = 16;
/// The direction of the view: turned about the vertical and tilted down, in radians.
const TURNED: f64 = -0.3;
const TILTED: f64 = 0.36;
/// The clearances of the chart, in millimetres.
const CHART: [f64; 2] = [-2.0, 6.0];
const SMALL: &str = r##"font-size="12" fill="#868e96""##;

/// Returns the axes of the view: to the right, up, and towards the viewer.
fn axes() -> [Vec3<f64>; 3] {
    let ((sin, cos), (sink, level)) = (TURNED.sin_cos(), TILTED.sin_cos());
    let right = Vec3::new(cos, sin, 0.0);
    let near = Vec3::new(sin * level, -cos * level, sink);
    [right, near.cross(right), near]
}

/// A path at its points and between them, with its distances from the block in metres.
struct Way {
    places: Vec<Place<f64>>,
    clearances: Vec<f64>,
}

impl Way {
    fn new(path: &[Place<f64>]) -> Result<Self, Error> {
        let part = |k: usize| k as f64 / PIECES as f64;
        let piece = |ends: &[Place<f64>]| -> Vec<_> {
            (0..PIECES)
                .map(|k| bodies::between(ends[0], ends[1], part(k)))
                .collect()
        };
        let mut places: Vec<_> = path.windows(2).flat_map(piece).collect();
        places.extend(path.last());
        let pegs: Vec<_> = places.iter().map(|&place| bodies::peg(place)).collect();
        let clearances = insertion::distances(&pegs)?;
        Ok(Way { places, clearances })
    }
    /// Returns the colours of fill and outline at a place.
    fn colours(&self, k: usize) -> [&'static str; 2] {
        match self.clearances[k] < 0.0 {
            true => [RED, DEEP_RED],
            false => [BLUE, DEEP_BLUE],
        }
    }
}

/// A view of the scene.
#[derive(Clone, Copy)]
struct View {
    corner: Vec2<f64>,
}

impl View {
    fn place(self, point: Vec3<f64>) -> Vec2<f64> {
        let [right, up, _] = axes();
        self.corner + Vec2::new(right.dot(point) + 1.39, 1.0 - up.dot(point)) * SCALE
    }
    /// Draws the faces of a solid that are seen, the darker the more they are turned away from the light.
    fn solid(self, page: &mut Page, solid: &Solid<f64>, [fill, edge]: [&str; 2], opacity: f64) {
        let (points, [_, up, near]) = (solid.as_slice(), axes());
        page.group(format_args!(r#"opacity="{opacity}""#), |page| {
            for face in solid.faces().faces() {
                let [a, b, c] = [0, 1, 2].map(|k| points[face[k]]);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                if normal.dot(near) <= 0.0 {
                    continue;
                }
                let ring = || face.iter().map(|&k| self.place(points[k]));
                let light = (near + up - axes()[0]).normalize_or_zero();
                let shade = 0.3 * (1.0 - normal.dot(light)).clamp(0.0, 1.0);
                page.polygon(ring(), format_args!(r#"fill="{fill}""#));
                let line = format_args!(r#"stroke="{edge}" stroke-width="0.9""#);
                let style =
                    format_args!(r#"fill-opacity="{shade:.2}" stroke-linejoin="round" {line}"#);
                page.polygon(ring(), style);
            }
        });
    }
    fn draw(self, page: &mut Page, way: &Way, ground: &[ContactPoint3<f64>]) {
        let near = Vec3::new(axes()[2].x, axes()[2].y, 0.0);
        let mut block: Vec<_> = bodies::block().into_iter().enumerate().collect();
        // Walls in front would hide the hole.
        block.retain(|(k, solid)| *k == GROUND || solid.center().dot(near) < 0.1);
        block.sort_by(|(i, a), (j, b)| {
            let depth = |k: &usize, solid: &Solid<f64>| match *k == GROUND {
                true => f64::NEG_INFINITY,
                false => solid.center().dot(near),
            };
            depth(i, a).total_cmp(&depth(j, b))
        });
        for (_, solid) in &block {
            self.solid(page, solid, ["#e9ecef", FAINT], 1.0);
        }
        for point in ground {
            let style = format_args!(r#"fill="{YELLOW}" stroke="{INK}" stroke-width="0.8""#);
            page.circle(self.place(point.on_b), 3.5, style);
        }
        let last = way.places.len() - 1;
        for i in 0..PEGS {
            let k = i * last / (PEGS - 1);
            let opacity = if i == 0 || i == PEGS - 1 { 0.9 } else { 0.35 };
            self.solid(page, &bodies::peg(way.places[k]), way.colours(k), opacity);
        }
        let center = |place: &Place<f64>| self.place(Vec3::new(place[0], place[1], place[2]));
        let style =
            format_args!(r##"fill="none" stroke="#fff" stroke-width="2" stroke-dasharray="5 3""##);
        page.polyline(way.places.iter().map(center), style);
    }
}

/// Draws the clearance along both paths.
fn plot(page: &mut Page, ways: &[Way; 2], corner: Vec2<f64>, size: Vec2<f64>) {
    let [low, high] = CHART;
    let at = |part: f64, clearance: f64| {
        corner
            + Vec2::new(
                part * size.x,
                (high - 1e3 * clearance) / (high - low) * size.y,
            )
    };
    page.ground("chart", [corner.x, corner.y, size.x, size.y]);
    let zero = at(0.0, 0.0).y;
    let area = [corner.x, zero, size.x, corner.y + size.y - zero];
    page.rect(area, r##"fill="#fff5f5""##);
    for tick in [-2.0, 0.0, 2.0, 4.0, 6.0] {
        let ends = [at(0.0, 1e-3 * tick), at(1.0, 1e-3 * tick)];
        let colour = if tick == 0.0 { INK } else { "#e9ecef" };
        page.line(ends, format_args!(r#"stroke="{colour}""#));
        page.left_of(ends[0], SMALL, format!("{tick}").replace('-', "−"));
    }
    for (value, words) in [(PLAY, "peg in the middle"), (MARGIN, "wanted")] {
        let ends = [at(0.0, value), at(1.0, value)];
        page.line(
            ends,
            format_args!(r#"stroke="{FAINT}" stroke-dasharray="5 4""#),
        );
        page.text(ends[1] + Vec2::new(6.0, 4.0), SMALL, words);
    }
    page.inside("chart", |page| {
        for (way, colour) in ways.iter().zip([RED, BLUE]) {
            let last = way.clearances.len() - 1;
            let points = way.clearances.iter().enumerate();
            let points = points.map(|(k, &value)| at(k as f64 / last as f64, value));
            let style = format_args!(r#"fill="none" stroke="{colour}" stroke-width="2.4""#);
            page.polyline(points, style);
        }
    });
    let deepest = ways[0].clearances.iter().copied().fold(0.0, f64::min);
    let words = format_args!(
        "clearance along the path, in mm; the straight one is up to {:.0} mm deep in the block",
        -1e3 * deepest
    );
    page.text(corner - Vec2::new(0.0, 10.0), r#"font-size="13.5""#, words);
    let below = corner.y + size.y + 17.0;
    page.text(Vec2::new(corner.x, below), SMALL, "start");
    let end = Vec2::new(corner.x + size.x, below);
    page.text(end, format_args!("{SMALL} {END}"), "end");
}

/// Returns the whole picture.
pub fn page(paths: [&[Place<f64>]; 2], ground: &[ContactPoint3<f64>]) -> Result<String, Error> {
    let ways = [Way::new(paths[0])?, Way::new(paths[1])?];
    let size = Vec2::new(2.0 * (LEFT + PANEL.x) + LEFT, TOP + PANEL.y + 270.0);
    let title = "A peg finds its way into a hole that is 2 mm wider on every side";
    let mut page = Page::titled(size, title);
    let names = [
        (format!(r#"fill="{BLUE}""#), "free"),
        (format!(r#"fill="{RED}""#), "collides"),
        (
            format!(r#"fill="{YELLOW}" stroke="{INK}""#),
            "contact with the ground",
        ),
    ];
    page.head(
        LEFT,
        title,
        names.iter().map(|(style, name)| (&style[..], *name)),
    );
    for (k, (way, name)) in ways
        .iter()
        .zip(["before: straight; walls in front are not drawn", "after"])
        .enumerate()
    {
        let corner = Vec2::new(LEFT + k as f64 * (PANEL.x + LEFT), TOP);
        let id = format!("panel{k}");
        page.text(corner - Vec2::new(0.0, 9.0), r#"font-size="13.5""#, name);
        page.ground(&id, [corner.x, corner.y, PANEL.x, PANEL.y]);
        page.inside(&id, |page| View { corner }.draw(page, way, ground));
    }
    let corner = Vec2::new(LEFT + 36.0, TOP + PANEL.y + 46.0);
    plot(
        &mut page,
        &ways,
        corner,
        Vec2::new(size.x - corner.x - 130.0, 180.0),
    );
    Ok(page.finish())
}
