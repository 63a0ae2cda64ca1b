//! The picture: a panel per fit, with the outline, the polygon before and the polygon after.
use crate::fit::Fit;
use common::svg::{BLUE, Page};
use geograd::{Polygon, Vec2};

const PANEL: f64 = 360.0;
const GAP: f64 = 24.0;
const HEAD: f64 = 64.0;
const FOOT: f64 = 44.0;
/// Half the side of the place that a panel shows.
const REACH: f64 = 1.75;

const BEFORE: &str = r##"fill="none" stroke="#c92a2a" stroke-width="1.6" stroke-dasharray="5 4""##;
const AFTER: &str =
    r##"fill="#1864ab" fill-opacity="0.18" fill-rule="evenodd" stroke="#1864ab" stroke-width="2""##;
const OUTLINE: &str = r##"fill="#e9ecef" fill-rule="evenodd" stroke="#868e96" stroke-width="1.2""##;

fn place(corner: Vec2<f64>, at: Vec2<f64>) -> Vec2<f64> {
    let scale = PANEL / (2.0 * REACH);
    let limited = |x: f64| x.clamp(-REACH, REACH);
    Vec2::new(
        corner.x + (limited(at.x) + REACH) * scale,
        corner.y + (REACH - limited(at.y)) * scale,
    )
}

fn path(page: &mut Page, corner: Vec2<f64>, polygon: &Polygon<f64>, style: &str) {
    let rings = polygon.rings();
    let rings = rings.iter();
    page.rings(
        rings.map(|ring| ring.iter().map(|&vertex| place(corner, vertex))),
        style,
    );
}

fn text(page: &mut Page, at: Vec2<f64>, size: u32, words: &str) {
    let style = format_args!(r##"font-size="{size}" font-family="sans-serif" fill="#212529""##);
    page.text(at, style, words);
}

fn panel(page: &mut Page, corner: Vec2<f64>, fit: &Fit) {
    let style = r##"fill="#ffffff" stroke="#dee2e6""##;
    page.rect([corner.x, corner.y, PANEL, PANEL], style);
    path(page, corner, &fit.target.outline, OUTLINE);
    path(page, corner, &fit.target.start, BEFORE);
    path(page, corner, &fit.found, AFTER);
    for &vertex in fit.found.vertices() {
        let style = format_args!(r#"fill="{BLUE}""#);
        page.circle(place(corner, vertex), 2.6, style);
    }
    let (first, last) = (&fit.steps[0], &fit.steps[fit.steps.len() - 1]);
    let words = format!(
        "{}, by {}: IoU {:.3} → {:.3}",
        fit.target.shape.name(),
        fit.loss.name(),
        first.iou,
        last.iou
    );
    text(page, corner + Vec2::new(2.0, PANEL + 20.0), 14, &words);
}

/// The whole picture, two panels a row.
pub fn page(fits: &[Fit]) -> String {
    let columns = fits.len().min(2);
    let rows = fits.len().div_ceil(2);
    let size = Vec2::new(
        GAP + (PANEL + GAP) * columns as f64,
        HEAD + (PANEL + FOOT) * rows as f64 + GAP / 2.0,
    );
    let mut page = Page::new(size, 2, "");
    page.paper(r##"fill="#f8f9fa""##);
    let title = "Polygons fitted by gradient descent";
    text(&mut page, Vec2::new(GAP, 30.0), 18, title);
    let legend = "grey: the outline; red, dashed: before; blue: after";
    text(&mut page, Vec2::new(GAP, 50.0), 12, legend);
    for (k, fit) in fits.iter().enumerate() {
        let (column, row) = ((k % 2) as f64, (k / 2) as f64);
        let corner = Vec2::new(GAP + (PANEL + GAP) * column, HEAD + (PANEL + FOOT) * row);
        panel(&mut page, corner, fit);
    }
    page.finish()
}
