//! The picture: a panel per fit, with the outline, the polygon before and the polygon after.
use crate::fit::Fit;
use geograd::{Polygon, Vec2};
use std::fmt::Write as _;

const PANEL: f64 = 360.0;
const GAP: f64 = 24.0;
const HEAD: f64 = 64.0;
const FOOT: f64 = 44.0;
/// Half the side of the place that a panel shows.
const REACH: f64 = 1.75;

const TEXT: &str = r##"font-family="sans-serif" fill="#212529""##;
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

fn path(page: &mut String, corner: Vec2<f64>, polygon: &Polygon<f64>, style: &str) {
    let mut way = String::new();
    for ring in polygon.rings().iter() {
        for (k, &vertex) in ring.iter().enumerate() {
            let at = place(corner, vertex);
            let pen = if k == 0 { 'M' } else { 'L' };
            let _ = write!(way, "{pen}{:.2},{:.2}", at.x, at.y);
        }
        way.push('Z');
    }
    let _ = writeln!(page, r#"<path d="{way}" {style}/>"#);
}

fn text(page: &mut String, at: Vec2<f64>, size: u32, words: &str) {
    let _ = writeln!(
        page,
        r#"<text x="{:.1}" y="{:.1}" font-size="{size}" {TEXT}>{words}</text>"#,
        at.x, at.y
    );
}

fn panel(page: &mut String, corner: Vec2<f64>, fit: &Fit) {
    let _ = writeln!(
        page,
        r##"<rect x="{:.1}" y="{:.1}" width="{PANEL}" height="{PANEL}" fill="#ffffff" stroke="#dee2e6"/>"##,
        corner.x, corner.y
    );
    path(page, corner, &fit.target.outline, OUTLINE);
    path(page, corner, &fit.target.start, BEFORE);
    path(page, corner, &fit.found, AFTER);
    for &vertex in fit.found.vertices() {
        let at = place(corner, vertex);
        let _ = writeln!(
            page,
            r##"<circle cx="{:.2}" cy="{:.2}" r="2.6" fill="#1864ab"/>"##,
            at.x, at.y
        );
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
    let mut page = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}">
<rect width="{0}" height="{1}" fill="#f8f9fa"/>
"##,
        size.x, size.y
    );
    text(
        &mut page,
        Vec2::new(GAP, 30.0),
        18,
        "Polygons fitted by gradient descent",
    );
    let legend = "grey: the outline; red, dashed: before; blue: after";
    text(&mut page, Vec2::new(GAP, 50.0), 12, legend);
    for (k, fit) in fits.iter().enumerate() {
        let (column, row) = ((k % 2) as f64, (k / 2) as f64);
        let corner = Vec2::new(GAP + (PANEL + GAP) * column, HEAD + (PANEL + FOOT) * row);
        panel(&mut page, corner, fit);
    }
    page.push_str("</svg>\n");
    page
}
