//! The picture: the scan on the body before and after, and how fast each way comes to its end.
use crate::fitting::{Course, Way};
use crate::scan::Scan;
use common::blend::Faces;
use common::painter::{Colour, Painter, View};
use common::svg::{BLUE, INK, ORANGE, Page, RED, SMALL};
use geograd::{Pose3, Vec2};

const PANEL: Vec2<f64> = Vec2::new(520.0, 420.0);
const LEFT: f64 = 24.0;
const TOP: f64 = 112.0;
/// Pixels of a metre.
const SCALE: f64 = 2300.0;
const BODY: Colour = [206, 212, 218];
const POINT: Colour = [201, 42, 42];
const GREEN: &str = "#2b8a3e";
/// Colours of the ways.
const COLOURS: [&str; 4] = [ORANGE, RED, GREEN, BLUE];
/// The decades of the chart, in metres.
const CHART: [f64; 2] = [-10.0, -1.0];
/// Steps that the chart has.
const STEPS: usize = 30;

/// Draws the scan in a pose over the body.
fn panel(page: &mut Page, corner: Vec2<f64>, body: &Faces, scan: &Scan, pose: Pose3<f64>) {
    let (at, towards) = (corner + PANEL * 0.5, scan.towards);
    // From the camera's side, so that the points are seen.
    let turn = towards.x.atan2(-towards.y) + 0.3;
    let tilt = towards.z.clamp(-0.9, 0.9).asin();
    let mut painter = Painter::new(View::turned(at, SCALE, turn, tilt));
    painter.mesh(body, BODY);
    for &point in &scan.points {
        painter.dot(pose * point, 1.3, 2e-3, POINT);
    }
    painter.finish(page);
}

/// Draws how far points are from where they end, step by step.
fn chart(page: &mut Page, corner: Vec2<f64>, size: Vec2<f64>, scan: &Scan, courses: [&Course; 4]) {
    let [low, high] = CHART;
    let at = |step: f64, decade: f64| {
        let part = Vec2::new(step / STEPS as f64, (high - decade) / (high - low));
        corner + Vec2::new(part.x * size.x, part.y * size.y)
    };
    page.ground("chart", [corner.x, corner.y, size.x, size.y]);
    for decade in -10..=-1 {
        let ends = [
            at(0.0, f64::from(decade)),
            at(STEPS as f64, f64::from(decade)),
        ];
        page.line(ends, r##"stroke="#e9ecef""##);
        let words = match decade {
            -3 => "1 mm",
            -6 => "1 µm",
            -9 => "1 nm",
            _ => continue,
        };
        page.left_of(ends[0], SMALL, words);
    }
    for step in (0..=STEPS).step_by(5) {
        page.below(at(step as f64, low), SMALL, step);
    }
    page.inside("chart", |page| {
        for (course, colour) in courses.iter().zip(COLOURS) {
            let end = course.end();
            let points = course.poses.iter().enumerate().map(|(step, &pose)| {
                let squares = scan
                    .points
                    .iter()
                    .map(|&p| (pose * p - end * p).length_squared());
                let way = (squares.sum::<f64>() / scan.points.len() as f64).sqrt();
                at(step as f64, way.max(1e-12).log10())
            });
            let style = format_args!(
                r#"fill="none" stroke="{colour}" stroke-width="2.2" stroke-linejoin="round""#
            );
            page.polyline(points, style);
        }
    });
}

/// Returns the whole picture.
pub fn page(body: &Faces, scan: &Scan, courses: [&Course; 4]) -> String {
    let size = Vec2::new(2.0 * (LEFT + PANEL.x) + LEFT, TOP + PANEL.y + 330.0);
    let title = "A noisy scan of one side finds its place on the mesh";
    let mut page = Page::titled(size, title);
    let red = format!(r#"fill="{RED}""#);
    let grey = format!(r##"fill="#ced4da" stroke="{INK}" stroke-width="0.5""##);
    page.head(LEFT, title, [(&red[..], "scan"), (&grey[..], "mesh")]);
    let last = courses[3];
    for (k, (name, pose)) in [
        ("before", last.poses[0]),
        ("after Newton's method", last.end()),
    ]
    .into_iter()
    .enumerate()
    {
        let corner = Vec2::new(LEFT + k as f64 * (PANEL.x + LEFT), TOP);
        page.text(corner - Vec2::new(0.0, 9.0), r#"font-size="13.5""#, name);
        page.ground(
            format_args!("panel{k}"),
            [corner.x, corner.y, PANEL.x, PANEL.y],
        );
        page.inside(format_args!("panel{k}"), |page| {
            panel(page, corner, body, scan, pose);
        });
    }
    let corner = Vec2::new(LEFT + 40.0, TOP + PANEL.y + 52.0);
    page.text(
        corner - Vec2::new(0.0, 14.0),
        r#"font-size="13.5""#,
        "distance of the points from where each way ends, by steps",
    );
    let width = size.x - corner.x - LEFT - 140.0;
    chart(&mut page, corner, Vec2::new(width, 230.0), scan, courses);
    for (k, (way, colour)) in Way::ALL.into_iter().zip(COLOURS).enumerate() {
        let at = Vec2::new(corner.x + width + 16.0, corner.y + 24.0 + 24.0 * k as f64);
        let ends = [at - Vec2::new(0.0, 4.0), at + Vec2::new(22.0, -4.0)];
        page.line(ends, format_args!(r#"stroke="{colour}" stroke-width="3""#));
        page.text(at + Vec2::new(30.0, 0.0), "", way.name());
    }
    page.finish()
}
